"""Parsing of expressions to typed trees, with diagnostics.

The syntax is parsed with the Python parser and then restricted to a subset. Nothing is evaluated.
"""

import ast
import re
import sys
from dataclasses import dataclass
from functools import lru_cache

from vicode.findings import Rule, Span, get_rule
from vicode.model.expressions.binder import ExpressionBinder
from vicode.model.expressions.scope import Scope
from vicode.model.expressions.tree import Expr
from vicode.model.python_parser import parse_single_expression

MAX_LENGTH = 10_000
_FIX = "use a single expression, such as ball_seen and x < 40"
_TIME_FIX = "a time belongs to 'after'; it cannot be part of an expression"
_TIME = re.compile(r"\bafter\s+[\w.]|\d\s*(ms|s|min)\b")
_MAX_DEPTH, _FRAMES_PER_LEVEL = 1000, 16


@dataclass(frozen=True, slots=True, kw_only=True)
class ExpressionDiagnostic:
    """An error in an expression; `span` refers to its text."""

    rule: Rule
    message: str
    fix: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class ParsedExpression:
    """The tree and all diagnostics. Without diagnostics the tree is present and well typed."""

    tree: Expr | None
    diagnostics: tuple[ExpressionDiagnostic, ...] = ()


@lru_cache(maxsize=1 << 16)
def parse_expression(text: str, scope: Scope, expected: str | None = None) -> ParsedExpression:
    """Parse a text against a scope.

    Args:
        text: An expression in Python syntax; it may contain line breaks.
        scope: The available names.
        expected: The expected type, None for any.
    """
    syntax, diagnostic = _parse_syntax(text)
    if syntax is None:
        return ParsedExpression(tree=None, diagnostics=(diagnostic,) if diagnostic else ())
    binder = ExpressionBinder(scope=scope, text=text)
    tree = binder.bind_expected(syntax, expected)
    diagnostics = tuple(
        ExpressionDiagnostic(rule=get_rule(code), message=message, fix=fix, span=span)
        for code, message, fix, span in binder.diagnostics
    )
    return ParsedExpression(tree=tree, diagnostics=diagnostics)


@lru_cache(maxsize=4096)
def _parse_syntax(text: str) -> tuple[ast.expr | None, ExpressionDiagnostic | None]:
    if len(text) > MAX_LENGTH:
        return None, _not_an_expression(f"the expression is longer than {MAX_LENGTH} characters", (0, len(text)))
    if not text.strip():
        return None, _not_an_expression("the expression is empty", (0, max(1, len(text))))
    comment = text.find("#")
    if comment >= 0:
        return None, _not_an_expression(
            "comments are not allowed in expressions", (comment, len(text)), "move the comment to 'doc'"
        )
    if "\0" in text:
        return None, _not_an_expression("the expression contains a null character", (0, len(text)))
    # Replace line breaks by spaces, which keeps all offsets, and remove leading spaces, which would be an indentation.
    copy = text if text.isprintable() else "".join(" " if char.isspace() else char for char in text)
    lead = len(copy) - len(copy.lstrip())
    try:
        parsed = parse_single_expression(copy.strip())
    except SyntaxError as error:
        start = lead + max(0, min((error.offset or 1) - 1, len(text) - lead - 1))
        fix = _TIME_FIX if _TIME.search(text) else _FIX
        return None, _not_an_expression(_format_syntax_error(error.msg), (start, min(start + 1, len(text))), fix)
    except (ValueError, RecursionError, MemoryError):
        return None, _not_an_expression("the expression is nested too deeply", (0, len(text)))
    # Each level has at least one character.
    max_depth = min(_MAX_DEPTH, sys.getrecursionlimit() // _FRAMES_PER_LEVEL)
    if len(text) + 2 > max_depth and _is_too_deep(parsed, max_depth):
        return None, _not_an_expression("the expression is nested too deeply", (0, len(text)))
    return parsed, None


def _format_syntax_error(message: str) -> str:
    first, rest = message[:1].lower(), message[1:]
    return (first + rest).replace("invalid syntax. Perhaps you forgot a comma?", "invalid syntax")


def _not_an_expression(message: str, span: Span, fix: str = _FIX) -> ExpressionDiagnostic:
    return ExpressionDiagnostic(rule=get_rule("E301"), message=message, fix=fix, span=span)


def _is_too_deep(root: ast.expr, max_depth: int) -> bool:
    level: list[ast.AST] = [root]
    for _depth in range(max_depth):
        level = [child for node in level for child in ast.iter_child_nodes(node)]
        if not level:
            return False
    return True
