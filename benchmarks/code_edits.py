"""CPU time of `vicode sync` as a whole process, for edits of a generated Python file with 10 to 1000 states.

`python -m benchmarks.code_edits [--rounds N] [--states N …]`. Each state has three transitions and a region. Edits:
none; the code of one region; the guard of one transition; all methods in another order. Times are medians of user and
system time, so that other programs on the machine disturb them less.
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

_METHOD = re.compile(r"^(?=    def _)", re.MULTILINE)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--states", type=int, nargs="*", default=(10, 60, 200, 1000))
    arguments = parser.parse_args()
    print(f"{'states':>8}" + "".join(f"{name:>10}" for name in EDITS))
    for states in arguments.states:
        times = (median(_measure(states, edit) for _ in range(arguments.rounds)) for edit in EDITS.values())
        print(f"{states:8}" + "".join(f"{seconds:10.2f}" for seconds in times), flush=True)


def _measure(states: int, edit: Callable[[str], str]) -> float:
    """Return the time of `vicode sync` after an edit, which must leave the code and the design equal."""
    with tempfile.TemporaryDirectory() as folder:
        design = Path(folder, "machine.yaml")
        action = "      - set: {count: count + 1}"
        text = make_design(states).replace(action, f"{action}\n      - code: {{python: self.x += 1}}")
        design.write_text(text, encoding="utf-8")
        command = [sys.executable, "-m", "vicode", "sync", str(design), "--outside-regions"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        (file,) = Path(folder).glob("generated/python/*/machine.py")
        file.write_text(edit(file.read_text(encoding="utf-8")), encoding="utf-8")
        seconds = measure_process(command)
        subprocess.run([*command[:-1], "--check"], check=True, stdout=subprocess.DEVNULL)
        return seconds


def _edit_region(text: str) -> str:
    place = text.rindex("self.x += 1")
    return f"{text[:place]}self.x += 2{text[place + len('self.x += 1') :]}"


def _edit_guard(text: str) -> str:
    place = text.rindex("self.count > 2")
    return f"{text[:place]}self.count > 3{text[place + len('self.count > 2') :]}"


def _shuffle_methods(text: str) -> str:
    head, *methods = _METHOD.split(f"{text}\n")
    random.Random(0).shuffle(methods)
    return f"{head}{''.join(methods).rstrip()}\n"


EDITS: dict[str, Callable[[str], str]] = {
    "none": lambda text: text,
    "region": _edit_region,
    "guard": _edit_guard,
    "shuffled": _shuffle_methods,
}


if __name__ == "__main__":
    main()
