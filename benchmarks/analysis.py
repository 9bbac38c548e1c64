"""The time that `vicode.analysis` takes to judge all decisions of a state machine, and pyfcstm on the same machine.

`python -m benchmarks.analysis [STATES …] [--rounds N] [--pyfcstm COMMAND] [--foreign-rounds N]`: machines with 4
transitions per state, whose guards compare 8 inputs; some guards never hold, always hold, or are shadowed. Times are
processor times: `analysis` is that of the verdicts alone with expressions not yet parsed, `process` that of a process
that reads the YAML file and prints the verdicts.

With the command of pyfcstm 0.6 ("venv/bin/pyfcstm", say) the verdicts are compared. It knows no
ranges. So it reads each machine twice: as it is, compared with the design without ranges, and with the ranges as part
of each guard, where no guard always holds. Differences are printed.
"""

import argparse
import json
import random
import re
import shlex
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from statistics import median

from vicode.analysis.guards import Verdict, analyze_guards
from vicode.model.design import Declaration, Design, Guard, State, Transition
from vicode.model.expressions import parse_expression
from vicode.model.project import Project
from vicode.store import read_design, save_design

STATES = (30, 100, 300, 1000)
TRANSITIONS = 4
FLOATS: Mapping[str, tuple[float, float]] = {
    "speed": (0, 10),
    "distance": (0, 100),
    "angle": (-180, 180),
    "battery": (0, 1),
}
INTS: Mapping[str, tuple[int, int]] = {"count": (0, 5), "mode": (0, 3)}
BOOLS = ("seen", "ready")
RANGES = {**FLOATS, **INTS}
CODES = {"W_DEAD_GUARD": "dead", "W_TRANSITION_SHADOWED": "shadowed", "W_GUARD_TAUTOLOGY": "tautology"}
KINDS = {
    Verdict.NEVER_HOLDS: "dead",
    Verdict.SHADOWED: "shadowed",
    # Where earlier guards cover all cases, a guard is shadowed by them as well.
    Verdict.NEVER_TESTED: "shadowed",
    Verdict.ALWAYS_HOLDS: "tautology",
}

