"""The documentation sites of 10, 100 and 500 state machines: processor time, peak memory and size.

`python -m benchmarks.docs_sizes [COUNT …]`. Each site is built from nothing, again without a change, and after the edit
of one state, each time by a fresh process whose modules are compiled.
"""

import argparse
import os
import random
import resource
import sys
import tempfile
from multiprocessing import get_context
from multiprocessing.queues import SimpleQueue
from pathlib import Path

from vicode.cli import main as vicode

FOLDER_SIZE, STATES = 12, 4
LAYER = 4 * FOLDER_SIZE
AREAS = ("attack", "ball", "defense", "goalie", "head", "kick", "search", "stand", "team", "walk")
VERBS = ("Align", "Approach", "Block", "Check", "Follow", "Guard", "Hold", "Look", "Pass", "Reach", "Turn", "Wait")


def write_project(folder: Path, count: int) -> Path:
    """Write a project of `count` state machines in folders of a dozen; each uses some of its own and later ones."""
    chance = random.Random(count)
    folder.mkdir(parents=True)
    (folder / "project.yaml").write_text(PROJECT, "utf-8")
    names = [f"{VERBS[number % FOLDER_SIZE]}{_area(number).capitalize()}" for number in range(count)]
    for number, name in enumerate(names):
        own_end = number - number % FOLDER_SIZE + FOLDER_SIZE
        near, far = names[number + 1 : own_end], names[_next_layer(number) :][:LAYER]
        used = [*chance.sample(near, min(2, len(near))), *chance.sample(far, min(1, len(far)))]
        file = folder / _area(number) / f"{name}.yaml"
        file.parent.mkdir(exist_ok=True)
        file.write_text(_design(name, used, chance), "utf-8")
    return folder


PROJECT = """\
vicode: 1
project: Squad
languages: [python]
components:
  Senses:
    implementation: team.senses:Senses
    doc: What the robot perceives.
    outputs:
      ball_distance: {type: float, unit: mm, doc: From the robot to the ball.}
      ball_seen: {type: bool, doc: The ball is in the latest image.}
      fallen: {type: bool, doc: The robot lies on the ground.}
"""


def _next_layer(number: int) -> int:
    """The first machine of the next four folders."""
    return number + LAYER - number % LAYER


def _area(number: int) -> str:
    round_, place = divmod(number // FOLDER_SIZE, len(AREAS))
    return AREAS[place] + (str(round_ + 1) if round_ else "")


def _design(name: str, used: list[str], chance: random.Random) -> str:
    lines = ["vicode: 1", f"component: {name}", f"doc: Does what {name} says until the ball is lost.", "uses:"]
    lines += ["  senses: Senses", *(f"  {each.lower()}: {each}" for each in used), "initial: State0", "states:"]
    for number in range(STATES):
        x, y = 80 + number % 4 * 240, 80 + number // 4 * 200
        lines += [
            f"  State{number}:",
            f"    doc: Step {number} of {name}.",
            f"    at: [{x}, {y}]",
            "    requires: [senses]",
        ]
        lines += [f"    modulates: {{{used[number % len(used)].lower()}: {{}}}}"] if used else []
        lines.append("    transitions:")
        lines.append(f"      - {{to: State{(number + 1) % STATES}, when: senses.ball_seen, doc: ball seen}}")
        limit = f"when: senses.ball_distance < {chance.randrange(9999)}" if number % 2 else f"after: {number + 1}"
        lines.append(f"      - {{to: State{chance.randrange(STATES)}, {limit}}}")
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("counts", nargs="*", type=int, default=[10, 100, 500])
    options = parser.parse_args()
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    print("| state machines | size | from nothing | no edit | one edit |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        os.environ |= {"VICODE_CACHE": f"{folder}/cache", "PYTHONPYCACHEPREFIX": f"{folder}/compiled"}
        build(write_project(Path(folder, "first"), 2), Path(folder, "site0"))
        for count in options.counts:
            measure(write_project(Path(folder, f"team{count}"), count), Path(folder, f"site{count}"), count)


def measure(project: Path, out: Path, count: int) -> None:
    whole, again = build(project, out), build(project, out)
    file = min(project.rglob("*/*.yaml"))
    file.write_text(file.read_text("utf-8").replace("Step 3", "The third step"), "utf-8")
    edited = build(project, out)
    size = sum(each.stat().st_size for each in out.iterdir()) / 1e6
    print(f"| {count} | {size:.1f} MB | {whole} | {again} | {edited} |", flush=True)


def build(project: Path, out: Path) -> str:
    """Processor time and peak memory of one process that builds a site."""
    queue = get_context("spawn").SimpleQueue()
    process = get_context("spawn").Process(target=_build, args=(project, out, queue))
    process.start()
    seconds, megabytes = queue.get()
    process.join()
    return f"{seconds:.2f} s, {megabytes:.0f} MB"


def _build(project: Path, out: Path, queue: "SimpleQueue[tuple[float, float]]") -> None:
    with Path(os.devnull).open("w", encoding="utf-8") as sys.stdout:
        code = vicode(["docs", str(project), "--out", str(out)])
    assert code == 0, code
    kinds = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    used = [resource.getrusage(kind) for kind in kinds]
    queue.put((sum(each.ru_utime + each.ru_stime for each in used), max(each.ru_maxrss for each in used) / 1024))


if __name__ == "__main__":
    main()
