"""Python's own parser, in one thread at a time.

While it makes objects of a tree CPython counts its depth in a place that all threads share: two at once end in
"SystemError: AST constructor recursion depth mismatch" (seen in 3.11, with the editor checking while it generates).
"""

import ast
import warnings
from threading import Lock

_ONE_AT_A_TIME = Lock()


def parse_module(source: str) -> ast.Module:
    """The tree of a module; nothing is run.

    Raises:
        SyntaxError, ValueError, RecursionError, MemoryError: It is no module, or too deep a one.
    """
    with _ONE_AT_A_TIME, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ast.parse(source)


def parse_single_expression(source: str) -> ast.expr:
    """The tree of one expression; raises as `parse_module` does."""
    with _ONE_AT_A_TIME, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ast.parse(source, mode="eval").body


def compile_check(tree: ast.Module) -> None:
    """Find what only Python's compiler refuses, such as `return` outside of a function; raises as `parse_module`."""
    with _ONE_AT_A_TIME, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        compile(tree, "<code>", "exec", dont_inherit=True)
