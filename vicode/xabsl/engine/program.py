"""A compiled program. Decisions and actions are nested tuples that start with a letter of the intermediate code.

decimal   ("v", number) ("c", text of a constant) ("i", symbol, arguments) ("o", symbol) ("p", parameter)
          ("+", a, b) ("-", a, b) ("*", a, b) ("d", a, b) a / b ("%", a, b) ("s",) state_time ("t",) option_time
          ("q", condition, yes, no)
boolean   ("v", True) ("i", …) ("o", …) ("p", …) ("t",) action_done ("x",) conflict ("c", enum, enum) equal
          ("&", a, b, …) ("|", a, b, …) ("!", a) ("=", a, b) ("n", a, b) unequal ("<" "l" ">" "g", a, b) ("q", …)
enum      ("v", "enum.element") ("i", …) ("o", …) ("p", …) ("q", …)
arguments a tuple of ("d" | "b", parameter, value) and ("e", enum, parameter, value)
action    ("o", option, arguments) ("a", behavior, arguments) ("d" | "b" | "e", symbol, value)
tree      ("t", state) ("i", condition, then, otherwise)
"""

from dataclasses import dataclass
from typing import Any

Term = tuple[Any, ...]


@dataclass(frozen=True, slots=True)
class TypedSlot:
    """A parameter or internal symbol: `kind` is "d", "b" or "e"; only "e" has an enumeration."""

    kind: str
    name: str
    enum: str = ""


@dataclass(frozen=True, slots=True)
class CompiledState:
    """A state; `mode` is "n", "c" (capacity) or "s" (synchronized), `robots` the number after it."""

    name: str
    decision: Term
    actions: tuple[Term, ...] = ()
    is_target: bool = False
    mode: str = "n"
    robots: int = 0


@dataclass(frozen=True, slots=True)
class CompiledOption:
    """A state machine. Names of parameters are prefixed with the name of the option."""

    name: str
    initial: str
    states: tuple[CompiledState, ...]
    parameters: tuple[TypedSlot, ...] = ()


@dataclass(frozen=True, slots=True)
class Program:
    """A program for an engine. Agents are pairs of a name and a root option."""

    options: tuple[CompiledOption, ...]
    agents: tuple[tuple[str, str], ...]
    enums: tuple[tuple[str, tuple[str, ...]], ...] = ()
    symbols: tuple[TypedSlot, ...] = ()
    title: str = ""
