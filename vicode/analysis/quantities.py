"""What guards compare: inputs, variables, times and computed values, with the values that they can have."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from vicode.analysis.interval_diagrams import AFTER_ALL, BEFORE_ALL, BEFORE_NAN, Interval, Position
from vicode.model.design import Declaration, Design, Guard
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    INT,
    Binary,
    Boolean,
    Comparison,
    Done,
    ElapsedTime,
    EnumElement,
    Expr,
    FunctionCall,
    Logic,
    Number,
    OutputRef,
    Scope,
    ScopeSymbolKind,
    StatusFlag,
    Variable,
    build_interface_scope,
    build_scope,
    children,
    evaluate,
    is_type_only,
    map_tree,
    parse_expression,
    walk,
)
from vicode.model.project import Project

Value = bool | float | str

_STORED_INTS: Interval = ((-(2**53), 0), (2**53 + 1, 0))
_TEAM_SIZES: Interval = ((1, 0), (2**32, 0))
NANOSECONDS = "ns"
"""The type of the time in a state, which is a whole number of nanoseconds."""

Shape = tuple[object, ...]
"""A tree without positions in the text: equal shapes compute equal values."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantity:
    """Something that has one value while the guards of a state are tested.

    Attributes:
        name: Its text in an expression.
        type: bool, int, float, an enumeration, or `NANOSECONDS`.
        domain: The values of its type, and those in its declared range.
        tree: The tree that reads or computes it; None for hand-written code.
        has_range: Whether the domain is a declared range.
    """

    name: str
    type: str
    domain: Interval
    tree: Expr | None = None
    has_range: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Assumption:
    """A condition that is taken for granted: its text in project.yaml, and its tree in the names of the design."""

    text: str
    tree: Expr


@dataclass(frozen=True, slots=True, kw_only=True)
class QuantityTable:
    """The declarations of a design, as far as they say which values are possible.

    Attributes:
        scope: The names of the design.
        constants: The values of constants that cannot be tuned.
        ns_per_unit: Nanoseconds of the unit of times.
        is_xabsl: Whether the design divides as the XABSL engine does.
        assumptions: What holds for the outputs of used components.
        kept_ranges: What designs set themselves, with ranges that they keep: own names, and `alias.output`.
        designs: The names of the components with a design.
    """

    scope: Scope
    constants: Mapping[str, Value]
    ns_per_unit: float
    is_xabsl: bool
    assumptions: tuple["Assumption", ...] = ()
    kept_ranges: frozenset[str] = frozenset()
    designs: frozenset[str] = frozenset()
    _quantities: dict[Shape, Quantity] = field(default_factory=dict)

    def value_of(self, node: Expr, values: Mapping[str, Value] = MappingProxyType({})) -> Value | None:
        """The value of an expression of constants and of quantities with these values; None if it reads others."""
        known = {**self.constants, **values} if values else self.constants
        return evaluate(node, known, xabsl_arithmetic=self.is_xabsl)

    def describe_constants(self, guards: Iterable[Guard]) -> tuple[str, ...]:
        """The values of the constants in guards as text, such as "LIMIT is 3"."""
        texts = (text for guard in guards for text in (guard.when, guard.after) if text)
        trees = (parse_expression(text, self.scope, None).tree for text in texts)
        nodes = (node for tree in trees if tree is not None for node in walk(tree))
        names = dict.fromkeys(node.name for node in nodes if isinstance(node, Variable))
        return tuple(f"{name} is {self.constants[name]}" for name in names if name in self.constants)

    def elements(self, type_: str) -> tuple[str, ...]:
        return self.scope.enumerations.get(type_, ())

    def quantity(self, node: Expr) -> Quantity:
        """The quantity of a tree, with the range of the declaration that it reads."""
        shape = shape_of(node)
        if shape not in self._quantities:
            self._quantities[shape] = self._describe(node, name_of(node))
        return self._quantities[shape]

    def declaration(self, node: Expr) -> Declaration | None:
        """The declaration of what a tree reads."""
        match node:
            case Variable(name=name):
                symbol = self.scope.symbols.get(name)
                return symbol.declaration if symbol else None
            case OutputRef(alias=alias, output=output):
                interface = self.scope.uses.get(alias)
                return interface.output(output) if interface else None
            case _:
                return None

    def trusting(self, names: frozenset[str]) -> "QuantityTable":
        """The table if the ranges of some more names are kept."""
        return replace(self, kept_ranges=self.kept_ranges | names, _quantities={})

    def _has_kept_range(self, node: Expr, name: str) -> bool:
        """Whether a declared range holds: that of an input does, others if the design that sets them keeps them."""
        is_set = isinstance(node, Variable) and node.kind in (ScopeSymbolKind.VARIABLE, ScopeSymbolKind.OUTPUT)
        interface = self.scope.uses.get(node.alias) if isinstance(node, OutputRef) else None
        is_of_design = interface is not None and interface.component in self.designs
        return not (is_set or is_of_design) or name in self.kept_ranges

    def _describe(self, node: Expr, name: str) -> Quantity:
        if isinstance(node, ElapsedTime):
            is_state = node.kind == "state"
            domain: Interval = ((0, 0), BEFORE_NAN)
            return Quantity(name=name, type=NANOSECONDS if is_state else FLOAT, domain=domain, tree=node)
        if isinstance(node, StatusFlag) and node.type == INT:
            return Quantity(name=name, type=INT, domain=_TEAM_SIZES, tree=node)
        declared = self.declaration(node)
        has_range = declared is not None and declared.range is not None and self._has_kept_range(node, name)
        if declared is not None and declared.range is not None and has_range and node.type in (INT, FLOAT):
            low, high = declared.range
            domain = ((low, 0), (high, 1))
            if node.type == INT:
                domain = (before_whole(domain[0]), before_whole(domain[1]))
            return Quantity(name=name, type=node.type, domain=domain, tree=node, has_range=True)
        return Quantity(name=name, type=node.type, domain=self.domain_of_type(node.type), tree=node)

    def domain_of_type(self, type_: str) -> Interval:
        if type_ == INT:
            return _STORED_INTS
        count = 2 if type_ == BOOL else len(self.elements(type_))
        # A float, or something of which the type is not known.
        return ((0, 0), (count, 0)) if count else (BEFORE_ALL, AFTER_ALL)


