"""The symbol table of a program. Names are unique within one kind of declaration, not across kinds."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from vicode.xabsl import tree
from vicode.xabsl.lexer import Tokens

DECIMAL, BOOLEAN, ENUM = "d", "b", "e"

_KIND_LETTERS = {"float": DECIMAL, "bool": BOOLEAN, "enum": ENUM}
KIND_NAMES = {DECIMAL: "decimal", BOOLEAN: "bool", ENUM: "enum"}


@dataclass(slots=True, eq=False)
class Definition:
    """A declared name. `role` is input, output, internal, const, parameter, option, behavior, enum, …

    `kind` is the type of its value: "d" (decimal), "b" (bool) or "e" (element of the enumeration `enum`).
    `qualified_name` is its name in intermediate code. `parameters` are keyed by the names that calls use.
    """

    role: str
    name: str
    tokens: Tokens
    name_node: tree.NameNode
    node: tree.SyntaxNode
    kind: str = ""
    enum: str = ""
    qualified_name: str = ""
    parameters: "dict[str, Definition]" = field(default_factory=dict)
    elements: "dict[str, Definition]" = field(default_factory=dict)
    states: "dict[str, Definition]" = field(default_factory=dict)

    @property
    def description(self) -> str:
        """Kind and role for messages: "bool input", "option"."""
        return f"{KIND_NAMES[self.kind]} {self.role}" if self.kind else self.role


@dataclass(slots=True)
class SymbolTable:
    """All definitions of a program. Lists hold the definitions of several kinds that share a name."""

    readable: dict[str, list[Definition]] = field(default_factory=dict)
    assignable: dict[str, list[Definition]] = field(default_factory=dict)
    callable: dict[str, list[Definition]] = field(default_factory=dict)
    enums: dict[str, Definition] = field(default_factory=dict)
    options: dict[str, Definition] = field(default_factory=dict)
    behaviors: dict[str, Definition] = field(default_factory=dict)
    agents: dict[str, Definition] = field(default_factory=dict)

    def symbols(self, *roles: str) -> Iterator[Definition]:
        """Yield symbols and constants of these roles in the order of their declaration."""
        for definitions in self.readable.values():
            yield from (definition for definition in definitions if definition.role in roles)


def resolve_type(type_node: tree.TypeNode | None) -> tuple[str, str]:
    """Kind and enumeration of a declared type; decimal if there is none."""
    if type_node is None:
        return DECIMAL, ""
    return _KIND_LETTERS[type_node.text], type_node.enum.text if type_node.enum else ""
