"""Runs compiled XABSL programs. The folder is self-contained: a copy of it runs without vicode."""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .code_reader import CodeError, read_code
    from .engine import Engine, OptionView
    from .program import Program
    from .replay import ReplayError
    from .symbols import SymbolList, SymbolListError, read_symbols
    from .team import CoopMessage
    from .validation import LoadError

_MODULES = {
    **dict.fromkeys(("Engine", "OptionView"), "engine"),
    "LoadError": "validation",
    "Program": "program",
    "ReplayError": "replay",
    "CoopMessage": "team",
    **dict.fromkeys(("CodeError", "read_code"), "code_reader"),
    **dict.fromkeys(("SymbolListError", "SymbolList", "read_symbols"), "symbols"),
}

__all__ = [
    "CodeError",
    "CoopMessage",
    "Engine",
    "LoadError",
    "OptionView",
    "Program",
    "ReplayError",
    "SymbolList",
    "SymbolListError",
    "read_code",
    "read_symbols",
]


def __getattr__(name: str) -> object:
    """Import a name on first use: the compiler needs only the program format."""
    if name not in _MODULES:
        raise AttributeError(f"module {__name__} has no attribute {name}")
    return getattr(import_module(f".{_MODULES[name]}", __name__), name)
