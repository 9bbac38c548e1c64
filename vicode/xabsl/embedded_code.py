"""Pieces of XABSL that stand in another text: actions without their braces, an expression."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from vicode.findings import Finding, Severity
from vicode.xabsl.cursor import TokenCursor, XabslSyntaxError
from vicode.xabsl.expression_parser import parse_expression
from vicode.xabsl.lexer import Comment, tokenize
from vicode.xabsl.state_parser import parse_actions
from vicode.xabsl.tokens import END
from vicode.xabsl.tree import ActionBlockNode, ExpressionNode

NodeT = TypeVar("NodeT")


@dataclass(frozen=True, slots=True, kw_only=True)
class EmbeddedDiagnostic:
    """What is wrong with a piece, and which characters of it are meant."""

    message: str
    fix: str
    span: tuple[int, int]


@dataclass(frozen=True, slots=True)
class EmbeddedCode(Generic[NodeT]):
    """What was read, None where nothing was; `comments` stand before its token of that number."""

    node: NodeT | None
    diagnostics: tuple[EmbeddedDiagnostic, ...]
    comments: dict[int, list[Comment]]


def parse_embedded_actions(text: str) -> EmbeddedCode[ActionBlockNode]:
    """Read what may stand between the braces of `action { }`; token 0 is the brace before it. Never raises."""
    return _parse_embedded("{", text, "\n}", parse_actions)


def parse_embedded_expression(text: str) -> EmbeddedCode[ExpressionNode]:
    """Read an expression. Never raises."""
    return _parse_embedded("", text, "\n", parse_expression)


def _parse_embedded(before: str, text: str, after: str, parse: Callable[[TokenCursor], NodeT]) -> EmbeddedCode[NodeT]:
    tokens, findings = tokenize(f"{before}{text}{after}", "")
    cursor = TokenCursor(tokens)
    node: NodeT | None = None
    try:
        node = parse(cursor)
        if cursor.kind != END:
            cursor.add_finding("X604", "something follows that does not belong to it", "remove it")
    except XabslSyntaxError:
        node = None
    lines = f"{before}{text}{after}".split("\n")
    errors = [each for each in (*findings, *cursor.findings) if each.severity is Severity.ERROR]
    mistakes = tuple(_to_diagnostic(each, lines, len(before), len(text)) for each in errors)
    return EmbeddedCode(node, mistakes, tokens.comments)


def _to_diagnostic(finding: Finding, lines: list[str], shift: int, length: int) -> EmbeddedDiagnostic:
    assert finding.location is not None
    place = finding.location
    start = sum(len(line) + 1 for line in lines[: place.line - 1]) + place.column - 1 - shift
    first = max(0, min(start, length - 1))
    return EmbeddedDiagnostic(
        message=finding.message, fix=finding.fix, span=(first, max(first + 1, min(start + place.length, length)))
    )
