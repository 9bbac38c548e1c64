"""Character offsets of a text as lines and columns, and the mistakes found at them."""

import re
from bisect import bisect_right
from dataclasses import dataclass, field

from vicode.findings import DesignPath, Finding, FindingSubject, Note, SourceLocation, get_rule

MAX_FINDINGS = 200
"""More than these say nothing new, and a hostile file could make a million."""

_LINE_BREAK = re.compile(r"\r\n|\n|\r")


class LineIndex:
    """Where the lines of a text begin."""

    def __init__(self, text: str, file: str) -> None:
        """Look at a text once; `file` is how places call it."""
        self.text = text
        self.file = file
        self.line_starts = [0, *(match.end() for match in _LINE_BREAK.finditer(text))]

    def locate(self, start: int, end: int) -> SourceLocation:
        """The place of the characters from `start` to `end`, underlined no further than their first line."""
        number = bisect_right(self.line_starts, start)
        line_start = self.line_starts[number - 1]
        line_end = self.line_starts[number] if number < len(self.line_starts) else len(self.text)
        line_end = line_start + len(self.text[line_start:line_end].rstrip("\r\n"))
        # A byte order mark is no column that an editor would show.
        column = start - line_start + 1 - (number == 1 and start > 0 and self.text.startswith("\ufeff"))
        return SourceLocation(file=self.file, line=number, column=column, length=max(1, min(end, line_end) - start))


@dataclass(slots=True, kw_only=True)
class ReadReport:
    """Collects the mistakes of one file."""

    line_index: LineIndex
    findings: list[Finding] = field(default_factory=list)

    @property
    def is_full(self) -> bool:
        """Whether further mistakes are left out."""
        return len(self.findings) >= MAX_FINDINGS

    def add(
        self,
        code: str,
        message: str,
        span: tuple[int, int],
        *,
        fix: str = "",
        path: DesignPath | None = None,
        note: tuple[str, int] | None = None,
    ) -> None:
        """Add a mistake at the characters of `span`; `note` is a message at a second offset."""
        if self.is_full:
            return
        notes = (Note(message=note[0], location=self.line_index.locate(note[1], note[1] + 1)),) if note else ()
        thing = FindingSubject(path=path) if path is not None else None
        place = self.line_index.locate(*span)
        self.findings.append(
            Finding(rule=get_rule(code), message=message, fix=fix, subject=thing, location=place, notes=notes)
        )
