"""Time to lay a design out: by our service, and bare pygraphviz on the same design as most people would draw it.

Run it with `python -m benchmarks.layout`. Both run in a process that is up already; a time is of one request.
"""

from __future__ import annotations

import argparse
import json
import random
import statistics
import subprocess
import sys
import threading
import time

from vicode.diagram.layered_layout import complete_layout
from vicode.diagram.layout import LayoutService
from vicode.model.design import Design, Guard, State, Transition
from vicode.model.traversal import iter_transitions

SIZES = {20: 7, 100: 7, 300: 5, 1000: 5, 3000: 3}
LIMIT_S = 90.0
# Reads arrows as JSON lines, and answers when the picture is there: every transition, boxes of fixed size, no routes.
BARE_GRAPHVIZ = """
import json, sys
import pygraphviz
for line in sys.stdin:
    graph = pygraphviz.AGraph(directed=True, strict=False, splines="none", rankdir="LR", nslimit="0.1", mclimit="0.1")
    graph.node_attr.update(shape="box", fixedsize="true", width="1.94", height="0.83")
    graph.add_edges_from(json.loads(line))
    graph.draw(format="plain", prog="dot")
    graph.close()
    print("done", flush=True)
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=list(SIZES), help="numbers of states")
    parser.add_argument("--limit", type=float, default=LIMIT_S, help=f"seconds a picture may take ({LIMIT_S:g})")
    options = parser.parse_args()
    print("| states | placed in layers | laid out | bare pygraphviz |\n|---|---|---|---|")
    for size in options.sizes:
        design = make_design(size)
        rounds = SIZES.get(size, 3)
        layers = [time_layers(design) for _ in range(rounds)]
        print(f"| {size} | {show(layers)} | {show(time_service(design, rounds, options.limit))} |", end=" ", flush=True)
        print(f"{show(time_bare(design, rounds, options.limit))} |", flush=True)


def make_design(size: int) -> Design:
    """Three transitions a state, four of five to one near by, the rest to anywhere."""
    chance = random.Random(1)
    states = tuple(
        State(name=f"State{index}", transitions=tuple(make_transition(index, size, chance) for _ in range(3)))
        for index in range(size)
    )
    return Design(component="Measured", initial="State0", states=states)


def make_transition(index: int, size: int, chance: random.Random) -> Transition:
    is_near = chance.random() < 0.8
    to = (index + chance.choice((1, 1, 2, 3, -1, -5))) % size if is_near else chance.randrange(size)
    return Transition(to=f"State{to}", guard=Guard(when="perception.ball_seen"))


def time_layers(design: Design) -> float:
    start = time.perf_counter()
    complete_layout(design)
    return time.perf_counter() - start


def time_service(design: Design, rounds: int, limit_s: float) -> list[float]:
    with LayoutService() as service:
        service.compute(Design(component="Warm", states=(State(name="A"),)), timeout_s=limit_s)
        times = []
        for _ in range(rounds):
            start = time.perf_counter()
            if service.compute(design, timeout_s=limit_s).note:
                return []
            times.append(time.perf_counter() - start)
    return times


def time_bare(design: Design, rounds: int, limit_s: float) -> list[float]:
    """Empty when it crashes or takes longer than the limit."""
    arrows = json.dumps([(each.source, each.decision.to) for each in iter_transitions(design)])  # type: ignore[union-attr]
    times: list[float] = []
    command = [sys.executable, "-c", BARE_GRAPHVIZ]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, encoding="utf-8"
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        request_layout(process, '[["A", "B"]]', limit_s)
        for _ in range(rounds):
            start = time.perf_counter()
            if not request_layout(process, arrows, limit_s):
                return []
            times.append(time.perf_counter() - start)
        process.stdin.close()
    return times


def request_layout(process: subprocess.Popen[str], request: str, limit_s: float) -> bool:
    """Whether an answer came in time; a process that is too late is killed."""
    assert process.stdin is not None
    assert process.stdout is not None
    killer = threading.Timer(limit_s, process.kill)
    killer.start()
    try:
        process.stdin.write(request + "\n")
        process.stdin.flush()
        return process.stdout.readline() == "done\n"
    finally:
        killer.cancel()


def show(times: list[float]) -> str:
    return f"{statistics.median(times):.3f} s" if times else "none"


if __name__ == "__main__":
    main()
