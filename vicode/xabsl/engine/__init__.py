"""The engine: runs compiled XABSL programs. It stands alone: copied beside a robot program it runs without vicode."""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .engine import Engine, OptionView, Trace
    from .loading import LoadError
    from .program import Program
    from .reading import CodeError, read_code
    from .replaying import ReplayError
    from .symbols import SymbolListError, Symbols, read_symbols
    from .team import TeamMessage

_HOMES = {
    **dict.fromkeys(("Engine", "OptionView", "Trace"), "engine"),
    "LoadError": "loading",
    "Program": "program",
    "ReplayError": "replaying",
    "TeamMessage": "team",
    **dict.fromkeys(("CodeError", "read_code"), "reading"),
    **dict.fromkeys(("SymbolListError", "Symbols", "read_symbols"), "symbols"),
}

__all__ = [
    "CodeError",
    "Engine",
    "LoadError",
    "OptionView",
    "Program",
    "ReplayError",
    "SymbolListError",
    "Symbols",
    "TeamMessage",
    "Trace",
    "read_code",
    "read_symbols",
]


def __getattr__(name: str) -> object:
    """What is asked for, loaded then: a compiler needs programs, and no engine."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__} has no attribute {name}")
    return getattr(import_module(f".{_HOMES[name]}", __name__), name)
