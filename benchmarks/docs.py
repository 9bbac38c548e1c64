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

from vicode.diagram.export_formats import EXPORT_FORMATS, ExportOptions
from vicode.model.design import Design, Guard, State, Transition
from vicode.services.docs.builder import DocsBuilder
from vicode.services.docs.inputs import load_site_inputs

# Draws each text of a list that it reads, in one process, as most people would let it be drawn.
BARE_GRAPHVIZ = """
import json, sys
import pygraphviz
for text in json.load(sys.stdin):
    graph = pygraphviz.AGraph(string=text)
    graph.draw(format="svg", prog="dot")
    graph.close()
"""
STATES = 300
STATE_TIME = re.compile(r"(state_time\s*[<>]=?\s*)\d+")


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
    whole = [child_cpu_time(partial(run, each)) for each in fresh]
    show("site from nothing, a fresh process", whole)
    show("nothing changed, a fresh process", [child_cpu_time(lambda: run(command)) for _round in range(rounds)])
    edited = [child_cpu_time(lambda: run(command), before=lambda: edit(agents)) for _round in range(rounds)]
    show("one state edited, a fresh process", edited)
    show("one state edited, while watching", measure_watching(agents, folder / "watched", rounds))
    texts = json.dumps(export_dot_texts(agents))
    bare = [child_cpu_time(lambda: run([sys.executable, "-c", BARE_GRAPHVIZ], texts)) for _round in range(rounds)]
    show("bare Graphviz on the state machines, one process", bare)
    show(f"a drawing of {STATES} states as SVG", [measure_export() for _round in range(rounds)])
    print(
        f"\nThe site from nothing takes {statistics.median(whole) / statistics.median(bare):.1f} times bare Graphviz."
    )


def show(title: str, times: list[float]) -> None:
    print(f"| {title} | {statistics.median(times):.2f} s ({min(times):.2f}–{max(times):.2f}) |", flush=True)


def run(command: list[str], text: str = "") -> None:
    subprocess.run(command, input=text, text=True, check=True, stdout=subprocess.DEVNULL)


def child_cpu_time(work: Callable[[], None], before: Callable[[], None] = lambda: None) -> float:
    """Seconds of processor time of the processes that some work starts, and of theirs."""
    before()
    begun = resource.getrusage(resource.RUSAGE_CHILDREN)
    work()
    done = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done.ru_utime + done.ru_stime - begun.ru_utime - begun.ru_stime


def measure_watching(agents: Path, out: Path, rounds: int) -> list[float]:
    """Times from an edit to its pages, in a process that has built the site before."""
    times = []
    with DocsBuilder(out=out) as sites:
        sites.build(load_site_inputs([agents]))
        gc.freeze()
        for _round in range(rounds):
            edit(agents)
            begun = time.process_time()
            built = sites.build(load_site_inputs([agents]))
            times.append(time.process_time() - begun)
            assert built.changed
    return times


def edit(agents: Path, chance: random.Random = random.Random(1)) -> None:  # noqa: B008 - the same edits every time
    """Let some state wait for another time."""
    files = [path for path in sorted(agents.parent.rglob("*.xabsl")) if STATE_TIME.search(path.read_text("latin-1"))]
    file = chance.choice(files)
    text = file.read_text("latin-1")
    file.write_text(STATE_TIME.sub(rf"\g<1>{chance.randrange(1000, 10000)}", text, count=1), "latin-1")


def export_dot_texts(agents: Path) -> list[str]:
    """The state machines as texts for Graphviz."""
    (reading,) = load_site_inputs([agents])
    assert reading.site_input is not None
    return [
        EXPORT_FORMATS["dot"].write(design, ExportOptions()).decode() for design in reading.site_input.project.designs
    ]


def measure_export() -> float:
    design = ring(STATES)
    begun = time.process_time()
    EXPORT_FORMATS["svg"].write(design, ExportOptions())
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