Edge = tuple[int, str]
"""The number of the target, and the guard."""
Machine = Sequence[Sequence[Edge]]
Verdicts = dict[tuple[str, int], str]
"""What is proved about a transition of a state: a value of `CODES`."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("states", nargs="*", type=int, default=STATES)
    parser.add_argument("--rounds", type=int, default=5, help="medians of so many rounds are shown (5)")
    parser.add_argument("--pyfcstm", metavar="COMMAND", type=shlex.split, help="the command of pyfcstm")
    parser.add_argument("--foreign-rounds", type=int, default=1, help="rounds of pyfcstm (1)")
    parser.add_argument("--judge", metavar="FILE", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.judge:
        print(Counter(judge(read(options.judge)).values()))
        return
    if not options.pyfcstm:
        print("pyfcstm is skipped: pass its command with --pyfcstm")
    print("| states | guards | dead / shadowed / tautology | analysis | process | pyfcstm | times as long |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for states in options.states:
            measure(make_machine(states), Path(folder), options)


# Machines


def make_machine(states: int) -> Machine:
    chance = random.Random(states)
    machine = []
    for number in range(states):
        guards: list[str] = []
        for _ in range(TRANSITIONS):
            guards.append(make_guard(chance, guards))
        targets = [number + 1, *(chance.randrange(states) for _ in range(TRANSITIONS - 1))]
        machine.append([(target % states, guard) for target, guard in zip(targets, guards, strict=True)])
    return machine


def make_guard(chance: random.Random, earlier: Sequence[str]) -> str:
    """A guard, of which some are dead, shadowed or always hold; many of these need the ranges."""
    kind = chance.random()
    if kind < 0.03:
        name, (low, high) = chance.choice(list(FLOATS.items()))
        middle = number_between(chance, low, high)
        return (
            f"({make_condition(chance)}) and {name} < {middle} and {name} > {middle + chance.choice((0, high - low))}"
        )
    if kind < 0.05:
        name, (_, high) = chance.choice(list(RANGES.items()))
        return f"{name} > {high + 1} and ({make_condition(chance)})"
    if kind < 0.10 and earlier:
        return f"({chance.choice(earlier)}) and {make_atom(chance)}"
    if kind < 0.12 and len(earlier) > 1:
        return f"({earlier[0]} and {make_atom(chance)}) or ({earlier[1]} and {make_atom(chance)})"
    if kind < 0.13:
        name, (low, high) = chance.choice(list(FLOATS.items()))
        limit = number_between(chance, low, high)
        return f"{name} < {limit} or {name} >= {limit}"
    if kind < 0.14:
        name, (low, _) = chance.choice(list(RANGES.items()))
        return f"{name} >= {low} or {make_atom(chance)}"
    return make_condition(chance)


def make_condition(chance: random.Random) -> str:
    atoms = [make_atom(chance) for _ in range(chance.choice((1, 2, 2, 2, 3, 3)))]
    if len(atoms) == 3 and chance.random() < 0.4:
        return f"{atoms[0]} and ({atoms[1]} or {atoms[2]})"
    return chance.choice((" and ", " and ", " and ", " or ")).join(atoms)


def make_atom(chance: random.Random) -> str:
    kind = chance.randrange(8)
    if kind < 4:
        name, (low, high) = chance.choice(list(FLOATS.items()))
        return f"{name} {chance.choice(('<', '<=', '>', '>='))} {number_between(chance, low, high)}"
    if kind < 6:
        name, bounds = chance.choice(list(INTS.items()))
        return f"{name} {chance.choice(('==', '!=', '<', '>='))} {chance.randint(*bounds)}"
    name = chance.choice(BOOLS)
    return name if kind == 6 else f"not ({name})"


def number_between(chance: random.Random, low: float, high: float) -> float:
    """One of 20 steps."""
    return round(low + (high - low) * chance.randint(1, 19) / 20, 2)


def make_design(machine: Machine, *, has_ranges: bool) -> Design:
    inputs = [
        *(
            Declaration(name=name, type="float", range=limits if has_ranges else None)
            for name, limits in FLOATS.items()
        ),
        *(Declaration(name=name, type="int", range=limits if has_ranges else None) for name, limits in INTS.items()),
        *(Declaration(name=name, type="bool") for name in BOOLS),
    ]
    states = [
        State(
            name=f"S{number}",
            transitions=tuple(Transition(to=f"S{target}", guard=Guard(when=guard)) for target, guard in edges),
        )
        for number, edges in enumerate(machine)
    ]
    return Design(component="Machine", parameters=tuple(inputs), initial="S0", states=tuple(states))


def make_foreign_text(machine: Machine, *, has_ranges: bool) -> str:
    """The machine as text of pyfcstm: a bool is an int that is positive; each transition has a line."""
    names = "|".join(BOOLS)
    is_in_range = " and ".join(f"{name} >= {low} and {name} <= {high}" for name, (low, high) in RANGES.items())
    lines = [f"def float {name} = 0;" for name in FLOATS]
    lines += [f"def int {name} = 0;" for name in (*INTS, *BOOLS)]
    lines += ["state Machine {", "[*] -> S0;", *(f"state S{number};" for number in range(len(machine)))]
    for number, edges in enumerate(machine):
        for target, guard in edges:
            written = re.sub(rf"\b({names})\b", r"(\1 > 0)", guard)
            limited = f"{is_in_range} and ({written})" if has_ranges else written
            lines.append(f"S{number} -> S{target} : if [{limited}];")
    return "\n".join((*lines, "}"))


# Verdicts and times


def judge(design: Design) -> Verdicts:
    project = Project(name="bench", designs=(design,))
    found: Verdicts = {}
    for each in analyze_guards(project, design).find_verdicts():
        _states, state, _transitions, index = each.path
        found[str(state), int(str(index))] = KINDS[each.verdict]
    return found


def read(file: Path) -> Design:
    design = read_design(file.read_text("utf-8")).design
    assert design is not None
    return design


def measure(machine: Machine, folder: Path, options: argparse.Namespace) -> None:
    design = make_design(machine, has_ranges=True)
    file = folder / "Machine.yaml"
    file.write_text(save_design(design), "utf-8")
    judged = judge(design)

    def analyze() -> None:
        parse_expression.cache_clear()
        judge(design)

    own_s = median(measure_cpu(analyze) for _ in range(options.rounds))
    command = [sys.executable, "-m", "benchmarks.analysis", "--judge", str(file)]
    process_s = median(measure_process(command) for _ in range(options.rounds))
    guards = sum(map(len, machine))
    row = f"| {len(machine)} | {guards} | {count(judged)} | {own_s:.2f} s | {process_s:.2f} s |"
    if not options.pyfcstm:
        print(f"{row} | |", flush=True)
        return
    differences, times = [], []
    for has_ranges in (False, True):
        ours = judged if has_ranges else judge(make_design(machine, has_ranges=False))
        theirs, seconds = judge_foreign(machine, options, folder, has_ranges=has_ranges)
        times.append(seconds)
        differences += compare(ours, theirs, machine, has_ranges=has_ranges)
    print(
        f"{row} {times[0]:.1f} s | {times[0] / process_s:.0f} × ({times[0] / own_s:.0f} × the analysis) |", flush=True
    )
    print(f"  with the ranges in each guard: {times[1]:.1f} s, {times[1] / process_s:.0f} ×; ", end="")
    print(f"{len(differences)} differences", *differences, sep="\n  ", flush=True)


def count(verdicts: Verdicts) -> str:
    found = Counter(verdicts.values())
    return " / ".join(str(found[kind]) for kind in CODES.values())


def measure_cpu(function: Callable[[], object]) -> float:
    start_s = time.process_time()
    function()
    return time.process_time() - start_s


def measure_process(command: Sequence[str]) -> float:
    """The user and system time of a process in seconds."""
    before = getrusage(RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = getrusage(RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def judge_foreign(
    machine: Machine, options: argparse.Namespace, folder: Path, *, has_ranges: bool
) -> tuple[dict[tuple[str, int], set[str]], float]:
    """The verdicts of pyfcstm, of which a transition may have several, and the time of its process in seconds."""
    file, report = folder / "machine.fcstm", folder / "report.json"
    text = make_foreign_text(machine, has_ranges=has_ranges)
    file.write_text(text, "utf-8")
    flags = ["--enable-verify", "--max-complexity-tier", "smt_linear", "--format", "json"]
    command = [*options.pyfcstm, "inspect", "-i", str(file), *flags, "-o", str(report)]
    seconds = median(measure_process(command) for _ in range(options.foreign_rounds))
    lines = text.split("\n")
    found: dict[tuple[str, int], set[str]] = {}
    for each in json.loads(report.read_text("utf-8"))["diagnostics"]:
        if each["code"] in CODES:
            line = each["span"]["line"]
            state = lines[line - 1].split()[0]
            first = next(number for number, text in enumerate(lines) if text.startswith(f"{state} ->"))
            found.setdefault((state, line - 1 - first), set()).add(CODES[each["code"]])
    return found, seconds


def compare(
    ours: Verdicts, theirs: Mapping[tuple[str, int], set[str]], machine: Machine, *, has_ranges: bool
) -> list[str]:
    """Each transition with different verdicts; a shadowed guard may be a tautology as well."""
    differences = []
    for key in sorted({*ours, *theirs}):
        own, foreign = ours.get(key, "none"), theirs.get(key, {"none"})
        if has_ranges and own == "tautology":
            own = "none"
        if own != ("shadowed" if "shadowed" in foreign else min(foreign)):
            state, index = key
            guards = [guard for _, guard in machine[int(state[1:])][: index + 1]]
            differences.append(f"{'with' if has_ranges else 'no'} ranges, {key}: {own}, pyfcstm {foreign}: {guards}")
    return differences


if __name__ == "__main__":
    main()
