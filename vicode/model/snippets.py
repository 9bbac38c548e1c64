"""Hand-written Python, completed to a module that can be parsed, with positions mapped back to the text."""

import textwrap
from dataclasses import dataclass

from vicode.findings import Span

# The line before the code, by role. The code is indented if this line opens a block.
_HEADERS = {"module": "pass", "members": "class _:", "action": "def _(self):", "predicate": "def _(self):"}


@dataclass(frozen=True, slots=True, kw_only=True)
class PythonSnippet:
    """Dedented code below a header line, indented if the header opens a block."""

    lines: tuple[str, ...]
    dedented: tuple[str, ...]
    header: str

    @staticmethod
    def from_text(text: str, role: str) -> "PythonSnippet":
        """Create a snippet; `role` is module, members, action or predicate."""
        # The space keeps all offsets.
        lines = text.replace("\r\n", " \n").split("\n")
        dedented = textwrap.dedent("\n".join(lines)).split("\n")
        return PythonSnippet(lines=tuple(lines), dedented=tuple(dedented), header=_HEADERS.get(role, "pass"))

    @property
    def indent(self) -> str:
        return " " if self.header.endswith(":") else ""

    @property
    def source(self) -> str:
        # `pass` makes code that consists only of comments a valid body.
        return "\n".join((self.header, f"{self.indent}pass", *(self.indent + line for line in self.dedented), ""))

    def span_at(self, lineno: int, column: int) -> Span:
        """Map a position in the source (line from 1, column in characters) to the span of one character of the text."""
        line = max(0, min(lineno - 3, len(self.lines) - 1))
        margin = max(0, len(self.lines[line]) - len(self.dedented[line]))
        column = max(0, min(column - len(self.indent) + margin, len(self.lines[line]) - 1))
        start = sum(len(previous) + 1 for previous in self.lines[:line]) + column
        return (start, start + 1)

    def offset_at(self, lineno: int, column: int) -> int:
        """Map a position in the syntax tree (line from 1, column in bytes) to an offset in the text."""
        line = max(0, min(lineno - 3, len(self.lines) - 1))
        margin = max(0, len(self.lines[line]) - len(self.dedented[line]))
        before = (self.indent + self.dedented[line]).encode()[:column].decode(errors="ignore")
        return sum(len(previous) + 1 for previous in self.lines[:line]) + len(before) - len(self.indent) + margin
