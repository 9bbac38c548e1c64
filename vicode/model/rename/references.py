"""The symbols that can be renamed and their kinds of references."""

from dataclasses import dataclass
from enum import StrEnum


@dataclass(frozen=True, slots=True, kw_only=True)
class SymbolRef:
    """A declared symbol.

    `component` is the declaring component, "" for the project. `section` is the key that contains it: `uses`,
    `parameters`, `outputs`, `variables`, or in the project `constants`, `enumerations`, `components`, `agents`.
    `owner` is the enumeration of an element (section `elements`), or the output of an argument (section `arguments`).
    """

    section: str
    name: str
    component: str = ""
    owner: str = ""


class ReferenceKind(StrEnum):
    """The syntactic form of a reference in a design."""

    OWN = "own"
    """NAME; in code `self.NAME`."""
    CONSTANT = "constant"
    """NAME, also in code."""
    ALIAS = "alias"
    """NAME before a dot, in `done(NAME)`, links and calls; in code `self.NAME`."""
    MEMBER = "member"
    """NAME after an alias and a dot."""
    PARAMETER = "parameter"
    """A parameter in a call of an alias."""
    ARGUMENT = "argument"
    """A keyword argument in a call of `alias.function`."""
    ENUMERATION = "enumeration"
    """NAME before a dot, and as a type."""
    ELEMENT = "element"
    """NAME after an enumeration and a dot."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReferenceRename:
    """The rename of one kind of reference; `owner` is the name before the dot."""

    kind: ReferenceKind
    old: str
    new: str
    owner: str = ""
