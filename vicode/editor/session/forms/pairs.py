"""Lines `name = expression`, the text of assignments and of the parameters of calls.

A text with a line that cannot be read is refused as a whole: the design keeps what it had, and the user sees why.
"""

import re
from collections.abc import Sequence

Pairs = tuple[tuple[str, str], ...]

PAIR = re.compile(r"[ \t]*(?P<name>[^=:\n]*?)[ \t]*[=:][ \t]*(?P<value>.*?)[ \t]*$", re.MULTILINE)
"""A line, with the sign "=" or ":"."""


def format_pairs(pairs: Pairs) -> str:
    return "\n".join(f"{name} = {value}" for name, value in pairs)


def parse_pairs(text: str) -> Pairs:
    """The pairs of a text without errors."""
    found = (PAIR.fullmatch(line) for line in text.splitlines() if line.strip())
    return tuple((each["name"], each["value"]) for each in found if each is not None)


def find_error(text: str) -> str:
    """Why a text cannot be read, with the number of the line if there are several; "" if it can."""
    lines = text.splitlines()
    names: set[str] = set()
    for number, line in enumerate(lines, start=1):
        if line.strip() and (reason := _error_in(line, names)):
            return f"line {number}: {reason}" if len(lines) > 1 else reason
    return ""


def find_lost_pairs(pairs: Pairs) -> str:
    """Why pairs of a file cannot be edited as text, such as a name with a line break; "" if they can."""
    if _normalized(parse_pairs(format_pairs(pairs))) == _normalized(pairs):
        return ""
    return "this was written in a form that cannot be edited here: edit it in the file"


def _error_in(line: str, names: set[str]) -> str:
    found = PAIR.fullmatch(line)
    if found is None:
        return f"write {line.split(maxsplit=1)[0]} = followed by an expression"
    name, value = found["name"], found["value"]
    if not name:
        return "write a name before the sign ="
    if not value:
        return f"write an expression after {name} ="
    if value.startswith("="):
        return "write one = between name and expression"
    if name in names:
        return f"{name} is set twice: remove one of the lines"
    names.add(name)
    return ""


def _normalized(pairs: Sequence[tuple[str, str]]) -> list[tuple[str, str]]:
    return [(name, " ".join(value.split())) for name, value in pairs]
