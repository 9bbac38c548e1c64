"""Links a program to the world of a robot: names of symbols and basic behaviors in the source, and their values."""

import keyword
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from .emitter import BehaviorBinding, LinkedNames
from .program import Program, TypedSlot
from .symbols import BasicBehavior, RobotSymbol, SymbolList
from .term_emitter import InputAccess
from .validation import LoadError, find_nested_inputs

NEVER = -2
"""Last cycle of options and behaviors that never ran."""


def python_name(name: str) -> str:
    """The Python name of a symbol or parameter: dots become underscores, keywords get a trailing underscore."""
    plain = name.replace(".", "_")
    return f"{plain}_" if keyword.iskeyword(plain) else plain


@dataclass(slots=True)
class BehaviorRecord:
    """Runtime data of a basic behavior for tracing."""

    name: str
    act: Callable[..., object]
    slots: tuple[TypedSlot, ...]
    keywords: dict[str, str]
    last_cycle: int = NEVER
    was_active: bool = False
    active_since: int = 0


@dataclass(slots=True)
class WorldLinker:
    """Looks up the symbols and behaviors of a program in a world; `functions` are the globals of its Python source."""

    program: Program
    symbols: SymbolList
    world: object
    behaviors: Mapping[str, Callable[..., object]]
    memory: object
    functions: dict[str, Any] = field(default_factory=dict)
    _elements: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name, elements in (*self.symbols.enums, *self.symbols.internal_enums, *self.program.enums):
            self._elements[name] = elements[0].rpartition(".")[2] if elements else ""

    def link(self) -> LinkedNames:
        """Choose the names of all symbols and behaviors, and look up their values.

        Raises:
            LoadError: The world lacks a symbol or a basic behavior.
        """
        nested = find_nested_inputs(self.program)
        inputs = [symbol for symbol in self.symbols.symbols if symbol.role == "input"]
        return LinkedNames(
            inputs={symbol.name: self._bind_input(number, symbol, nested) for number, symbol in enumerate(inputs)},
            outputs=self._bind_outputs(),
            behaviors={
                behavior.name: self._bind_behavior(number, behavior)
                for number, behavior in enumerate(self.symbols.behaviors)
            },
            elements=self._elements,
        )

    def default_value(self, slot: TypedSlot) -> object:
        """Value of an omitted parameter, and initial value of an internal symbol."""
        if slot.kind == "e":
            return self._elements.get(slot.enum, "")
        return False if slot.kind == "b" else 0.0

    def find_behavior(self, name: str) -> Callable[..., object]:
        """Find the callable of a basic behavior.

        Raises:
            LoadError: Neither `behaviors` nor the world has it.
        """
        act = self.behaviors.get(name) or getattr(self.world, python_name(name), None)
        if not callable(act):
            raise LoadError([f"basic behavior {name}: not in behaviors, and the world has no {python_name(name)}"])
        return act

    def _bind_input(self, number: int, symbol: RobotSymbol, nested: Iterable[str]) -> InputAccess:
        attribute = python_name(symbol.name)
        try:
            value = getattr(self.world, attribute)
        except AttributeError:
            raise LoadError([f"input symbol {symbol.name}: the world has no {attribute}"]) from None
        except Exception:
            # A property that has no value yet.
            value = None
        if not callable(value):
            return InputAccess(f"w.{attribute}")
        self.functions[f"i{number}"] = value
        cells = ""
        if symbol.name in nested:
            cells = f"cells{number}"
            self.functions[cells] = [0.0] * len(symbol.parameters)
        return InputAccess(f"i{number}", keyword_names(symbol.name, symbol.parameters), symbol.parameters, cells)

    def _bind_outputs(self) -> dict[str, str]:
        outputs = {
            symbol.name: f"w.{python_name(symbol.name)}" for symbol in self.symbols.symbols if symbol.role == "output"
        }
        for number, slot in enumerate(self.program.symbols):
            outputs[slot.name] = f"m.v{number}"
            setattr(self.memory, f"v{number}", self.default_value(slot))
        return outputs

    def _bind_behavior(self, number: int, behavior: BasicBehavior) -> BehaviorBinding:
        act, keywords = self.find_behavior(behavior.name), keyword_names(behavior.name, behavior.parameters)
        self.functions[f"a{number}"] = act
        self.functions[f"b{number}"] = BehaviorRecord(behavior.name, act, behavior.parameters, keywords)
        return BehaviorBinding(f"a{number}", f"b{number}", behavior.parameters, keywords)


def keyword_names(owner: str, slots: Iterable[TypedSlot]) -> dict[str, str]:
    """The keywords of Python for the parameters of a symbol or basic behavior."""
    return {slot.name: python_name(slot.name.removeprefix(f"{owner}.")) for slot in slots}
