"""Thread-safe access to the Python parser.

Before 3.11.8 and 3.12.2, CPython counts the depth of a tree in state that all threads share. Parsing in two threads
at once raises "SystemError: AST constructor recursion depth mismatch".
"""

import ast
import re
import warnings
from collections.abc import Callable
from functools import wraps
from threading import RLock
from typing import Any

# Reentrant: finalizers run by the garbage collector may also parse.
_PARSER_LOCK = RLock()
# The tokenizer warns about unknown escapes and about numbers that touch a word, such as `1if`.
_MAY_WARN = re.compile(r"\\|[\d.][A-Za-z_]")


def parse_module(source: str) -> ast.Module:
    """Parse a module without running it.

    Raises:
        SyntaxError, ValueError, RecursionError, MemoryError: The source is invalid or nested too deeply.
    """
    with _PARSER_LOCK, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ast.parse(source)


def parse_single_expression(source: str) -> ast.expr:
    """Parse one expression. Raises the same exceptions as `parse_module`."""
    if not _MAY_WARN.search(source):
        with _PARSER_LOCK:
            return ast.parse(source, mode="eval").body
    with _PARSER_LOCK, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ast.parse(source, mode="eval").body


def check_compiles(tree: ast.Module) -> None:
    """Compile a tree to detect errors such as `return` outside a function. Raises the same as `parse_module`."""
    with _PARSER_LOCK, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        compile(tree, "<code>", "exec", dont_inherit=True)


def serialize_calls(parse: Callable[..., Any]) -> Callable[..., Any]:
    """Wrap another function that uses the same parser."""

    @wraps(parse)
    def locked(*args: Any, **kwargs: Any) -> Any:
        with _PARSER_LOCK:
            return parse(*args, **kwargs)

    return locked
