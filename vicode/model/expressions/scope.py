"""The names available in expressions of a design, with their types."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from vicode.model.design import Declaration, Design
from vicode.model.expressions.tree import BOOL, FLOAT, INT, UNKNOWN
from vicode.model.project import Interface, Project


class ScopeSymbolKind(StrEnum):
    """The kind of an unqualified name."""

    PARAMETER = "parameter"
    OUTPUT = "output"
    VARIABLE = "variable"
    CONSTANT = "constant"


@dataclass(frozen=True, slots=True, kw_only=True)
class ScopeSymbol:
    """An unqualified name with its kind, type and declaration."""

    kind: ScopeSymbolKind
    type: str
    declaration: Declaration


@dataclass(frozen=True, slots=True, kw_only=True)
class Scope:
    """The readable names: symbols, used components by alias (None: unknown component), and enumerations."""

    symbols: Mapping[str, ScopeSymbol] = field(default_factory=dict)
    uses: Mapping[str, Interface | None] = field(default_factory=dict)
    enumerations: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def type_of(self, declaration: Declaration) -> str:
        return infer_declaration_type(declaration, self.enumerations)

    def find_assignable(self, name: str) -> Declaration | None:
        """Return the variable or output that an assignment sets, which may be `alias.variable`."""
        alias, dot, variable = name.partition(".")
        if dot:
            interface = self.uses.get(alias)
            return interface.variable(variable) if interface else None
        symbol = self.symbols.get(name)
        is_own = symbol is not None and symbol.kind in (ScopeSymbolKind.VARIABLE, ScopeSymbolKind.OUTPUT)
        return symbol.declaration if symbol is not None and is_own else None


def build_scope(project: Project, design: Design | None) -> Scope:
    """Build the scope of a design. Without a design it contains only constants and enumerations."""
    enumerations = {enumeration.name: enumeration.element_names for enumeration in project.enumerations}
    symbols: dict[str, ScopeSymbol] = {}

    def add(kind: ScopeSymbolKind, declarations: tuple[Declaration, ...]) -> None:
        for declaration in declarations:
            type_ = infer_declaration_type(declaration, enumerations)
            symbols[declaration.name] = ScopeSymbol(kind=kind, type=type_, declaration=declaration)

    add(ScopeSymbolKind.CONSTANT, project.constants)
    if design is None:
        return Scope(symbols=symbols, enumerations=enumerations)
    add(ScopeSymbolKind.VARIABLE, design.variables)
    add(ScopeSymbolKind.OUTPUT, design.outputs)
    add(ScopeSymbolKind.PARAMETER, design.parameters)
    uses = {use.alias: project.interface(use.component) for use in design.uses}
    return Scope(symbols=symbols, uses=uses, enumerations=enumerations)


_LITERAL_TYPES = (
    (re.compile(r"\s*[+-]?\d+\s*\Z"), INT),
    (re.compile(r"\s*(True|False|true|false)\s*\Z"), BOOL),
    (re.compile(r"\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*\Z"), FLOAT),
)
_ELEMENT = re.compile(r"\s*([A-Za-z]\w*)\s*\.\s*[A-Za-z_]\w*\s*\Z", re.ASCII)


def infer_declaration_type(declaration: Declaration, enumerations: Mapping[str, tuple[str, ...]]) -> str:
    """Return the declared type, or infer it from `initial`; the default is float.

    Return UNKNOWN for an undeclared type.
    """
    if declaration.type:
        known = declaration.type in (BOOL, INT, FLOAT) or declaration.type in enumerations
        return declaration.type if known else UNKNOWN
    for pattern, type_ in _LITERAL_TYPES:
        if pattern.match(declaration.initial):
            return type_
    element = _ELEMENT.match(declaration.initial)
    if element and element.group(1) in enumerations:
        return element.group(1)
    return FLOAT
