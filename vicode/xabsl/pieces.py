"""Pieces of XABSL that stand in another text: actions without their braces, an expression."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from vicode.findings import Finding, Severity
from vicode.xabsl.cursor import Cursor, SyntaxSlipError
from vicode.xabsl.lexer import Comment, tokenize
from vicode.xabsl.parsing_expressions import parse_expression
from vicode.xabsl.parsing_states import parse_actions
from vicode.xabsl.tokens import END
from vicode.xabsl.tree import Actions, Expression

Read = TypeVar("Read")


@dataclass(frozen=True, slots=True, kw_only=True)
class Mistake:
    """What is wrong with a piece, and which characters of it are meant."""

    message: str
    mend: str
    span: tuple[int, int]


@dataclass(frozen=True, slots=True)
class Piece(Generic[Read]):
    """What was read, None where nothing was; `comments` stand before its token of that number."""

    node: Read | None
    mistakes: tuple[Mistake, ...]
    comments: dict[int, list[Comment]]


def read_actions(text: str) -> Piece[Actions]:
    """Read what may stand between the braces of `action { }`; token 0 is the brace before it. Never raises."""
    return _read("{", text, "\n}", parse_actions)


def read_expression(text: str) -> Piece[Expression]:
    """Read an expression. Never raises."""
    return _read("", text, "\n", parse_expression)


def _read(before: str, text: str, after: str, parse: Callable[[Cursor], Read]) -> Piece[Read]:
    tokens, findings = tokenize(f"{before}{text}{after}", "")
    cursor = Cursor(tokens)
    node: Read | None = None
    try:
        node = parse(cursor)
        if cursor.kind != END:
            cursor.complain("X604", "something follows that does not belong to it", "remove it")
    except SyntaxSlipError:
        node = None
    lines = f"{before}{text}{after}".split("\n")
    errors = [each for each in (*findings, *cursor.findings) if each.severity is Severity.ERROR]
    mistakes = tuple(_mistake(each, lines, len(before), len(text)) for each in errors)
    return Piece(node, mistakes, tokens.comments)


def _mistake(finding: Finding, lines: list[str], shift: int, length: int) -> Mistake:
    assert finding.place is not None
    place = finding.place
    start = sum(len(line) + 1 for line in lines[: place.line - 1]) + place.column - 1 - shift
    first = max(0, min(start, length - 1))
    return Mistake(
        message=finding.message, mend=finding.mend, span=(first, max(first + 1, min(start + place.length, length)))
    )
