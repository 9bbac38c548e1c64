"""A run whose inputs change at given times, as `vicode run --set` makes them.

The component and the world of such a run are attributes of a module written for it: its text is `MODULE_TEXT`, and
`DATA_FILE` in the same folder describes the run.
"""

from __future__ import annotations

import importlib
import json
from collections import deque
from collections.abc import Sequence
from pathlib import Path
from typing import Any, ClassVar

from vicode.bica import Component, Root
from vicode.bica.loader import load_component
from vicode.simulation.messages import Inputs, Setup, decode_setup, encode_setup
from vicode.simulation.stubs import StubInputs, install_stub_module

MODULE = "vicode_scripted_run"
MAIN, WORLD = "Main", "ScriptedInputs"
DATA_FILE = "vicode_scripted_run.json"
MODULE_TEXT = f"""from vicode.simulation.scripted_run import load_run

{MAIN}, {WORLD} = load_run(__file__)
"""

InputScript = Sequence[tuple[int, Inputs]]
"""Inputs with the time in ns from which they hold, in order."""


def write_run(folder: Path, setup: Setup, script: InputScript) -> None:
    """Write the module of a run into a folder."""
    data = {"setup": encode_setup(setup).decode(), "script": list(script)}
    (folder / DATA_FILE).write_text(json.dumps(data), encoding="utf-8")
    (folder / f"{MODULE}.py").write_text(MODULE_TEXT, encoding="utf-8")


def load_run(file: str) -> tuple[type[Component], type]:
    """The component and the world of the run in the folder of a file."""
    data = json.loads(Path(file).with_name(DATA_FILE).read_text(encoding="utf-8"))
    setup, script = decode_setup(data["setup"].encode()), [(time_ns, inputs) for time_ns, inputs in data["script"]]
    install_stub_module(setup.stubs)
    component = load_component(setup.component)
    types, enumerations = dict(setup.parameter_types), importlib.import_module(setup.probes).ENUMERATIONS

    class Main(component):  # type: ignore[misc, valid-type]
        """The component to run, which tells the world where inputs go."""

        def __init__(self, root: Root) -> None:
            super().__init__(root)
            root.world.root = root

    Main.__name__ = Main.__qualname__ = component.__name__
    Main.__module__ = component.__module__
    world = type(WORLD, (_ScriptedWorld,), {"script": script, "types": types, "enumerations": enumerations})
    return Main, world


class _ScriptedWorld:
    """Sets the inputs that are due before each iteration."""

    script: ClassVar[InputScript]
    types: ClassVar[dict[str, str]]
    enumerations: ClassVar[dict[str, Any]]

    def __init__(self) -> None:
        self.root: Root | None = None
        self._inputs: StubInputs | None = None
        self._waiting = deque(self.script)

    def advance(self, now_ns: int) -> None:
        """Set the inputs that are due."""
        assert self.root is not None
        if self._inputs is None:
            self._inputs = StubInputs(self.root, self.types, self.enumerations)
        while self._waiting and self._waiting[0][0] <= now_ns:
            self._inputs.set(self._waiting.popleft()[1])
        self._inputs.begin_iteration()
