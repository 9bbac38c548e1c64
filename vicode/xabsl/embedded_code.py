"""Parses XABSL embedded in other files: the content of an action block, or one expression."""

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
    """A syntax error in embedded code; `span` is the range of characters concerned."""

    message: str
    fix: str
    span: tuple[int, int]


@dataclass(frozen=True, slots=True)
class EmbeddedCode(Generic[NodeT]):
    """The parsed node, None after a syntax error. `comments` precede the token of the given number."""

    node: NodeT | None
    diagnostics: tuple[EmbeddedDiagnostic, ...]
    comments: dict[int, list[Comment]]


def parse_embedded_actions(text: str) -> EmbeddedCode[ActionBlockNode]:
    """Parse the content of an `action { }` block. Token 0 is the opening brace. Never raises."""
    return _parse_embedded("{", text, "\n}", parse_actions)


def parse_embedded_expression(text: str) -> EmbeddedCode[ExpressionNode]:
    """Parse one expression. Never raises."""
    return _parse_embedded("", text, "\n", parse_expression)


def _parse_embedded(before: str, text: str, after: str, parse: Callable[[TokenCursor], NodeT]) -> EmbeddedCode[NodeT]:
    tokens, findings = tokenize(f"{before}{text}{after}", "")
    cursor = TokenCursor(tokens)
    node: NodeT | None = None
    try:
        node = parse(cursor)
        if cursor.kind != END:
            cursor.add_finding("X604", "unexpected text after the end of the code", "remove it")
    except XabslSyntaxError:
        node = None
    lines = f"{before}{text}{after}".split("\n")
    errors = [finding for finding in (*findings, *cursor.findings) if finding.severity is Severity.ERROR]
    diagnostics = tuple(_to_diagnostic(finding, lines, len(before), len(text)) for finding in errors)
    return EmbeddedCode(node, diagnostics, tokens.comments)


def _to_diagnostic(finding: Finding, lines: list[str], shift: int, length: int) -> EmbeddedDiagnostic:
    assert finding.location is not None
    location = finding.location
    start = sum(len(line) + 1 for line in lines[: location.line - 1]) + location.column - 1 - shift
    first = max(0, min(start, length - 1))
    return EmbeddedDiagnostic(
        message=finding.message, fix=finding.fix, span=(first, max(first + 1, min(start + location.length, length)))
    )
