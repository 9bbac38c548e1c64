"""Automatic layout with Graphviz in a worker process, which may fail."""

import contextlib
import json
import os
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
from vicode.platform import kill_session, session_options

WorkerCommand = tuple[str, ...]
WORKER_COMMAND: WorkerCommand = (sys.executable, "-P", "-m", "vicode.diagram.worker")
"""-P: files in a project folder must not shadow modules."""

# The worker ends itself this long after the timeout, in case the editor was killed.
_GRACE_S = 1.0

# Graphviz orders nodes better than layers and may use more space. Its result is rejected only if the diagram
# would be shown below 40 % scale on a screen, and is this many times larger than the layered layout.
_MAX_SCREENS, _MAX_GROWTH = 2.5, 1.8


class LayoutMethod(StrEnum):
    """The method that computed the positions."""

    GRAPHVIZ = "graphviz"
    LAYERS = "layers"


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutResult:
    """Positions of all elements, including those not moved; `note` is shown to the user, "" on success."""

    layout: NodeLayout
    method: str
    note: str = ""


class LayoutService:
    """Runs one worker process for one request at a time and kills it on timeout. Close it at the end."""

    def __init__(self, command: WorkerCommand = WORKER_COMMAND) -> None:
        self._command = command
        self._process: subprocess.Popen[str] | None = None
        self._lock = threading.Lock()

    def compute(self, design: Design, *, only: Collection[str] | None = None, timeout_s: float = 5.0) -> LayoutResult:
        """Compute a layout with Graphviz, or in layers if that fails or exceeds `timeout_s`.

        This blocks: call it with `run.io_bound` or in a thread, never in the event loop.

        Args:
            design: The design; it may have errors.
            only: Names of states to move, near their old positions; all else stays. None: move everything.
            timeout_s: Total seconds, including the wait for other requests and the start of the process.
        """
        graph = build_layout_graph(design, only)
        try:
            centers = self._request_positions(graph, timeout_s) if graph.nodes else {}
        except _GraphvizFailedError as reason:
            note = f"{reason}; used a layered layout instead"
            return LayoutResult(
                layout=fit_layout(design, layered_positions(design, only), only), method=LayoutMethod.LAYERS, note=note
            )
        layers = layered_positions(design, only)
        larger = screens_needed(centers.values()) / screens_needed(layers.values())
        if screens_needed(centers.values()) > _MAX_SCREENS and larger > _MAX_GROWTH:
            note = f"the Graphviz layout is {larger:.1f} times as large; used a layered layout instead"
            return LayoutResult(layout=fit_layout(design, layers, only), method=LayoutMethod.LAYERS, note=note)
        return LayoutResult(layout=fit_layout(design, centers, only), method=LayoutMethod.GRAPHVIZ)

    def close(self) -> None:
        """Stop the worker; a running request falls back to layers. A later request starts a new one."""
        process = self._process
        if process is not None:
            # A request in progress gets no answer now and releases the lock.
            _kill(process)
        with self._lock:
            self._discard_process()

    def __enter__(self) -> "LayoutService":
        return self

    def __exit__(self, *_exception: object) -> None:
        self.close()

    def _request_positions(self, graph: LayoutGraph, timeout_s: float) -> dict[str, Point]:
        """Center positions by node id."""
        deadline = time.monotonic() + timeout_s
        late = f"Graphviz took longer than {timeout_s:g} s"
        if not self._lock.acquire(timeout=max(0.0, timeout_s)):
            raise _GraphvizFailedError(late)
        try:
            line = _send_request(self._running_process(), _request(graph, timeout_s), deadline - time.monotonic())
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
        return _read_answer(line, graph)

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
            # An unread request is still in the pipe's buffer.
            with contextlib.suppress(OSError):
                assert pipe is not None
                pipe.close()


class _GraphvizFailedError(Exception):
    """Graphviz returned no positions; the message is the reason."""


def _start_worker(command: WorkerCommand) -> subprocess.Popen[str]:
    # The folder that contains vicode, for a checkout that is not installed; after the user's own path.
    folders = (os.environ.get("PYTHONPATH", ""), str(Path(__file__).parents[2]))
    return subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, folders))},
        encoding="utf-8",
        # A separate process group, so that a `dot` it started ends with it, and Ctrl-C reaches only the editor.
        **session_options(),
    )


def _kill(process: subprocess.Popen[str]) -> None:
    if process.poll() is None:
        kill_session(process.pid)
    process.wait()


def _request(graph: LayoutGraph, timeout_s: float) -> str:
    return json.dumps({**asdict(graph), "timeout_s": timeout_s + _GRACE_S}) + "\n"


def _send_request(process: subprocess.Popen[str], request: str, timeout_s: float) -> str:
    """Send a line and wait for one; "" if the worker died. Kills it on timeout."""

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
            # Leaving the pool waits for its thread, which reads until the worker ends.
            _kill(process)
            raise


def _read_answer(line: str, graph: LayoutGraph) -> dict[str, Point]:
    if not line:
        raise _GraphvizFailedError("Graphviz stopped unexpectedly")
    answer = json.loads(line)
    if "error" in answer:
        raise _GraphvizFailedError(f"Graphviz could not be run ({answer['error']})")
    centers = {id_: (float(x), float(y)) for id_, (x, y) in answer["positions"].items()}
    if centers.keys() != {node.id for node in graph.nodes}:
        raise _GraphvizFailedError("Graphviz returned an incomplete layout")
    return centers
