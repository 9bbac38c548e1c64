"""Processor time of `vicode docs`: from nothing, after one edit, while watching; and that of bare Graphviz.

Run it with `python -m benchmarks.docs AGENTS`, where AGENTS is the agents.xabsl of a large behavior. Its folder is
copied, and the copy edited. Each time but those of watching is of a fresh process with all that it starts; modules are
compiled before, as they are for whoever has started vicode once.
"""

from __future__ import annotations

import argparse
import gc
import json
import os
import random
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from vicode.cli.sites import Sites
from vicode.cli.subjects import read_subjects
from vicode.diagram.export import export
from vicode.diagram.formats import Format
from vicode.model.design import Design, Guard, State, Transition

# Draws each text of a list that it reads, in one process, as most people would let it be drawn.
BARE = """
import json, sys
import pygraphviz
for text in json.load(sys.stdin):
    graph = pygraphviz.AGraph(string=text)
    graph.draw(format="svg", prog="dot")
    graph.close()
"""
STATES = 300
WAITING = re.compile(r"(state_time\s*[<>]=?\s*)\d+")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("agents", type=Path, help="the agents.xabsl of a behavior")
    parser.add_argument("--rounds", type=int, default=5, help="of each, the median is shown (5)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / options.agents.resolve().parent.name
        shutil.copytree(options.agents.resolve().parent, copy)
        measure(copy / options.agents.name, Path(folder), options.rounds)


def measure(agents: Path, folder: Path, rounds: int) -> None:
    os.environ["VICODE_CACHE"] = str(folder / "cache")
    os.environ["PYTHONPYCACHEPREFIX"] = str(folder / "compiled")
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    command = [sys.executable, "-m", "vicode", "docs", str(agents), "--out", str(folder / "site")]
    print("| | processor time |\n|---|---|")
    run(command)
    fresh = [[*command[:-1], str(folder / f"site{number}")] for number in range(rounds)]
    whole = [spent(partial(run, each)) for each in fresh]
    show("site from nothing, a fresh process", whole)
    show("nothing changed, a fresh process", [spent(lambda: run(command)) for _round in range(rounds)])
    edited = [spent(lambda: run(command), before=lambda: edit(agents)) for _round in range(rounds)]
    show("one state edited, a fresh process", edited)
    show("one state edited, while watching", watched(agents, folder / "watched", rounds))
    texts = json.dumps(graphs(agents))
    bare = [spent(lambda: run([sys.executable, "-c", BARE], texts)) for _round in range(rounds)]
    show("bare Graphviz on the state machines, one process", bare)
    show(f"a drawing of {STATES} states as SVG", [exported() for _round in range(rounds)])
    print(
        f"\nThe site from nothing takes {statistics.median(whole) / statistics.median(bare):.1f} times bare Graphviz."
    )


def show(title: str, times: list[float]) -> None:
    print(f"| {title} | {statistics.median(times):.2f} s ({min(times):.2f}–{max(times):.2f}) |", flush=True)


def run(command: list[str], text: str = "") -> None:
    subprocess.run(command, input=text, text=True, check=True, stdout=subprocess.DEVNULL)


def spent(work: Callable[[], None], before: Callable[[], None] = lambda: None) -> float:
    """Seconds of processor time of the processes that some work starts, and of theirs."""
    before()
    begun = resource.getrusage(resource.RUSAGE_CHILDREN)
    work()
    done = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done.ru_utime + done.ru_stime - begun.ru_utime - begun.ru_stime


def watched(agents: Path, out: Path, rounds: int) -> list[float]:
    """Times from an edit to its pages, in a process that has built the site before."""
    times = []
    with Sites(out=out) as sites:
        sites.build(read_subjects([agents]))
        gc.freeze()
        for _round in range(rounds):
            edit(agents)
            begun = time.process_time()
            built = sites.build(read_subjects([agents]))
            times.append(time.process_time() - begun)
            assert built.touched
    return times


def edit(agents: Path, chance: random.Random = random.Random(1)) -> None:  # noqa: B008 - the same edits every time
    """Let some state wait for another time."""
    files = [path for path in sorted(agents.parent.rglob("*.xabsl")) if WAITING.search(path.read_text("latin-1"))]
    file = chance.choice(files)
    text = file.read_text("latin-1")
    file.write_text(WAITING.sub(rf"\g<1>{chance.randrange(1000, 10000)}", text, count=1), "latin-1")


def graphs(agents: Path) -> list[str]:
    """The state machines as texts for Graphviz."""
    (reading,) = read_subjects([agents])
    assert reading.subject is not None
    return [export(design, Format.DOT).decode() for design in reading.subject.project.designs]


def exported() -> float:
    design = ring(STATES)
    begun = time.process_time()
    export(design, Format.SVG)
    return time.process_time() - begun


def ring(size: int) -> Design:
    """States in a ring, each with one more transition to anywhere."""
    chance = random.Random(size)
    ways = ((index, ((index + 1) % size, chance.randrange(size))) for index in range(size))
    states = tuple(
        State(
            name=f"State{index}",
            transitions=tuple(Transition(to=f"State{to}", guard=Guard(when="tries > 3")) for to in targets),
        )
        for index, targets in ways
    )
    return Design(component="Ring", initial="State0", states=states)


if __name__ == "__main__":
    main()
