"""Names of XABSL, which may hold dots and begin with an underscore, as names of designs."""

import keyword
import re

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
"""Words that mean something else in designs or in what is generated from them."""


class DesignNames:
    """Gives names out, none twice; case does not tell two apart, as it does not in some file systems."""

    def __init__(self, taken: frozenset[str] = frozenset()) -> None:
        """Begin with names that nobody gets."""
        self._taken = {name.casefold() for name in taken}

    def allocate(self, wanted: str) -> str:
        """A free name like the one of XABSL."""
        stem = to_design_name(wanted)
        name, number = stem, 1
        while name.casefold() in self._taken:
            number += 1
            name = f"{stem}_{number}"
        self._taken.add(name.casefold())
        return name


def to_design_name(text: str) -> str:
    """The nearest name that a design may have."""
    stem = re.sub(r"[^A-Za-z0-9_]", "_", text).strip("_")[:_MAX_LENGTH] or "x"
    if not is_valid_name(stem):
        stem = f"x_{stem}"
    return f"{stem}_" if stem in _RESERVED else stem


def to_design_number(text: str) -> str:
    """A number as a design may have it; whole ones that not every language holds exactly are decimals."""
    if text.endswith("."):
        return f"{text}0"
    return f"{text}.0" if "." not in text and abs(int(text)) > _MAX_INTEGER else text


def xabsl_name_or_empty(name: str, written: str) -> str:
    """The name in XABSL where it is another one, else nothing."""
    return "" if name == written else written
