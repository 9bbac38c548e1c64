"""Edits of one source file, with its indentation, line breaks and comments.

Edits are ranges of the original text, so tokens keep their offsets while edits are collected, in any order. A range can
be read with the edits in it, which moves an edited item. Comments are no tokens: this module decides which of them
belong to a token, those directly above its line and those behind it in its line.
"""

import re
from bisect import bisect_left
from dataclasses import dataclass, field

from vicode.xabsl import tree
from vicode.xabsl.formatter import INDENT
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.parser import ParsedFile

_COMMENT = re.compile(r"//[^\n]*|/\*(?s:.*?)\*/")
_TRAILING = re.compile(r"(?:[ \t]*/\*(?!\*)(?:(?!\*/)[^\n])*\*/)*[ \t]*(?://[^\r\n]*)?(?=[ \t\r]*(?:\n|\Z))")
_NEWLINE = re.compile(r"[ \t]*\r?(?:\n|\Z)")
_BLANK_LINE = re.compile(r"\n[ \t\r]*\n")


class PatchError(Exception):
    """A change cannot be written into the original files. `option` is the option that it concerns, if it is one."""

    def __init__(self, message: str, option: str = "") -> None:
        super().__init__(message)
        self.option = option


@dataclass(slots=True)
class _Edit:
    start: int
    end: int
    text: str


@dataclass(slots=True)
class SourceEdits:
    """Collects edits of a parsed file. Positions are offsets in the original text.

    Edits may be added in any order; reading a range with edits that overlap raises PatchError.
    """

    parsed: ParsedFile
    edits: list[_Edit] = field(default_factory=list)
    newline: str = field(init=False)
    line_comment_ends: frozenset[int] = field(init=False)

    def __post_init__(self) -> None:
        text = self.text
        comments = (comment for group in self.tokens.comments.values() for comment in group)
        self.line_comment_ends = frozenset(each.span[1] for each in comments if each.text.startswith("//"))
        self.newline = "\r\n" if text.count("\r\n") * 2 > text.count("\n") else "\n"

    @property
    def tokens(self) -> Tokens:
        return self.parsed.tokens

    @property
    def text(self) -> str:
        return self.parsed.tokens.text

    # Positions

    def start(self, token: int) -> int:
        return self.tokens.starts[token]

    def end(self, token: int) -> int:
        return self.tokens.starts[token] + len(self.tokens.texts[token])

    def indent_at(self, position: int) -> str:
        """The indentation of the line of a character."""
        line = self.text.rfind("\n", 0, position) + 1
        rest = self.text[line:]
        return rest[: len(rest) - len(rest.lstrip(" \t"))]

    def is_first_in_line(self, position: int) -> bool:
        return not self.text[self.text.rfind("\n", 0, position) + 1 : position].strip(" \t\ufeff")

    def end_with_comment(self, token: int) -> int:
        """The end of a token with the comments behind it in its line, if nothing else follows there."""
        found = _TRAILING.match(self.text, self.end(token))
        return found.end() if found else self.end(token)

    def starts_line(self, token: int) -> bool:
        """Whether only comments precede a token in its line."""
        return token == 0 or "\n" in self._gap_before(token)

    def start_with_comments(self, token: int) -> int:
        """The start of the line of a token and of the comments directly above it; the token if others precede it."""
        start = self.start(token)
        if not self.starts_line(token):
            return start
        gap = self._gap_before(token)
        begin = start - len(gap)
        blanks = [begin + match.end() for match in _BLANK_LINE.finditer(gap)]
        line = max(blanks, default=begin + gap.find("\n") + 1 if token else 0)
        # Blank lines may overlap: the last one counts.
        while (more := re.match(r"[ \t\r]*\n", self.text[line:start])) is not None:
            line += more.end()
        return line

    def _gap_before(self, token: int) -> str:
        """The text between a token and the comments behind the previous one, with each comment as one word."""
        begin = self.end_with_comment(token - 1) if token else 0
        return _COMMENT.sub(lambda match: "x" * len(match[0]), self.text[begin : self.start(token)])

    def comments_between(self, start: int, end: int) -> list[str]:
        """The comments in a range, without descriptions."""
        return [self.text[first:last].rstrip() for first, last in self.comment_spans(start, end)]

    def comment_spans(self, start: int, end: int) -> list[tuple[int, int]]:
        """The start and end of each comment in a range, without descriptions."""
        spans, position = [], start
        number = bisect_left(self.tokens.starts, start)
        while position < end:
            after = min(self.tokens.starts[number], end)
            spans += [match.span() for match in _COMMENT.finditer(self.text, position, after)]
            position = self.end(number)
            number += 1
        return spans

    # Edits

    def replace(self, start: int, end: int, text: str) -> None:
        if end > start and start in self.line_comment_ends and not _NEWLINE.match(text + self.text[end:]):
            # What follows must not become part of the comment.
            text = f"\n{self.indent_at(start)}{text.lstrip()}"
            end += 0 if text.strip() else len(self.text[end:]) - len(self.text[end:].lstrip(" \t"))
        if self.text[start:end] != text:
            self.edits.append(_Edit(start, end, text.replace("\n", self.newline)))

    def insert(self, position: int, text: str) -> None:
        self.replace(position, position, text)

    def replace_node(self, node: tree.SyntaxNode, text: str) -> None:
        self.replace(self.start(node.first_token), self.end(node.last_token), text)

    def delete(self, start: int, end: int) -> None:
        """Delete a range with the edits in it."""
        self.overwrite(start, end, "")

    def overwrite(self, start: int, end: int, text: str) -> None:
        """Replace a range with the edits in it."""
        self.edits = [edit for edit in self.edits if not (start < edit.end and edit.start < end)]
        self.replace(start, end, text)

    def read(self, start: int, end: int) -> str:
        """The text of a range with the edits in it."""
        pieces, position = [], start
        inside = [edit for edit in self.edits if start <= edit.start and edit.end <= end]
        for edit in sorted(inside, key=lambda edit: (edit.start, edit.end > edit.start)):
            if edit.start < position:
                raise PatchError(f"two changes overlap at line {self.tokens.line_at(edit.start)}")
            pieces += [self.text[position : edit.start], edit.text]
            position = edit.end
        return "".join([*pieces, self.text[position:end]])

    def result(self) -> str:
        return self.read(0, len(self.text))


def indented(text: str, indent: str, unit: str) -> str:
    """Indent all lines of a printed text but the first; its own indentation becomes that of the file."""
    first, *lines = text.split("\n")
    return "\n".join([first, *(_indented_line(line, indent, unit) for line in lines)])


def _indented_line(line: str, indent: str, unit: str) -> str:
    depth = (len(line) - len(line.lstrip(" "))) // len(INDENT)
    return f"{indent}{unit * depth}{line[depth * len(INDENT) :]}".rstrip()
