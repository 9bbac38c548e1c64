"""What a program declares, by kind and name; declarations of one kind may not share a name, those of two may."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from vicode.xabsl import tree
from vicode.xabsl.lexer import Tokens

DECIMAL, BOOLEAN, ENUM = "d", "b", "e"

_KIND_LETTERS = {"float": DECIMAL, "bool": BOOLEAN, "enum": ENUM}
KIND_NAMES = {DECIMAL: "decimal", BOOLEAN: "bool", ENUM: "enum"}


@dataclass(slots=True, eq=False)
class Definition:
    """One declaration. `role` is what it is: input, output, internal, const, parameter, option, behavior, enum, …

    `kind` is "d", "b" or "e" for what has a value, `enum` the enumeration of "e". `qualified_name` is its name in intermediate
    code. `parameters` are those of options, behaviors and input symbols by the names used in calls.
    """

    role: str
    name: str
    tokens: Tokens
    name_node: tree.NameNode
    """Where its name stands."""
    node: tree.SyntaxNode
    kind: str = ""
    enum: str = ""
    qualified_name: str = ""
    parameters: "dict[str, Definition]" = field(default_factory=dict)
    elements: "dict[str, Definition]" = field(default_factory=dict)
    states: "dict[str, Definition]" = field(default_factory=dict)

    @property
    def description(self) -> str:
        """What it is, in words: "bool input", "option"."""
        return f"{KIND_NAMES[self.kind]} {self.role}" if self.kind else self.role


@dataclass(slots=True)
class SymbolTable:
    """All declarations of a program; names lead to lists, since those of several kinds may share one."""

    readable: dict[str, list[Definition]] = field(default_factory=dict)
    assignable: dict[str, list[Definition]] = field(default_factory=dict)
    callable: dict[str, list[Definition]] = field(default_factory=dict)
    enums: dict[str, Definition] = field(default_factory=dict)
    options: dict[str, Definition] = field(default_factory=dict)
    behaviors: dict[str, Definition] = field(default_factory=dict)
    agents: dict[str, Definition] = field(default_factory=dict)

    def symbols(self, *roles: str) -> Iterator[Definition]:
        """Symbols and constants of these roles, in the order of their declaration."""
        for found in self.readable.values():
            yield from (each for each in found if each.role in roles)


def resolve_type(of: tree.TypeNode | None) -> tuple[str, str]:
    """Letter and enumeration of a declared type; nothing said means decimal."""
    if of is None:
        return DECIMAL, ""
    return _KIND_LETTERS[of.text], of.enum.text if of.enum else ""
