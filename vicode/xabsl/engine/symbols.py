"""The symbols and basic behaviors of a robot program, and their text format, the symbol list."""

from collections.abc import Iterator
from dataclasses import dataclass

from .program import TypedSlot


@dataclass(frozen=True, slots=True)
class RobotSymbol:
    """A symbol; `role` is "input", "output" or "internal"."""

    role: str
    kind: str
    name: str
    enum: str = ""
    parameters: tuple[TypedSlot, ...] = ()


@dataclass(frozen=True, slots=True)
class BasicBehavior:
    """A basic behavior. Names of parameters are prefixed with its name."""

    name: str
    parameters: tuple[TypedSlot, ...] = ()


@dataclass(frozen=True, slots=True)
class SymbolList:
    """All symbols and basic behaviors of a robot program. Enumerations are names with qualified names of elements."""

    enums: tuple[tuple[str, tuple[str, ...]], ...] = ()
    internal_enums: tuple[tuple[str, tuple[str, ...]], ...] = ()
    symbols: tuple[RobotSymbol, ...] = ()
    behaviors: tuple[BasicBehavior, ...] = ()


class SymbolListError(ValueError):
    """A line of a symbol list is malformed."""


def write_symbols(symbols: SymbolList) -> str:
    """Format a symbol list, one line per entry."""
    lines = [f"enum {name} {len(elements)} {' '.join(elements)}" for name, elements in symbols.enums]
    lines += [f"ienum {name} {len(elements)} {' '.join(elements)}" for name, elements in symbols.internal_enums]
    for role in ("input", "output", "internal"):
        for kind in "dbe":
            lines += [_line(symbol) for symbol in symbols.symbols if (symbol.role, symbol.kind) == (role, kind)]
    lines += [f"bb {behavior.name} {_slots(behavior.parameters)}" for behavior in symbols.behaviors]
    return "".join(f"{line}\n" for line in lines)


def _line(symbol: RobotSymbol) -> str:
    prefix = {"input": "{}in", "output": "{}out", "internal": "i{}out"}[symbol.role].format(symbol.kind)
    enum = f" {symbol.enum}" if symbol.kind == "e" else ""
    slots = f" {_slots(symbol.parameters)}" if symbol.role == "input" else ""
    return f"{prefix} {symbol.name}{enum}{slots}"


def _slots(parameters: tuple[TypedSlot, ...]) -> str:
    slots = (f" {slot.kind} {slot.enum + ' ' if slot.kind == 'e' else ''}{slot.name}" for slot in parameters)
    return f"{len(parameters)}{''.join(slots)}"


def read_symbols(text: str) -> SymbolList:
    """Read a symbol list.

    Raises:
        SymbolListError: A line is malformed.
    """
    enums: dict[str, list[tuple[str, tuple[str, ...]]]] = {"enum": [], "ienum": []}
    symbols: list[RobotSymbol] = []
    behaviors: list[BasicBehavior] = []
    for number, line in enumerate(text.splitlines(), 1):
        words = iter(line.split())
        try:
            first = next(words, "")
            if first in enums:
                enums[first].append(_enum(words))
            elif first == "bb":
                behaviors.append(BasicBehavior(next(words), tuple(_read_slots(words))))
            elif first and not first.startswith("//"):
                symbols.append(_symbol(first, words))
        except (StopIteration, RuntimeError):
            raise SymbolListError(f"line {number}: missing words: {line[:80]}") from None
        except ValueError as error:
            raise SymbolListError(f"line {number}: {error}: {line[:80]}") from None
        if not first.startswith("//") and next(words, None) is not None:
            raise SymbolListError(f"line {number}: unexpected words at the end: {line[:80]}")
    return SymbolList(tuple(enums["enum"]), tuple(enums["ienum"]), tuple(symbols), tuple(behaviors))


def _enum(words: Iterator[str]) -> tuple[str, tuple[str, ...]]:
    name, count = next(words), int(next(words))
    elements = tuple(words)
    if len(elements) != count:
        raise ValueError(f"expected {count} elements, found {len(elements)}")
    return name, elements


def _symbol(first: str, words: Iterator[str]) -> RobotSymbol:
    is_internal = first.startswith("i") and first.endswith("out")
    kind, _, direction = first.removeprefix("i").partition("in" if first.endswith("in") else "out")
    if kind not in ("d", "b", "e") or direction:
        raise ValueError(f"{first} is not a kind of symbol")
    name = next(words)
    enum = next(words) if kind == "e" else ""
    role = "internal" if is_internal else "input" if first.endswith("in") else "output"
    slots = tuple(_read_slots(words)) if role == "input" else ()
    return RobotSymbol(role, kind, name, enum, slots)


def _read_slots(words: Iterator[str]) -> Iterator[TypedSlot]:
    for _ in range(int(next(words))):
        kind = next(words)
        if kind not in ("d", "b", "e"):
            raise ValueError(f"{kind} is not a kind of parameter")
        enum = next(words) if kind == "e" else ""
        yield TypedSlot(kind, next(words), enum)
