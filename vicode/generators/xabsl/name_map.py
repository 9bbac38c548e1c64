"""The words of one project in XABSL."""

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
    """Knows by which name everything that a project declares is said."""

    project: Project
    scope: Scope = field(init=False)
    constants: Mapping[str, ConstantValue] = field(init=False)
    _symbols: frozenset[str] = field(init=False)
    _ambiguous: frozenset[str] = field(init=False)

    def __post_init__(self) -> None:
        """Read what expressions of the project file say."""
        self.scope = build_scope(self.project, None)
        self.constants = evaluate_constants(self.project)
        self._symbols = frozenset(each.name for each in list_symbols(self.project))
        behaviors = {component_name(each) for each in self.project.components if is_basic_behavior(each)}
        self._ambiguous = frozenset(behaviors & {component_name(each) for each in self.project.designs})

    def type_of(self, declaration: Declaration) -> tree.TypeNode:
        """A declared type; every number is a decimal."""
        type_ = self.scope.type_of(declaration)
        if type_ in (INT, FLOAT):
            return tree.TypeNode("float")
        if type_ == BOOL:
            return tree.TypeNode("bool")
        return tree.TypeNode("enum", tree.NameNode(self.enumeration_name(type_)))

    def enumeration_name(self, name: str) -> str:
        """The name of an enumeration."""
        found = self.project.enumeration(name)
        if found is None:
            raise UnsoundDesignError(f"there is no type '{name}'")
        return unqualified_name(found)

    def element(self, enumeration: str, element: str) -> tree.ReferenceNode:
        """An element where its enumeration is wanted; with its name where a symbol is called like the element."""
        found = self.project.enumeration(enumeration)
        if found is None:
            raise UnsoundDesignError(f"there is no enumeration '{enumeration}'")
        name = element_name(found, element)
        return tree.ReferenceNode(f"{unqualified_name(found)}.{name}" if name in self._symbols else name)

    def constant(self, name: str, type_: str) -> tree.ExpressionNode:
        """A constant: numbers by their names, all else as what it is, since XABSL has constants of numbers only."""
        if type_ in (INT, FLOAT):
            declared = next(each for each in self.project.constants if each.name == name)
            return tree.ReferenceNode(unqualified_name(declared))
        if name not in self.constants:
            raise UnsoundDesignError(f"the constant '{name}' has no value")
        return self.literal(self.constants[name], type_)

    def literal(self, value: ConstantValue, type_: str) -> tree.ExpressionNode:
        """A value as it is written."""
        if isinstance(value, str):
            return self.element(type_, value)
        if type_ == BOOL:
            return tree.KeywordNode("true" if value else "false")
        return number_node(value)

    def symbol_name(self, component: str, name: str) -> str:
        """The symbol for an output or variable of a component."""
        return symbol_name(component, self._readable(component, name))

    def output_arguments(self, component: str, name: str) -> tuple[Declaration, ...] | None:
        """What an output takes, None if it is no function."""
        return self._readable(component, name).arguments

    def missing_arguments(self, declared: Sequence[Declaration], given: Collection[str]) -> Iterator[tree.ArgumentNode]:
        """What a call that leaves something out must say, as XABSL has no defaults but 0, false and first elements."""
        for each in declared:
            type_ = self.scope.type_of(each)
            value = evaluate_initial_value(each.initial, type_, self.scope, self.constants)
            if each.name in given or value is None or value == zero_value(type_, self.scope):
                continue
            is_constant = each.initial.strip() in self.constants
            said = self.constant(each.initial.strip(), type_) if is_constant else self.literal(value, type_)
            yield tree.ArgumentNode(tree.NameNode(unqualified_name(each)), said)

    def callee(self, component: str) -> tuple[str, str, Interface]:
        """Name, kind ("" where the name tells it) and interface of what a call of a component means."""
        interface = self.project.interface(component)
        if interface is None:
            raise UnsoundDesignError(f"nothing declares the component '{component}'")
        design = self.project.design(component)
        if design is None and not is_basic_behavior(interface):
            raise UnsoundDesignError(f"in XABSL there is nothing to call in '{component}'")
        name = component_name(design or interface)
        kind = ("behavior" if design is None else "option") if name in self._ambiguous else ""
        return name, kind, interface

    def _readable(self, component: str, name: str) -> Declaration:
        """What is declared under a name; of a design its own variables too."""
        design = self.project.design(component)
        interface = self.project.interface(component)
        own = (*design.outputs, *design.variables) if design else interface.readable if interface else ()
        found = next((each for each in own if each.name == name), None)
        if found is None:
            raise UnsoundDesignError(f"'{component}' has no '{name}'")
        return found


def number_node(value: float) -> tree.ExpressionNode:
    """A number without exponent; a negative one with its sign."""
    text = format_decimal(abs(value))
    return tree.UnaryNode("-", tree.NumberNode(text)) if value < 0 else tree.NumberNode(text)


def format_decimal(value: float) -> str:
    """The digits of a number, without exponent."""
    digits = Decimal(repr(value))
    if not digits.is_finite():
        raise UnsoundDesignError(f"XABSL has no number for {value:g}")
    text = format(digits, "f")
    return text.rstrip("0").rstrip(".") if "." in text else text
