"""The words of one project in XABSL."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal

from vicode.generators.plan import UnsoundDesignError
from vicode.model.constants import Value, constant_values, first_value, zero_of
from vicode.model.design import Declaration
from vicode.model.expressions import BOOL, FLOAT, INT, Scope, scope_of
from vicode.model.project import Interface, Project
from vicode.model.xabsl.names import component_name, element_name, is_behavior, list_symbols, plain_name, symbol_name
from vicode.xabsl import tree


@dataclass(slots=True)
class Vocabulary:
    """Knows by which name everything that a project declares is said."""

    project: Project
    scope: Scope = field(init=False)
    constants: Mapping[str, Value] = field(init=False)
    _symbols: frozenset[str] = field(init=False)
    _twofold: frozenset[str] = field(init=False)

    def __post_init__(self) -> None:
        """Read what expressions of the project file say."""
        self.scope = scope_of(self.project, None)
        self.constants = constant_values(self.project)
        self._symbols = frozenset(each.name for each in list_symbols(self.project))
        behaviors = {component_name(each) for each in self.project.components if is_behavior(each)}
        self._twofold = frozenset(behaviors & {component_name(each) for each in self.project.designs})

    def type_of(self, declaration: Declaration) -> tree.Type:
        """A declared type; every number is a decimal."""
        type_ = self.scope.type_of(declaration)
        if type_ in (INT, FLOAT):
            return tree.Type("float")
        if type_ == BOOL:
            return tree.Type("bool")
        return tree.Type("enum", tree.Name(self.enumeration(type_)))

    def enumeration(self, name: str) -> str:
        """The name of an enumeration."""
        found = self.project.enumeration(name)
        if found is None:
            raise UnsoundDesignError(f"there is no type '{name}'")
        return plain_name(found)

    def element(self, enumeration: str, element: str) -> tree.Ref:
        """An element where its enumeration is wanted; with its name where a symbol is called like the element."""
        found = self.project.enumeration(enumeration)
        if found is None:
            raise UnsoundDesignError(f"there is no enumeration '{enumeration}'")
        name = element_name(found, element)
        return tree.Ref(f"{plain_name(found)}.{name}" if name in self._symbols else name)

    def constant(self, name: str, type_: str) -> tree.Expression:
        """A constant: numbers by their names, all else as what it is, since XABSL has constants of numbers only."""
        if type_ in (INT, FLOAT):
            declared = next(each for each in self.project.constants if each.name == name)
            return tree.Ref(plain_name(declared))
        if name not in self.constants:
            raise UnsoundDesignError(f"the constant '{name}' has no value")
        return self.literal(self.constants[name], type_)

    def literal(self, value: Value, type_: str) -> tree.Expression:
        """A value as it is written."""
        if isinstance(value, str):
            return self.element(type_, value)
        if type_ == BOOL:
            return tree.Word("true" if value else "false")
        return number(value)

    def symbol(self, component: str, name: str) -> str:
        """The symbol for an output or variable of a component."""
        return symbol_name(component, self._readable(component, name))

    def arguments_of(self, component: str, name: str) -> tuple[Declaration, ...] | None:
        """What an output takes, None if it is no function."""
        return self._readable(component, name).arguments

    def left_out(self, declared: Sequence[Declaration], given: Collection[str]) -> Iterator[tree.Argument]:
        """What a call that leaves something out must say, as XABSL has no defaults but 0, false and first elements."""
        for each in declared:
            type_ = self.scope.type_of(each)
            value = first_value(each.initial, type_, self.scope, self.constants)
            if each.name in given or value is None or value == zero_of(type_, self.scope):
                continue
            is_constant = each.initial.strip() in self.constants
            said = self.constant(each.initial.strip(), type_) if is_constant else self.literal(value, type_)
            yield tree.Argument(tree.Name(plain_name(each)), said)

    def callee(self, component: str) -> tuple[str, str, Interface]:
        """Name, kind ("" where the name tells it) and interface of what a call of a component means."""
        interface = self.project.interface(component)
        if interface is None:
            raise UnsoundDesignError(f"nothing declares the component '{component}'")
        design = self.project.design(component)
        if design is None and not is_behavior(interface):
            raise UnsoundDesignError(f"in XABSL there is nothing to call in '{component}'")
        name = component_name(design or interface)
        kind = ("behavior" if design is None else "option") if name in self._twofold else ""
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


def number(value: float) -> tree.Expression:
    """A number without exponent; a negative one with its sign."""
    text = number_text(abs(value))
    return tree.Unary("-", tree.Number(text)) if value < 0 else tree.Number(text)


def number_text(value: float) -> str:
    """The digits of a number, without exponent."""
    digits = Decimal(repr(value))
    if not digits.is_finite():
        raise UnsoundDesignError(f"XABSL has no number for {value:g}")
    text = format(digits, "f")
    return text.rstrip("0").rstrip(".") if "." in text else text
