"""The XABSL names of a project."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal

from vicode.generators.plan import UnsoundDesignError
from vicode.model.constant_folding import ConstantValue, evaluate_constants, evaluate_initial_value, zero_value
from vicode.model.design import Declaration
from vicode.model.expressions import BOOL, FLOAT, INT, Scope, build_scope
from vicode.model.project import Interface, Project
from vicode.model.xabsl.names import (
    component_name,
    element_name,
    is_basic_behavior,
    list_symbols,
    symbol_name,
    unqualified_name,
)
from vicode.xabsl import tree


@dataclass(slots=True)
class XabslNameMap:
    """Maps the declarations of a project to XABSL names, types and literals."""

    project: Project
    scope: Scope = field(init=False)
    constants: Mapping[str, ConstantValue] = field(init=False)
    _symbols: frozenset[str] = field(init=False)
    _ambiguous: frozenset[str] = field(init=False)

    def __post_init__(self) -> None:
        self.scope = build_scope(self.project, None)
        self.constants = evaluate_constants(self.project)
        self._symbols = frozenset(symbol.name for symbol in list_symbols(self.project))
        behaviors = {component_name(item) for item in self.project.components if is_basic_behavior(item)}
        self._ambiguous = frozenset(behaviors & {component_name(design) for design in self.project.designs})

    def type_of(self, declaration: Declaration) -> tree.TypeNode:
        """Return the type of a declaration; every number is a decimal."""
        type_ = self.scope.type_of(declaration)
        if type_ in (INT, FLOAT):
            return tree.TypeNode("float")
        if type_ == BOOL:
            return tree.TypeNode("bool")
        return tree.TypeNode("enum", tree.NameNode(self.enumeration_name(type_)))

    def enumeration_name(self, name: str) -> str:
        enumeration = self.project.enumeration(name)
        if enumeration is None:
            raise UnsoundDesignError(f"unknown type '{name}'")
        return unqualified_name(enumeration)

    def element(self, enumeration: str, element: str) -> tree.ReferenceNode:
        """Build an element reference, qualified by the enumeration if a symbol has the same name."""
        declared = self.project.enumeration(enumeration)
        if declared is None:
            raise UnsoundDesignError(f"unknown enumeration '{enumeration}'")
        name = element_name(declared, element)
        return tree.ReferenceNode(f"{unqualified_name(declared)}.{name}" if name in self._symbols else name)

    def constant(self, name: str, type_: str) -> tree.ExpressionNode:
        """Build a constant: a reference for a number, the value for other types, which XABSL constants cannot have."""
        if type_ in (INT, FLOAT):
            declared = next(item for item in self.project.constants if item.name == name)
            return tree.ReferenceNode(unqualified_name(declared))
        if name not in self.constants:
            raise UnsoundDesignError(f"the constant '{name}' has no value")
        return self.literal(self.constants[name], type_)

    def literal(self, value: ConstantValue, type_: str) -> tree.ExpressionNode:
        if isinstance(value, str):
            return self.element(type_, value)
        if type_ == BOOL:
            return tree.KeywordNode("true" if value else "false")
        return number_node(value)

    def symbol_name(self, component: str, name: str) -> str:
        return symbol_name(component, self._readable(component, name))

    def output_arguments(self, component: str, name: str) -> tuple[Declaration, ...] | None:
        """Return the arguments of an output; None if it is not a function."""
        return self._readable(component, name).arguments

    def missing_arguments(self, declared: Sequence[Declaration], given: Collection[str]) -> Iterator[tree.ArgumentNode]:
        """Build the omitted arguments whose default is not the XABSL default (0, false or the first element)."""
        for argument in declared:
            type_ = self.scope.type_of(argument)
            value = evaluate_initial_value(argument.initial, type_, self.scope, self.constants)
            if argument.name in given or value is None or value == zero_value(type_, self.scope):
                continue
            initial = argument.initial.strip()
            node = self.constant(initial, type_) if initial in self.constants else self.literal(value, type_)
            yield tree.ArgumentNode(tree.NameNode(unqualified_name(argument)), node)

    def callee(self, component: str) -> tuple[str, str, Interface]:
        """Return the XABSL name, the kind ("" unless the name is ambiguous) and the interface of a called component."""
        interface = self.project.interface(component)
        if interface is None:
            raise UnsoundDesignError(f"the component '{component}' is not declared")
        design = self.project.design(component)
        if design is None and not is_basic_behavior(interface):
            raise UnsoundDesignError(f"the component '{component}' cannot be called in XABSL")
        name = component_name(design or interface)
        kind = ("behavior" if design is None else "option") if name in self._ambiguous else ""
        return name, kind, interface

    def _readable(self, component: str, name: str) -> Declaration:
        """Find an output or variable, including the private variables of a design."""
        design = self.project.design(component)
        interface = self.project.interface(component)
        declared = (*design.outputs, *design.variables) if design else interface.readable if interface else ()
        declaration = next((item for item in declared if item.name == name), None)
        if declaration is None:
            raise UnsoundDesignError(f"'{component}' has no output or variable '{name}'")
        return declaration


def number_node(value: float) -> tree.ExpressionNode:
    """Build a number without exponent; a negative number is a unary minus."""
    text = format_decimal(abs(value))
    return tree.UnaryNode("-", tree.NumberNode(text)) if value < 0 else tree.NumberNode(text)


def format_decimal(value: float) -> str:
    """Format a number without exponent."""
    digits = Decimal(repr(value))
    if not digits.is_finite():
        raise UnsoundDesignError(f"XABSL has no literal for {value:g}")
    text = format(digits, "f")
    return text.rstrip("0").rstrip(".") if "." in text else text
