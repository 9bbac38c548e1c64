"""Converts offsets to lines and columns, and collects the findings of a file."""

import re
from bisect import bisect_right
from dataclasses import dataclass, field

from vicode.findings import DesignPath, Finding, FindingSubject, Note, SourceLocation, get_rule

MAX_FINDINGS = 200
"""A limit, since a malicious file could cause millions of findings."""

_LINE_BREAK = re.compile(r"\r\n|\n|\r")


class LineIndex:
    """The start offsets of the lines of a text."""

    def __init__(self, text: str, file: str) -> None:
        """`file` is the file name in locations."""
        self.text = text
        self.file = file
        self.line_starts = [0, *(match.end() for match in _LINE_BREAK.finditer(text))]

    def locate(self, start: int, end: int) -> SourceLocation:
        """The location of the characters from `start` to `end`; its length is limited to the first line."""
        number = bisect_right(self.line_starts, start)
        line_start = self.line_starts[number - 1]
        line_end = self.line_starts[number] if number < len(self.line_starts) else len(self.text)
        line_end = line_start + len(self.text[line_start:line_end].rstrip("\r\n"))
        # Editors do not count a byte order mark as a column.
        column = start - line_start + 1 - (number == 1 and start > 0 and self.text.startswith("\ufeff"))
        return SourceLocation(file=self.file, line=number, column=column, length=max(1, min(end, line_end) - start))


@dataclass(slots=True, kw_only=True)
class ReadReport:
    """Collects the findings of one file."""

    line_index: LineIndex
    findings: list[Finding] = field(default_factory=list)

    @property
    def is_full(self) -> bool:
        """Whether further findings are dropped."""
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
        """Add a finding at `span` (start and end offset); `note` is a message and its offset."""
        if self.is_full:
            return
        notes = (Note(message=note[0], location=self.line_index.locate(note[1], note[1] + 1)),) if note else ()
        subject = FindingSubject(path=path) if path is not None else None
        location = self.line_index.locate(*span)
        self.findings.append(
            Finding(rule=get_rule(code), message=message, fix=fix, subject=subject, location=location, notes=notes)
        )
