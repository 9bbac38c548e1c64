"""CPU time of `vicode gen` as a whole process, from 10 to 5000 states with 3 transitions each.

`python -m benchmarks.generation [--rounds N]`; the first line is the interpreter alone. Times are medians of user and
system time, so that other programs on the machine disturb them less.
"""

import argparse
import random
import subprocess
import sys
import tempfile
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from statistics import median

STATES = (10, 100, 1000, 5000)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=7)
    rounds = parser.parse_args().rounds
    print(f"{'states':>8} {'CPU s':>8} {'ms/state':>9}")
    print(f"{'python':>8} {median(measure_process([sys.executable, '-c', 'pass']) for _ in range(rounds)):8.2f}")
    with tempfile.TemporaryDirectory() as folder:
        for states in STATES:
            design = Path(folder, f"states_{states}", "machine.yaml")
            design.parent.mkdir()
            design.write_text(make_design(states), encoding="utf-8")
            seconds = median(measure_generation(design) for _ in range(rounds))
            print(f"{states:8} {seconds:8.2f} {seconds / states * 1000:9.2f}")


def measure_generation(design: Path) -> float:
    with tempfile.TemporaryDirectory() as out:
        return measure_process([sys.executable, "-m", "vicode", "gen", str(design), "--out", out])


def measure_process(command: list[str]) -> float:
    """Return the user and system time of a process in seconds."""
    before = getrusage(RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = getrusage(RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def make_design(states: int) -> str:
    """Return a design in which each state has a transition to the next state and two to random other states."""
    chance = random.Random(states)
    lines = ["vicode: 1", "component: Machine", "outputs:", "  count: {type: int}", "  x: {type: float}"]
    lines += ["initial: S0", "states:"]
    for state in range(states):
        targets = [(state + offset) % states for offset in (1, *(chance.randrange(1, states) for _ in range(2)))]
        lines += [f"  S{state}:", "    transitions:"]
        for number, target in enumerate(targets):
            lines += [f"      - to: S{target}", f"        when: count > {number} and x < {state}"]
        lines += ["    actions:", "      - set: {count: count + 1}"]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
