"""CPU time of `vicode sync` as a whole process, for edits of a generated C++ source with 10 to 1000 states.

`python -m benchmarks.cpp_edits [--rounds N] [--states N …]`. Each state has three transitions and a region. Edits:
none; the code of one region; the guard of one transition; all functions in another order. Times are medians of user
and system time, so that other programs on the machine disturb them less.
"""

import argparse
import random
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from statistics import median

from benchmarks.generation import make_design, measure_process

PROJECT = "vicode: 1\nproject: Machines\nlanguages: [cpp]\n"
_FUNCTION = re.compile(r"^\n(?=\S.*::.*\{$)", re.MULTILINE)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--states", type=int, nargs="*", default=(10, 200, 1000))
    arguments = parser.parse_args()
    print(f"{'states':>8}" + "".join(f"{name:>10}" for name in EDITS))
    for states in arguments.states:
        times = (median(_measure(states, edit) for _ in range(arguments.rounds)) for edit in EDITS.values())
        print(f"{states:8}" + "".join(f"{seconds:10.2f}" for seconds in times), flush=True)


def _measure(states: int, edit: Callable[[str], str]) -> float:
    with tempfile.TemporaryDirectory() as folder:
        action = "      - set: {count: count + 1}"
        text = make_design(states).replace(action, f"{action}\n      - code: {{cpp: x += 1;}}")
        Path(folder, "project.yaml").write_text(PROJECT, encoding="utf-8")
        Path(folder, "machine.yaml").write_text(text, encoding="utf-8")
        command = [sys.executable, "-m", "vicode", "sync", folder, "--outside-regions"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        (file,) = Path(folder).glob("generated/cpp/*/machine.cpp")
        file.write_text(edit(file.read_text(encoding="utf-8")), encoding="utf-8")
        return measure_process(command)


def _edit_region(text: str) -> str:
    before, _old, after = text.rpartition("x += 1;")
    return f"{before}x += 2;{after}"


def _edit_guard(text: str) -> str:
    before, _old, after = text.rpartition("count > 2")
    return f"{before}count > 3{after}"


def _shuffle_functions(text: str) -> str:
    head, *functions = _FUNCTION.split(text)
    *others, last = functions
    random.Random(0).shuffle(others)
    return "\n".join([head, *others, last])


EDITS: dict[str, Callable[[str], str]] = {
    "none": lambda text: text,
    "region": _edit_region,
    "guard": _edit_guard,
    "shuffled": _shuffle_functions,
}


if __name__ == "__main__":
    main()
