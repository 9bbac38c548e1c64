"""The search for deadlocks of `vicode.analysis.team_search`, compared with SPIN and with a complete search.

`python -m benchmarks.teams [PRODUCTS] [--seed N]` needs `spin` and `gcc` (`apt install spin gcc`).

- Random products of 2 to 4 robots with up to 12 states each: the deadlocks that SPIN finds, without partial-order
  reduction, in a model that is written here from the product. `full` is a complete search in Python.
- Robots of 20 and 30 states that pass doors and meet: configurations and times of both.
- The model that `vicode export --format promela` writes of designs/meeting, and of a variant with a deadlock.

Times are those of the processor.
"""

import argparse
import random
import re
import subprocess
import tempfile
import time
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from statistics import median

from tests.analysis.random_teams import FullProduct, draw_product
from vicode.analysis.products import Cooperation, Place, Product, RobotMachine
from vicode.analysis.team_search import TeamSearch
from vicode.diagram.promela import write_promela
from vicode.model.design import Guard, Transition
from vicode.store import open_project

LIMIT = 1_000_000
_OPTIONS = ("-DSAFETY", "-DNOREDUCE")
MEETING = Path(__file__).parents[1] / "designs" / "meeting"
Deadlocks = set[tuple[int, ...]]
"""Configurations: the state of each robot, in the order of the robots."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SpinRun:
    """What SPIN printed. The times are in seconds of the processor: to compile, and to search."""

    output: str
    compile_time: float
    time: float

    @property
    def stored(self) -> int:
        found = re.search(r"(\S+) states, stored", self.output)
        return int(float(found.group(1))) if found else 0

    @property
    def deadlocks(self) -> Deadlocks:
        return {tuple(map(int, line.split())) for line in re.findall(r"^@(.*)$", self.output, re.MULTILINE)}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("products", nargs="?", type=int, default=50)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    compare_random(range(options.seed, options.seed + options.products))
    print("\n| robots | full (SPIN) | reduced | deadlocks | SPIN: compile, search | reduced search |")
    print("|---|---|---|---|---|---|")
    for robots, states in ((2, 30), (3, 30), (4, 20), (4, 30)):
        for is_same in (True, False):
            measure(robots, states, is_same=is_same)
    print()
    export()


def compare_random(seeds: Iterable[int]) -> None:
    rows, different = [], 0
    for seed in seeds:
        robots, places = draw_product(random.Random(seed), range(6, 13))
        started = time.process_time()
        full = FullProduct(robots, places)
        full_time = time.process_time() - started
        search, reduced_time = search_reduced(robots, places)
        ran = run_spin(encode(robots, places), "-E", "-c0")
        # SPIN tells equal robots apart.
        in_spin = {full.named(at) for at in ran.deadlocks}
        found = find_deadlocks(search)
        if not in_spin == found == set(full.deadlocks()):
            different += 1
            print(f"seed {seed}: SPIN {len(in_spin)} deadlocks, reduced {len(found)}, full {len(full.deadlocks())}")
        rows.append((len(full.graph), len(search.edges), len(found), full_time, reduced_time, ran.time))
    sums = [sum(column) for column in zip(*rows, strict=True)]
    print(f"{len(rows)} products, {sum(row[2] > 0 for row in rows)} with deadlocks: {different} with a difference")
    print(f"configurations: {sums[0]} in all, {sums[1]} visited; {sums[2]} deadlocks")
    print("median and largest time in ms:", end="")
    for name, column in (("full", 3), ("reduced", 4), ("SPIN without compiling", 5)):
        times = [1000 * row[column] for row in rows]
        print(f" {name} {median(times):.1f}, {max(times):.1f};", end="")
    print()


def measure(count: int, states: int, *, is_same: bool) -> None:
    rng = random.Random(count * states)
    robots = [draw_robot(rng, f"r{number}", states, number) for number in range(count)]
    robots = robots[:1] * count if is_same else robots
    places = {(f"Arm{n}", f"meet{n}"): Cooperation(number=2, is_barrier=True) for n in range(4)}
    places |= {("Body", f"door{n}"): Cooperation(number=1, is_barrier=False) for n in range(3)}
    search, reduced_time = search_reduced(robots, places)
    ran = run_spin(encode(robots, places), "-E", "-c0", "-m1000000")
    found = find_deadlocks(search)
    in_spin = {
        tuple(sorted((robot.name, state) for robot, state in zip(robots, at, strict=True))) for at in ran.deadlocks
    }
    verdict = "equal" if found == in_spin else f"{len(found)} and {len(in_spin)}"
    print(
        f"| {count} x {states}, {'one machine' if is_same else 'different'} | {ran.stored:,} | {len(search.edges):,} "
        f"| {len(found)}, {verdict} | {ran.compile_time:.1f} s, {ran.time:.1f} s | {1000 * reduced_time:.0f} ms |"
    )


def draw_robot(rng: random.Random, name: str, states: int, number: int) -> RobotMachine:
    """A ring with shortcuts, in which each robot passes doors, and meets the next robot and the one before it."""
    active: list[dict[str, str]] = [{"Body": f"s{state}"} for state in range(states)]
    doors = rng.sample(range(1, states), 3)
    for door, state in enumerate(doors):
        active[state] = {"Body": f"door{door}"}
    moves = {(state, (state + 1) % states) for state in range(states)}
    for _ in range(2 * states):
        source, target = rng.randrange(states), rng.randrange(states)
        if target not in doors:
            moves.add((source, target))
    listed = {(a, ("Body", active[b]["Body"])): b for a, b in sorted(moves) if a != b}
    # An arm waits in a state of its own, and is lowered after the meeting.
    for partner in {number, (number - 1) % 4}:
        arm, at = f"Arm{partner}", rng.randrange(states)
        waiting, met = len(active), len(active) + 1
        active += [{"Body": f"w{partner}", arm: "wait"}, {"Body": f"w{partner}", arm: f"meet{partner}"}]
        after = (at + 1) % states
        listed[at, ("Body", f"w{partner}")] = waiting
        listed[waiting, (arm, f"meet{partner}")] = met
        listed[met, ("Body", active[after]["Body"])] = after
    return RobotMachine(name=name, states=tuple(active), moves=listed)


def search_reduced(robots: list[RobotMachine], places: Mapping[Place, Cooperation]) -> tuple[TeamSearch, float]:
    started = time.process_time()
    search = TeamSearch(Product(robots, places), LIMIT)
    return search, time.process_time() - started


def find_deadlocks(search: TeamSearch) -> set[tuple[tuple[str, int], ...]]:
    names, following = {}, 0
    for machine in dict.fromkeys(search.product.robots):
        names.update({following + index: (machine.name, index) for index in range(len(machine.states))})
        following += len(machine.states)
    return {tuple(sorted(names[state] for state in at)) for at, edges in search.edges.items() if not edges}


def encode(robots: list[RobotMachine], places: Mapping[Place, Cooperation]) -> str:
    """A product in Promela. The process `watch` prints each configuration that no other process leaves."""

    def among(robot: int, states: Iterable[int]) -> str:
        return "(" + (" || ".join(f"at[{robot}] == {state}" for state in states) or "false") + ")"

    def count(place: Place, *, is_near: bool) -> str:
        return " + ".join(
            among(index, (n for n, active in enumerate(robot.states) if is_at(active, place, is_near=is_near)))
            for index, robot in enumerate(robots)
        )

    def is_at(active: Mapping[str, str], place: Place, *, is_near: bool) -> bool:
        return place[0] in active if is_near else active.get(place[0]) == place[1]

    lines = [f"byte at[{len(robots)}];"]
    for index, robot in enumerate(robots):
        lines += [f"active proctype robot{index}() {{ do"]
        for (source, place), target in robot.moves.items():
            rule = places.get(place)
            if rule is None or not rule.is_barrier:
                room = f" && {count(place, is_near=False)} < {rule.number}" if rule else ""
                lines.append(f":: atomic {{ at[{index}] == {source}{room} -> at[{index}] = {target} }}")
        lines += [":: false od }"]
    for number, (place, rule) in enumerate(places.items()):
        if not rule.is_barrier:
            continue
        ready = [{a: b for (a, entered), b in robot.moves.items() if entered == place} for robot in robots]
        waiting = " + ".join(among(index, each) for index, each in enumerate(ready))
        inside, near = count(place, is_near=False), count(place, is_near=True)
        lines.append(
            f"active proctype meet{number}() {{ do :: atomic {{ {near} >= {rule.number} && {waiting} > 0 "
            f"&& {waiting} + {inside} == {near} ->"
        )
        for index, targets in enumerate(ready):
            options = " ".join(f":: at[{index}] == {a} -> at[{index}] = {b}" for a, b in targets.items())
            lines.append(f"if {options} :: else fi;")
        lines.append("skip } :: false od }")
    values = ", ".join(f"now.at[{index}]" for index in range(len(robots)))
    shown = " ".join("%d" for _robot in robots)
    lines.append(f'active proctype watch() {{ timeout -> c_code {{ printf("@{shown}\\n", {values}); }} }}')
    return "\n".join(lines) + "\n"


def run_spin(text: str, *arguments: str) -> SpinRun:
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "team.pml").write_text(text, encoding="utf-8")
        started = _children_time()
        for command in (["spin", "-a", "team.pml"], ["gcc", "-w", "-O1", *_OPTIONS, "-o", "pan", "pan.c"]):
            subprocess.run(command, cwd=folder, check=True, capture_output=True)
        compiled = _children_time()
        ran = subprocess.run(["./pan", *arguments], cwd=folder, check=True, capture_output=True, text=True)
        ended = _children_time()
    return SpinRun(output=ran.stdout, compile_time=compiled - started, time=ended - compiled)


def _children_time() -> float:
    used = getrusage(RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def export() -> None:
    """SPIN searches what is exported."""
    project = open_project(MEETING).project
    design = next(each for each in project.designs if each.component == "meet")
    leaves = Transition(to="stop", guard=Guard(after="20"))
    states = tuple(
        replace(state, transitions=(*state.transitions, leaves)) if state.name == "to_meeting" else state
        for state in design.states
    )
    variant = replace(design, states=states)
    for name, each in (("designs/meeting", design), ("with a timeout before the meeting", variant)):
        others = tuple(other for other in project.designs if other.component != "meet")
        ran = run_spin(write_promela(replace(project, designs=(*others, each)), each))
        verdict = "deadlock" if "invalid end state" in ran.output.split("Full statespace")[0] else "no deadlock"
        print(f"export of meet, {name}: {verdict}, {ran.stored} states")


if __name__ == "__main__":
    main()
