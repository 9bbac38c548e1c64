"""The engine: runs compiled XABSL programs. It stands alone: copied beside a robot program it runs without vicode."""

from .engine import Engine, OptionView, Trace
from .loading import LoadError
from .program import Program
from .reading import CodeError, read_code
from .replaying import ReplayError
from .symbols import SymbolListError, Symbols, read_symbols
from .team import TeamMessage

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
