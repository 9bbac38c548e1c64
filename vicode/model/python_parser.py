"""Python's own parser, in one thread at a time.

While it makes objects of a tree CPython counts its depth in a place that all threads share: two at once end in
"SystemError: AST constructor recursion depth mismatch" (before 3.11.8 and 3.12.2; seen with the editor checking while
it generates).
"""

import ast
import warnings
from collections.abc import Callable
from functools import wraps
from threading import RLock
from typing import Any

# Of the same thread it may be asked again: what the garbage collector ends may parse as well.
_PARSER_LOCK = RLock()


def parse_module(source: str) -> ast.Module:
    """The tree of a module; nothing is run.

    Raises:
        SyntaxError, ValueError, RecursionError, MemoryError: It is no module, or too deep a one.
    """
    with _PARSER_LOCK, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ast.parse(source)


def parse_single_expression(source: str) -> ast.expr:
    """The tree of one expression; raises as `parse_module` does."""
    with _PARSER_LOCK, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ast.parse(source, mode="eval").body


def check_compiles(tree: ast.Module) -> None:
    """Find what only Python's compiler refuses, such as `return` outside of a function; raises as `parse_module`."""
    with _PARSER_LOCK, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        compile(tree, "<code>", "exec", dont_inherit=True)


def serialize_calls(parse: Callable[..., Any]) -> Callable[..., Any]:
    """Another way to the same parser, that waits for its turn."""

    @wraps(parse)
    def waits(*args: Any, **kwargs: Any) -> Any:
        with _PARSER_LOCK:
            return parse(*args, **kwargs)

    return waits
