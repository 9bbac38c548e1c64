"""Recorded cases of the original compiler and engine: small programs with results, complete behaviors with traces."""

import gzip
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from vicode.xabsl.engine.replay import ReplayRobot
from vicode.xabsl.parser import parse
from vicode.xabsl.source_loader import ParseText, ProgramSource, load_source

CASES = Path(__file__).parent / "cases"
PROGRAMS = sorted(path.name for path in (CASES / "programs").iterdir())


@dataclass(frozen=True)
class Probe:
    """A small program with the result of the original compiler."""

    name: str
    files: dict[str, str]
    accepted: bool
    message: str
    code: str


def read_probes() -> list[Probe]:
    raw = json.loads((CASES / "probes.json").read_text(encoding="utf-8"))
    return [
        Probe(entry["name"], entry["files"], entry["accepted"], entry["message"], entry["code_of_states_one_and_two"])
        for entry in raw
    ]


def load_texts(files: dict[str, str], main: str = "agents.xabsl", parse_text: ParseText = parse) -> ProgramSource:
    """Load a program from texts by file name."""
    root = Path("/behavior")

    def read(path: Path) -> str:
        text = files.get(str(path.relative_to(root)))
        if text is None:
            raise FileNotFoundError(2, "No such file or directory")
        return text

    return load_source(root / main, read, parse_text)


def read_case(program: str, name: str) -> str:
    """Read a file of a recorded program, compressed or not."""
    path = CASES / "programs" / program / name
    if path.exists():
        return path.read_text(encoding="utf-8")
    with gzip.open(f"{path}.gz", "rt", encoding="utf-8") as file:
        return file.read()


def original_record(robot: ReplayRobot, cycle: int) -> dict[str, Any]:
    """The last cycle in the form in which the traces of the original engine are recorded."""
    engine, values = robot.engine, {}

    def node(each: list[Any]) -> list[Any]:
        match each[0]:
            case "s":
                values[each[1]] = robot._json_value(robot._kinds[each[1]], each[2])
                return ["s", each[1], values[each[1]]]
            case "b":
                return ["b", each[1], each[2], robot._parameters("", each[3])]
        return [*each[:5], robot._parameters("", each[5]), [node(child) for child in each[6]]]

    nodes = [node(each) for each in engine.trace]
    record = {"c": cycle, "t": robot.now, "agent": engine.agent, "tree": nodes, "out": values}
    return {**record, "err": engine.errors} if engine.errors else record


def parse_words(code: str) -> list[Any]:
    """Split intermediate code into words; numbers become floats."""
    plain = " ".join(line for line in code.splitlines() if not line.startswith("//"))
    return [_number(word) for word in plain.split()]


def _number(word: str) -> float | str:
    try:
        return float(word)
    except ValueError:
        return word
