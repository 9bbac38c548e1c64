"""The process that runs Graphviz: `python -m vicode.diagram.worker` answers each line of JSON with one line of JSON.

A crash or endless computation of Graphviz ends here, and not in the editor.
"""

import contextlib
import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from typing import Any, TextIO

import graphviz  # type: ignore[import-untyped]

from vicode.diagram.layout_dot import POINTS_PER_INCH, LayoutEffort, RankDirection, write_layout_dot
from vicode.diagram.layout_graph import LayoutCluster, LayoutEdge, LayoutGraph, LayoutNode

try:
    import pygraphviz
except ImportError:
    # No wheel for this machine: use an installed `dot`.
    pygraphviz = None

PositionsById = dict[str, tuple[float, float]]

_SCREEN_RATIO = 1.6
_MAX_FULL_EFFORT, _MAX_BOUNDED_EFFORT = 150, 500
# Graphviz recurses once per box: 3000 states overflow the usual 8 MB. Untouched memory costs nothing.
_STACK_BYTES = 512 * 1024 * 1024


def main() -> None:
    """Answer requests until standard input closes."""
    with _private_stdout() as answers:
        threading.stack_size(_STACK_BYTES)
        thread = threading.Thread(target=_serve, args=(sys.stdin, answers))
        thread.start()
        thread.join()


def compute_positions(graph: LayoutGraph, run: Callable[[str], str]) -> PositionsById:
    """Centers in pixels by id, x to the right and y downwards; of both rank directions the one that fits a screen
    better.
    """
    size = len(graph.nodes)
    effort = (
        LayoutEffort.FULL
        if size <= _MAX_FULL_EFFORT
        else LayoutEffort.BOUNDED
        if size <= _MAX_BOUNDED_EFFORT
        else LayoutEffort.QUICK
    )
    directions = tuple(RankDirection) if size <= _MAX_FULL_EFFORT else (RankDirection.RIGHT,)
    pictures = (_read_plain(run(write_layout_dot(graph, direction, effort))) for direction in directions)
    return min(pictures, key=lambda picture: _screen_extent(picture[0]))[1]


def _serve(requests: TextIO, answers: TextIO) -> None:
    for line in requests:
        answers.write(json.dumps(_answer(json.loads(line))) + "\n")
        answers.flush()


def _answer(request: dict[str, Any]) -> dict[str, Any]:
    graph = LayoutGraph(
        nodes=tuple(LayoutNode(**node) for node in request["nodes"]),
        edges=tuple(LayoutEdge(**edge) for edge in request["edges"]),
        clusters=tuple(map(_read_cluster, request["clusters"])),
    )
    _limit_run_time(request["timeout_s"])
    try:
        return {"positions": compute_positions(graph, _run_library if pygraphviz else _run_program)}
    except (OSError, ValueError, subprocess.SubprocessError, graphviz.ExecutableNotFound) as error:
        return {"error": str(error)}
    finally:
        _limit_run_time(0)


def _read_cluster(cluster: dict[str, Any]) -> LayoutCluster:
    return LayoutCluster(nodes=tuple(cluster["nodes"]), clusters=tuple(map(_read_cluster, cluster["clusters"])))


def _run_library(text: str) -> str:
    graph = pygraphviz.AGraph(string=text)
    try:
        return bytes(graph.draw(format="plain", prog="dot")).decode()
    finally:
        graph.close()


def _run_program(text: str) -> str:
    return str(graphviz.Source(text).pipe(format="plain", encoding="utf-8", quiet=True))


def _read_plain(text: str) -> tuple[tuple[float, float], PositionsById]:
    """The size and the centers from Graphviz's plain format: inches, y upwards."""
    width = height = 0.0
    positions: PositionsById = {}
    for line in text.splitlines():
        match line.split():
            case ["graph", _scale, wide, high]:
                width, height = float(wide), float(high)
            case ["node", id_, x, y, *_rest]:
                positions[id_] = (float(x) * POINTS_PER_INCH, (height - float(y)) * POINTS_PER_INCH)
    return (width, height), positions


def _screen_extent(size: tuple[float, float]) -> float:
    """The extent of an image in screens of height 1, in its larger dimension."""
    return max(size[0] / _SCREEN_RATIO, size[1])


def _limit_run_time(seconds: float) -> None:
    """Let the operating system end this process after a time, even inside Graphviz or if the editor was killed; 0:
    never.
    """
    signals: Any = signal
    if hasattr(signal, "setitimer"):
        signals.setitimer(signals.ITIMER_REAL, seconds)


@contextlib.contextmanager
def _private_stdout() -> Iterator[TextIO]:
    """The real standard output; C code that prints goes to standard error instead."""
    with os.fdopen(os.dup(1), "w", encoding="utf-8") as answers:
        os.dup2(2, 1)
        yield answers


if __name__ == "__main__":
    main()
