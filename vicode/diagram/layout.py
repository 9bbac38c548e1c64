"""Laying a design out with Graphviz, which runs in a process of its own and may fail there."""

import contextlib
import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Collection
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from enum import StrEnum
from pathlib import Path

from vicode.diagram.layered_layout import NodeLayout
from vicode.diagram.layout_fit import fit_layout, layered_positions, screens_needed
from vicode.diagram.layout_graph import LayoutGraph, build_layout_graph
from vicode.model.design import Design, Point

WorkerCommand = tuple[str, ...]
WORKER_COMMAND: WorkerCommand = (sys.executable, "-P", "-m", "vicode.diagram.worker")
"""-P: a file in the folder of a project is never taken for a module of ours."""

# The worker ends itself so much later than we give up, should nobody be left to kill it.
_GRACE_S = 1.0

# Graphviz orders better than layers do, and is worth some room: it is given up only for a picture that must be
# shrunk below four tenths on a screen, and so many times further than layers.
_MAX_SCREENS, _MAX_GROWTH = 2.5, 1.8


class LayoutMethod(StrEnum):
    """Who found the places."""

    GRAPHVIZ = "graphviz"
    LAYERS = "layers"


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutResult:
    """Where everything stands, also what was not moved; `note` is for the user, empty when all went as wished."""

    layout: NodeLayout
    method: str
    note: str = ""


class LayoutService:
    """Keeps one worker process for one request at a time; what takes too long is killed. Close it in the end."""

    def __init__(self, command: WorkerCommand = WORKER_COMMAND) -> None:
        self._command = command
        self._process: subprocess.Popen[str] | None = None
        self._lock = threading.Lock()

    def compute(self, design: Design, *, only: Collection[str] | None = None, timeout_s: float = 5.0) -> LayoutResult:
        """As the function `compute_layout`; a request waits for its turn, which counts as its time."""
        sketch = build_layout_graph(design, only)
        try:
            centres = self._request_positions(sketch, timeout_s) if sketch.nodes else {}
        except _GraphvizFailedError as reason:
            note = f"{reason}; placed in layers instead"
            return LayoutResult(
                layout=fit_layout(design, layered_positions(design, only), only), method=LayoutMethod.LAYERS, note=note
            )
        layers = layered_positions(design, only)
        larger = screens_needed(centres.values()) / screens_needed(layers.values())
        if screens_needed(centres.values()) > _MAX_SCREENS and larger > _MAX_GROWTH:
            note = f"Graphviz made it {larger:.1f} times as large; placed in layers instead"
            return LayoutResult(layout=fit_layout(design, layers, only), method=LayoutMethod.LAYERS, note=note)
        return LayoutResult(layout=fit_layout(design, centres, only), method=LayoutMethod.GRAPHVIZ)

    def close(self) -> None:
        """End the worker; a request under way falls back to layers at once. A later request starts a new one."""
        process = self._process
        if process is not None:
            # Whoever waits for its answer gets none now, and gives the turn back.
            _kill(process)
        with self._lock:
            self._discard_process()

    def __enter__(self) -> "LayoutService":
        return self

    def __exit__(self, *_exception: object) -> None:
        self.close()

    def _request_positions(self, sketch: LayoutGraph, timeout_s: float) -> dict[str, Point]:
        """Centres by id."""
        deadline = time.monotonic() + timeout_s
        late = f"Graphviz took longer than {timeout_s:g} s"
        if not self._lock.acquire(timeout=max(0.0, timeout_s)):
            raise _GraphvizFailedError(late)
        try:
            line = _send_request(self._running_process(), _request(sketch, timeout_s), deadline - time.monotonic())
            if not line:
                self._discard_process()
        except TimeoutError:
            self._discard_process()
            raise _GraphvizFailedError(late) from None
        except OSError as error:
            self._discard_process()
            raise _GraphvizFailedError(f"Graphviz could not be run ({error.strerror or error})") from error
        finally:
            self._lock.release()
        return _read_answer(line, sketch)

    def _running_process(self) -> subprocess.Popen[str]:
        if self._process is None or self._process.poll() is not None:
            self._discard_process()
            self._process = _start_worker(self._command)
        return self._process

    def _discard_process(self) -> None:
        process, self._process = self._process, None
        if process is None:
            return
        _kill(process)
        for pipe in (process.stdin, process.stdout):
            # A request that nobody read is still in the pipe's buffer.
            with contextlib.suppress(OSError):
                assert pipe is not None
                pipe.close()


def compute_layout(design: Design, *, only: Collection[str] | None = None, timeout_s: float = 5.0) -> LayoutResult:
    """Place a design anew with Graphviz, or in layers when that fails or takes longer than `timeout_s`.

    It blocks that long: never call it in the server's own thread, but by `run.io_bound` or in a thread.

    Args:
        design: what is placed; it may have mistakes.
        only: names of states; these are moved, to about where they were, and all else stays. None: all is moved.
        timeout_s: seconds for all of it, the start of the process included.
    """
    with LayoutService() as service:
        return service.compute(design, only=only, timeout_s=timeout_s)


class _GraphvizFailedError(Exception):
    """Graphviz gave no places; the text says why."""


def _start_worker(command: WorkerCommand) -> subprocess.Popen[str]:
    # The folder that holds vicode, for a checkout that is not installed; after what the user set.
    folders = (os.environ.get("PYTHONPATH", ""), str(Path(__file__).parents[2]))
    return subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, folders))},
        encoding="utf-8",
        # Its own group, so that a `dot` it started ends with it, and Ctrl-C is left to us.
        start_new_session=True,
    )


def _kill(process: subprocess.Popen[str]) -> None:
    if process.poll() is None:
        if hasattr(os, "killpg"):
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
        process.kill()
    process.wait()


def _request(sketch: LayoutGraph, timeout_s: float) -> str:
    return json.dumps({**asdict(sketch), "timeout_s": timeout_s + _GRACE_S}) + "\n"


def _send_request(process: subprocess.Popen[str], request: str, timeout_s: float) -> str:
    """Hand over a line and wait for one; empty when the worker died. Kills it when it is too late."""

    def ask() -> str:
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(request)
        process.stdin.flush()
        return process.stdout.readline()

    with ThreadPoolExecutor(max_workers=1) as pool:
        answer = pool.submit(ask)
        try:
            return answer.result(timeout=max(0.0, timeout_s))
        except TimeoutError:
            # Leaving the pool waits for its thread, which reads until the worker's end.
            _kill(process)
            raise


def _read_answer(line: str, sketch: LayoutGraph) -> dict[str, Point]:
    if not line:
        raise _GraphvizFailedError("Graphviz stopped unexpectedly")
    answer = json.loads(line)
    if "error" in answer:
        raise _GraphvizFailedError(f"Graphviz could not be run ({answer['error']})")
    centres = {id_: (float(x), float(y)) for id_, (x, y) in answer["positions"].items()}
    if centres.keys() != {node.id for node in sketch.nodes}:
        raise _GraphvizFailedError("Graphviz left something out")
    return centres