def before_whole(position: Position) -> Position:
    """The position before the first whole number that is after a position."""
    number, side = position
    if math.isinf(number):
        return position
    return (math.ceil(number), 0) if side == 0 else (math.floor(number) + 1, 0)


def is_leaf(node: Expr) -> bool:
    """Whether a tree reads one value, whose cells can be related to those of computed values."""
    match node:
        case OutputRef(arguments=arguments):
            return arguments is None
        case Variable() | ElapsedTime() | StatusFlag() | Done():
            return True
        case _:
            return False


def shape_of(node: Expr) -> Shape:
    """Return the shape of a tree."""
    return (type(node).__name__, _attribute(node), *map(shape_of, children(node)))


def _attribute(node: Expr) -> object:
    match node:
        case Number(value=value) | Boolean(value=value):
            return (type(value).__name__, value)
        case EnumElement(type=type_, element=element):
            return (type_, element)
        case OutputRef(alias=alias, output=output, arguments=pairs):
            return (alias, output, *(name for name, _value in pairs or ()))
        case Variable(name=of) | StatusFlag(name=of) | ElapsedTime(kind=of) | Done(alias=of):
            return of
        case Binary(operator=of) | Logic(operator=of) | FunctionCall(function=of):
            return of
        case Comparison(operators=operators):
            return operators
        case _:
            return None


def name_of(node: Expr) -> str:
    """The text of what a tree reads; "" for computed values."""
    match node:
        case Variable(name=name) | StatusFlag(name=name):
            return name
        case ElapsedTime(kind=kind):
            return f"{kind}_time"
        case Done(alias=alias):
            return f"done({alias})"
        case OutputRef(alias=alias, output=output):
            return f"{alias}.{output}"
        case _:
            return ""


def build_quantities(project: Project, design: Design, above: frozenset[str] = frozenset()) -> QuantityTable:
    """Build the table of a design of a project.

    Args:
        project: The project.
        design: The design.
        above: The designs whose tables need this one.
    """
    from vicode.analysis.kept_ranges import find_kept_ranges  # noqa: PLC0415 - it calculates with quantities

    table, above = _build_table(project, design), above | {design.component}
    of_used: set[str] = set()
    for use in design.uses:
        used = project.design(use.component)
        if used is not None and used.component not in above and any(each.range for each in used.outputs):
            kept = build_quantities(project, used, above).kept_ranges
            of_used |= {f"{use.alias}.{each.name}" for each in used.outputs if each.name in kept}
    table = table.trusting(frozenset(of_used))
    return table.trusting(find_kept_ranges(design, table))


def _build_table(project: Project, design: Design) -> QuantityTable:
    scope = build_scope(project, design)
    constants: dict[str, Value] = {}
    for constant in project.constants:
        value = initial_value(constant, scope, constants)
        if value is not None and not constant.tunable:
            constants[constant.name] = value
    return QuantityTable(
        scope=scope,
        constants=constants,
        ns_per_unit=1e6 if design.time_unit == "ms" else 1e9,
        is_xabsl=design.arithmetic == "xabsl",
        assumptions=tuple(_find_assumptions(project, design)),
        designs=frozenset(use.component for use in design.uses if project.design(use.component) is not None),
    )


def _find_assumptions(project: Project, design: Design) -> Iterator[Assumption]:
    """The assumptions about the used components, one for each part that `and` joins."""
    for use in design.uses:
        interface = project.interface(use.component)
        if interface is None or not interface.assume:
            continue
        parsed = parse_expression(interface.assume, build_interface_scope(project, interface), BOOL)
        if parsed.tree is None or parsed.diagnostics:
            continue
        is_joined = isinstance(parsed.tree, Logic) and parsed.tree.operator == "and"
        for part in children(parsed.tree) if is_joined else (parsed.tree,):
            text = interface.assume[slice(*part.span)].strip()
            yield Assumption(text=f"{interface.component}: {text}", tree=_read_through(part, use.alias))


def _read_through(tree: Expr, alias: str) -> Expr:
    """The tree with the names of a component as those that another one reads through an alias."""

    def replace_own(node: Expr) -> Expr:
        if isinstance(node, Variable) and node.kind != ScopeSymbolKind.CONSTANT:
            return OutputRef(alias=alias, output=node.name, type=node.type, span=node.span)
        return node

    return map_tree(tree, replace_own)


def initial_value(declaration: Declaration, scope: Scope, constants: Mapping[str, Value]) -> Value | None:
    """The value of a declaration at the start; None if its expression has errors."""
    type_ = scope.type_of(declaration)
    if not declaration.initial or is_type_only(declaration, scope):
        elements = scope.enumerations.get(type_, ())
        return {BOOL: False, INT: 0, FLOAT: 0.0}.get(type_, elements[0] if elements else None)
    parsed = parse_expression(declaration.initial, scope, type_)
    if parsed.tree is None or parsed.diagnostics:
        return None
    value = evaluate(parsed.tree, constants)
    if type_ == FLOAT and isinstance(value, int):
        return float(value)
    return None if isinstance(value, float) and math.isnan(value) else value
