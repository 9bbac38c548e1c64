"""The symbols that a robot program gives to an engine: read from a symbol list, or made from declarations."""

from collections.abc import Iterator
from dataclasses import dataclass

from .program import TypedSlot


@dataclass(frozen=True, slots=True)
class RobotSymbol:
    """An input or output symbol, or one that the engine keeps; `role` is "input", "output" or "internal"."""

    role: str
    kind: str
    name: str
    enum: str = ""
    parameters: tuple[TypedSlot, ...] = ()


@dataclass(frozen=True, slots=True)
class BasicBehavior:
    """A basic behavior; its parameters have its name before their own."""

    name: str
    parameters: tuple[TypedSlot, ...] = ()


@dataclass(frozen=True, slots=True)
class SymbolList:
    """All that a robot program has for behaviors. Enumerations are names with full names of their elements."""

    enums: tuple[tuple[str, tuple[str, ...]], ...] = ()
    internal_enums: tuple[tuple[str, tuple[str, ...]], ...] = ()
    symbols: tuple[RobotSymbol, ...] = ()
    behaviors: tuple[BasicBehavior, ...] = ()

    def elements(self, name: str) -> tuple[str, ...]:
        """The elements of an enumeration, none if it is not known."""
        return next((elements for each, elements in (*self.enums, *self.internal_enums) if each == name), ())


class SymbolListError(ValueError):
    """A line that is no part of a symbol list."""


_ROLES = {"in": "input", "out": "output", "i": "internal"}


def write_symbols(symbols: SymbolList) -> str:
    """A symbol list, a line each."""
    lines = [f"enum {name} {len(elements)} {' '.join(elements)}" for name, elements in symbols.enums]
    lines += [f"ienum {name} {len(elements)} {' '.join(elements)}" for name, elements in symbols.internal_enums]
    for role in ("input", "output", "internal"):
        for kind in "dbe":
            lines += [_line(each) for each in symbols.symbols if (each.role, each.kind) == (role, kind)]
    lines += [f"bb {each.name} {_slots(each.parameters)}" for each in symbols.behaviors]
    return "".join(f"{line}\n" for line in lines)


def _line(symbol: RobotSymbol) -> str:
    prefix = {"input": "{}in", "output": "{}out", "internal": "i{}out"}[symbol.role].format(symbol.kind)
    enum = f" {symbol.enum}" if symbol.kind == "e" else ""
    slots = f" {_slots(symbol.parameters)}" if symbol.role == "input" else ""
    return f"{prefix} {symbol.name}{enum}{slots}"


def _slots(parameters: tuple[TypedSlot, ...]) -> str:
    slots = (f" {each.kind} {each.enum + ' ' if each.kind == 'e' else ''}{each.name}" for each in parameters)
    return f"{len(parameters)}{''.join(slots)}"


def read_symbols(text: str) -> SymbolList:
    """The symbols that a list tells.

    Raises:
        SymbolListError: A line is none of a symbol list.
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
            raise SymbolListError(f"line {number}: words are missing: {line[:80]}") from None
        except ValueError as error:
            raise SymbolListError(f"line {number}: {error}: {line[:80]}") from None
        if not first.startswith("//") and next(words, None) is not None:
            raise SymbolListError(f"line {number}: more words than wanted: {line[:80]}")
    return SymbolList(tuple(enums["enum"]), tuple(enums["ienum"]), tuple(symbols), tuple(behaviors))


def _enum(words: Iterator[str]) -> tuple[str, tuple[str, ...]]:
    name, count = next(words), int(next(words))
    elements = tuple(words)
    if len(elements) != count:
        raise ValueError(f"{count} elements wanted")
    return name, elements


def _symbol(first: str, words: Iterator[str]) -> RobotSymbol:
    is_internal = first.startswith("i") and first.endswith("out")
    kind, _, direction = first.removeprefix("i").partition("in" if first.endswith("in") else "out")
    if kind not in ("d", "b", "e") or direction:
        raise ValueError(f"{first} is no kind of symbol")
    name = next(words)
    enum = next(words) if kind == "e" else ""
    role = "internal" if is_internal else "input" if first.endswith("in") else "output"
    slots = tuple(_read_slots(words)) if role == "input" else ()
    return RobotSymbol(role, kind, name, enum, slots)


def _read_slots(words: Iterator[str]) -> Iterator[TypedSlot]:
    for _ in range(int(next(words))):
        kind = next(words)
        if kind not in ("d", "b", "e"):
            raise ValueError(f"{kind} is no kind of parameter")
        enum = next(words) if kind == "e" else ""
        yield TypedSlot(kind, next(words), enum)
