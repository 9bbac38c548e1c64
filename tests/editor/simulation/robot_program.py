"""A robot program in a thread of this process: the lamp of `lamp_project`, generated, with its hand-written parts."""

import importlib
import itertools
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from vicode.bica import Component, Root, SimulatedClock
from vicode.bica.live_server import LiveServer
from vicode.generators import generate, python_class_path
from vicode.output import apply_diffs, compare_files
from vicode.store import open_project

TICK_NS = 20_000_000
_NUMBERS = itertools.count()

LAMP = """\
vicode: 1
component: Lamp
uses: {eye: Eye}
initial: Dark
states:
  Dark:
    requires: [eye]
    transitions:
      - {to: Lit, when: eye.seen and eye.light < bright}
  Lit:
    requires: [eye]
    transitions:
      - {to: Dark, when: not eye.seen}
"""
PROJECT = """\
vicode: 1
project: %s
languages: [python]
constants: {bright: {value: 10, tunable: true, range: [0, 50]}}
components:
  Eye:
    implementation: %s:Eye
    outputs:
      seen: {type: bool}
      light: {type: float, unit: lx, range: [0, 100]}
  Floor: {implementation: world, outputs: {slope: float}}
"""
HANDS = """
from vicode.bica import Component


class Eye(Component):
    def __init__(self, root):
        super().__init__(root)
        self.seen, self.light = False, 3.0
"""


class RobotProgram:
    """Steps a root in a thread until it is left; `root` may be read between steps."""

    def __init__(self, folder: Path, root: Root, server: LiveServer) -> None:
        self.folder, self.root, self.server = folder, root, server
        self.address, self.token = server.address, server.token
        self._is_over = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def stop(self) -> None:
        self._is_over.set()
        self._thread.join(10)
        self.root.close()

    @property
    def eye(self) -> Any:
        return next(each for each in self.root.components if type(each).__name__ == "Eye")

    def _run(self) -> None:
        while not self._is_over.is_set():
            self.root.step()
            assert isinstance(self.root.clock, SimulatedClock)
            self.root.clock.advance(TICK_NS)
            time.sleep(0.004)


def write_robot(folder: Path) -> Path:
    """Write the project, with names that no other test imports."""
    number = next(_NUMBERS)
    folder.mkdir(parents=True, exist_ok=True)
    texts = {"project.yaml": PROJECT % (f"Robot{number}", f"robot_hands_{number}"), "lamp.yaml": LAMP}
    for name, text in {**texts, f"robot_hands_{number}.py": HANDS}.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


@contextmanager
def running_robot(folder: Path, *, control: bool = True, port: int = 0) -> Iterator[RobotProgram]:
    """Generate the project and run its lamp."""
    opened = open_project(folder)
    files = generate(opened.project, sources={"Lamp": "lamp.yaml"})
    apply_diffs(compare_files(files, folder / "generated"), folder / "generated")
    paths = [str(folder / "generated" / "python"), str(folder)]
    sys.path[:0] = paths
    importlib.invalidate_caches()
    try:
        module, _colon, name = python_class_path(opened.project, "Lamp").partition(":")
        component: type[Component] = getattr(importlib.import_module(module), name)
        root = Root(component, clock=SimulatedClock())
        program = RobotProgram(folder, root, root.watch(port, control=control, without_hold=True, token="right"))
        try:
            yield program
        finally:
            program.stop()
    finally:
        del sys.path[: len(paths)]
