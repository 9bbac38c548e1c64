"""A piece of hand-written Python as it will stand in a file: whole enough to be parsed, every character found again."""

import textwrap
from dataclasses import dataclass

from vicode.findings import Span

# The line above a piece of code, by its role: what parses below it, indented if it opens a block, parses in its place.
_HEADERS = {"module": "pass", "members": "class _:", "action": "def _(self):", "predicate": "def _(self):"}


@dataclass(frozen=True, slots=True, kw_only=True)
class PythonSnippet:
    """A piece of code below a line, without its margin, indented if that line opens a block."""

    lines: tuple[str, ...]
    dedented: tuple[str, ...]
    header: str

    @staticmethod
    def from_text(text: str, role: str) -> "PythonSnippet":
        """A text in its role: module, members, action or predicate."""
        # The blank keeps every character at its place.
        lines = text.replace("\r\n", " \n").split("\n")
        straight = textwrap.dedent("\n".join(lines)).split("\n")
        return PythonSnippet(lines=tuple(lines), dedented=tuple(straight), header=_HEADERS.get(role, "pass"))

    @property
    def indent(self) -> str:
        """What stands before every line."""
        return " " if self.header.endswith(":") else ""

    @property
    def source(self) -> str:
        """A module with the piece in it."""
        # With `pass` on the second line a code of remarks only is a body, too.
        return "\n".join((self.header, f"{self.indent}pass", *(self.indent + line for line in self.dedented), ""))

    def span_at(self, lineno: int, column: int) -> Span:
        """One character of the text, from the line (counted from 1) and column that Python names in the source."""
        line = max(0, min(lineno - 3, len(self.lines) - 1))
        margin = max(0, len(self.lines[line]) - len(self.dedented[line]))
        column = max(0, min(column - len(self.indent) + margin, len(self.lines[line]) - 1))
        start = sum(len(each) + 1 for each in self.lines[:line]) + column
        return (start, start + 1)

    def offset_at(self, lineno: int, column: int) -> int:
        """The character of the text for a line (counted from 1) and a column in bytes, as a tree of the source has."""
        line = max(0, min(lineno - 3, len(self.lines) - 1))
        margin = max(0, len(self.lines[line]) - len(self.dedented[line]))
        before = (self.indent + self.dedented[line]).encode()[:column].decode(errors="ignore")
        return sum(len(each) + 1 for each in self.lines[:line]) + len(before) - len(self.indent) + margin
