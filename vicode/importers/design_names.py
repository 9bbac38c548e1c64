"""Convert XABSL names, which may contain dots and start with an underscore, to design names."""

import keyword
import re
from collections.abc import Iterable, Iterator
from pathlib import PurePosixPath

from vicode.bica import RESERVED_NAMES
from vicode.model.expressions import FUNCTIONS
from vicode.model.names import is_valid_name
from vicode.xabsl.tokens import KEYWORDS

_MAX_LENGTH = 70
_MAX_INTEGER = 2**53
_RESERVED = frozenset(
    {
        *keyword.kwlist,
        *RESERVED_NAMES,
        *FUNCTIONS,
        *KEYWORDS,
        *("True", "False", "None", "true", "false", "bool", "int", "float", "done", "self", "mro", "action_done"),
    }
)
"""Names with another meaning in designs or generated code."""


class DesignNames:
    """Allocates names that are unique ignoring case, since some file systems ignore it.

    Args:
        taken: Names that are in use.
        keywords: Names that get a trailing `_`, in addition to those that have another meaning in designs.
    """

    def __init__(self, taken: frozenset[str] = frozenset(), keywords: frozenset[str] = frozenset()) -> None:
        self._taken = {name.casefold() for name in taken}
        self._keywords = keywords

    def allocate(self, xabsl_name: str) -> str:
        """Return an unused design name derived from an XABSL name."""
        stem = to_design_name(xabsl_name)
        stem = f"{stem}_" if stem in self._keywords else stem
        name, number = stem, 1
        while name.casefold() in self._taken:
            number += 1
            name = f"{stem}_{number}"
        self._taken.add(name.casefold())
        return name


def design_files(stems: Iterable[str]) -> Iterator[str]:
    """The paths of designs, which are unique ignoring case; none is that of a project file."""
    taken = set[str]()
    for stem in stems:
        name, number = stem, 1
        while name.casefold() in taken or PurePosixPath(name).name.casefold() == "project":
            number += 1
            name = f"{stem}_{number}"
        taken.add(name.casefold())
        yield f"{name}.yaml"


def to_design_name(text: str) -> str:
    """Convert an XABSL name to a similar valid design name."""
    stem = re.sub(r"[^A-Za-z0-9_]", "_", text).strip("_")[:_MAX_LENGTH] or "x"
    if not is_valid_name(stem):
        stem = f"x_{stem}"
    return f"{stem}_" if stem in _RESERVED else stem


def to_design_number(text: str) -> str:
    """Convert a number literal; an integer above 2**53 becomes a float, since not every language represents it."""
    if text.endswith("."):
        return f"{text}0"
    return f"{text}.0" if "." not in text and abs(int(text)) > _MAX_INTEGER else text


def xabsl_name_or_empty(name: str, xabsl_name: str) -> str:
    """Return the XABSL name if it differs from the design name."""
    return "" if name == xabsl_name else xabsl_name
