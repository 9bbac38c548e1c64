"""Which thing is renamed, and how one design says it."""

from dataclasses import dataclass
from enum import StrEnum


@dataclass(frozen=True, slots=True, kw_only=True)
class SymbolRef:
    """A thing that is declared under a name.

    `component` declares it, "" the project. `section` is the key it stands below: `uses`, `parameters`, `outputs`,
    `variables`; of the project `constants`, `enumerations`, `components`, `agents`. `owner` is the enumeration of an
    element (section `elements`), or the output of an argument (section `arguments`).
    """

    section: str
    name: str
    component: str = ""
    owner: str = ""


class ReferenceKind(StrEnum):
    """How a name is said in a design."""

    OWN = "own"
    """By itself; in code as `self.NAME`."""
    CONSTANT = "constant"
    """By itself, in code, too."""
    ALIAS = "alias"
    """Before a dot, in `done(NAME)`, links and calls; in code as `self.NAME`."""
    MEMBER = "member"
    """Behind the dot of an alias."""
    PARAMETER = "parameter"
    """What is given to an alias where it is called."""
    ARGUMENT = "argument"
    """Before the sign = in a call of `alias.function`."""
    ENUMERATION = "enumeration"
    """Before a dot, and as a type."""
    ELEMENT = "element"
    """Behind the dot of an enumeration."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReferenceRename:
    """A name as one design says it, and the new one; `owner` is what stands before its dot."""

    kind: ReferenceKind
    old: str
    new: str
    owner: str = ""
