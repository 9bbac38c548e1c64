"""The names available in expressions of a design, with their types."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import lru_cache

from vicode.model.design import Declaration, Design
from vicode.model.expressions.tree import BOOL, FLOAT, INT, UNKNOWN
from vicode.model.project import Enumeration, Interface, Project


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


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class Scope:
    """The readable names: symbols, used components by alias (None: unknown component), and enumerations.

    Scopes are compared by identity, so that they are keys of caches.
    """

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
    """Return the scope of a design. Without a design it contains only constants and enumerations."""
    if design is None:
        return _build_scope(project.enumerations, project.constants)
    uses = tuple((use.alias, project.interface(use.component)) for use in design.uses)
    return _build_scope(
        project.enumerations, project.constants, uses, design.variables, design.outputs, design.parameters
    )


def build_interface_scope(project: Project, interface: Interface) -> Scope:
    """Return the scope of an assumption about a component: its own names, constants and enumerations."""
    own = (interface.variables, interface.outputs, interface.parameters)
    return _build_scope(project.enumerations, project.constants, (), *own)


def constant_scopes(project: Project) -> Iterator[Scope]:
    """Yield the scope of each constant: enumerations and the constants before it."""
    empty = _build_scope(project.enumerations, ())
    symbols: dict[str, ScopeSymbol] = {}
    for constant in project.constants:
        yield replace(empty, symbols=dict(symbols))
        symbols[constant.name] = _symbol(ScopeSymbolKind.CONSTANT, constant, empty.enumerations)


# The names of a design rarely change, and one scope lets check and generators share parsed expressions.
@lru_cache(maxsize=512)
def _build_scope(
    enumerations: tuple[Enumeration, ...],
    constants: tuple[Declaration, ...],
    uses: tuple[tuple[str, Interface | None], ...] = (),
    *own: tuple[Declaration, ...],
) -> Scope:
    elements = {enumeration.name: enumeration.element_names for enumeration in enumerations}
    kinds = (ScopeSymbolKind.CONSTANT, ScopeSymbolKind.VARIABLE, ScopeSymbolKind.OUTPUT, ScopeSymbolKind.PARAMETER)
    symbols = {
        declaration.name: _symbol(kind, declaration, elements)
        for kind, declarations in zip(kinds, (constants, *own), strict=False)
        for declaration in declarations
    }
    return Scope(symbols=symbols, uses=dict(uses), enumerations=elements)


def _symbol(
    kind: ScopeSymbolKind, declaration: Declaration, enumerations: Mapping[str, tuple[str, ...]]
) -> ScopeSymbol:
    return ScopeSymbol(kind=kind, type=infer_declaration_type(declaration, enumerations), declaration=declaration)


def is_type_only(declaration: Declaration, scope: Scope) -> bool:
    """Whether a declaration without a type has the name of an enumeration in place of its value."""
    return not declaration.type and declaration.initial in scope.enumerations


_LITERAL_TYPES = (
    (re.compile(r"\s*[+-]?\d+\s*\Z"), INT),
    (re.compile(r"\s*(True|False|true|false)\s*\Z"), BOOL),
    (re.compile(r"\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*\Z"), FLOAT),
)
_ELEMENT = re.compile(r"\s*([A-Za-z]\w*)\s*\.\s*[A-Za-z_]\w*\s*\Z", re.ASCII)


def infer_declaration_type(declaration: Declaration, enumerations: Mapping[str, tuple[str, ...]]) -> str:
    """Return the declared type, or infer it from `initial`; the default is float.

    Return UNKNOWN for an undeclared type. Without a type, `initial` may be the name of an enumeration: the short form
    `side: Side` declares only a type.
    """
    if declaration.type:
        known = declaration.type in (BOOL, INT, FLOAT) or declaration.type in enumerations
        return declaration.type if known else UNKNOWN
    for pattern, type_ in _LITERAL_TYPES:
        if pattern.match(declaration.initial):
            return type_
    if declaration.initial in enumerations:
        return declaration.initial
    element = _ELEMENT.match(declaration.initial)
    if element and element.group(1) in enumerations:
        return element.group(1)
    return FLOAT
