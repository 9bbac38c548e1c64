"""Joins a program to a robot's world: how its Python source names symbols and skills, and what those names are."""

import keyword
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from .expressions import Input
from .generating import Called, Names
from .loading import LoadError, nested_functions
from .program import Program, Slot
from .symbols import Behavior, Symbol, Symbols

NEVER = -2
"""The cycle of what never ran."""


def attribute_of(name: str) -> str:
    """The Python name of a symbol or parameter: dots become underscores, Python's own words get one."""
    plain = name.replace(".", "_")
    return f"{plain}_" if keyword.iskeyword(plain) else plain


@dataclass(slots=True)
class BehaviorRecord:
    """What a tracing engine keeps of a basic behavior."""

    name: str
    act: Callable[..., object]
    slots: tuple[Slot, ...]
    keywords: dict[str, str]
    last: int = NEVER
    was: bool = False
    activated: int = 0


@dataclass(slots=True)
class Linker:
    """Finds what a program uses in a world; `functions` is what the names in its source stand for."""

    program: Program
    symbols: Symbols
    world: object
    behaviors: Mapping[str, Callable[..., object]]
    memory: object
    functions: dict[str, Any] = field(default_factory=dict)
    _elements: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name, elements in (*self.symbols.enums, *self.symbols.internal_enums, *self.program.enums):
            self._elements[name] = elements[0].rpartition(".")[2] if elements else ""

    def names(self) -> Names:
        """How the source names everything.

        Raises:
            LoadError: The world has no such thing.
        """
        nested = nested_functions(self.program)
        inputs = [each for each in self.symbols.symbols if each.role == "input"]
        return Names(
            inputs={each.name: self._input(number, each, nested) for number, each in enumerate(inputs)},
            outputs=self._outputs(),
            behaviors={each.name: self._called(number, each) for number, each in enumerate(self.symbols.behaviors)},
            elements=self._elements,
        )

    def zero(self, slot: Slot) -> object:
        """What a parameter has that is not given, and an internal symbol at first."""
        if slot.kind == "e":
            return self._elements.get(slot.enum, "")
        return False if slot.kind == "b" else 0.0

    def callable_of(self, name: str) -> Callable[..., object]:
        """What a basic behavior does.

        Raises:
            LoadError: Nobody has it.
        """
        act = self.behaviors.get(name) or getattr(self.world, attribute_of(name), None)
        if not callable(act):
            raise LoadError([f"basic behavior {name}: none is given, and the world has no {attribute_of(name)}"])
        return act

    def _input(self, number: int, symbol: Symbol, nested: Iterable[str]) -> Input:
        attribute = attribute_of(symbol.name)
        try:
            given = getattr(self.world, attribute)
        except AttributeError:
            raise LoadError([f"input symbol {symbol.name}: the world has no {attribute}"]) from None
        if not callable(given):
            return Input(f"w.{attribute}")
        self.functions[f"i{number}"] = given
        cells = ""
        if symbol.name in nested:
            cells = f"cells{number}"
            self.functions[cells] = [0.0] * len(symbol.parameters)
        return Input(f"i{number}", _keywords(symbol.name, symbol.parameters), symbol.parameters, cells)

    def _outputs(self) -> dict[str, str]:
        found = {each.name: f"w.{attribute_of(each.name)}" for each in self.symbols.symbols if each.role == "output"}
        for number, slot in enumerate(self.program.symbols):
            found[slot.name] = f"m.v{number}"
            setattr(self.memory, f"v{number}", self.zero(slot))
        return found

    def _called(self, number: int, behavior: Behavior) -> Called:
        act, keywords = self.callable_of(behavior.name), _keywords(behavior.name, behavior.parameters)
        self.functions[f"a{number}"] = act
        self.functions[f"b{number}"] = BehaviorRecord(behavior.name, act, behavior.parameters, keywords)
        return Called(f"a{number}", f"b{number}", behavior.parameters, keywords)


def _keywords(owner: str, slots: Iterable[Slot]) -> dict[str, str]:
    return {slot.name: attribute_of(slot.name.removeprefix(f"{owner}.")) for slot in slots}
