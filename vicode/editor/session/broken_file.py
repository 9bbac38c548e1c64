"""A file that is meant to be a design and cannot be read: its text, its mistakes, and writing a mended text."""

from dataclasses import dataclass
from pathlib import Path

from vicode.editor.session.code_marks import CodeMark
from vicode.findings import Finding
from vicode.store import read_design, write_text


class FileModifiedError(Exception):
    """Another program wrote the file since its text was read here."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ParsedText:
    """A text as it would be read: what is wrong, at which characters, and the component if there is one."""

    findings: tuple[Finding, ...]
    marks: tuple[CodeMark, ...]
    component: str


def read_file_text(file: Path) -> str:
    """The text of a file.

    Raises:
        OSError: It cannot be read.
        UnicodeDecodeError: It is no UTF-8 text, so that it cannot be mended as one.
    """
    return file.read_bytes().decode("utf-8")


def parse_text(text: str, name: str) -> ParsedText:
    """Read a text as the file of this name would be."""
    read = read_design(text, name)
    starts = _line_starts(text)
    marks = tuple(_mark(text, starts, finding) for finding in read.findings if finding.location is not None)
    component = read.design.component if read.design else ""
    return ParsedText(findings=read.findings, marks=marks, component=component)


def write_fixed_text(file: Path, text: str, original: str) -> None:
    """Put a text in the place of the one that was opened, in one step.

    Raises:
        ChangedMeanwhileError: The file holds another text by now.
        OSError: It cannot be written.
    """
    try:
        now = read_file_text(file)
    except (FileNotFoundError, UnicodeDecodeError):
        raise FileModifiedError from None
    if now != original:
        raise FileModifiedError
    write_text(file, text)


def _line_starts(text: str) -> list[int]:
    """The character at which each line begins, as the reader counts lines."""
    starts = [0]
    starts += [at + 1 for at, char in enumerate(text) if char == "\n"]
    return starts


def _mark(text: str, starts: list[int], finding: Finding) -> CodeMark:
    place = finding.location
    assert place is not None
    line = max(1, min(place.line, len(starts)))
    start = min(starts[line - 1] + max(0, place.column - 1), len(text))
    end = min(start + max(1, place.length), len(text))
    mend = f" – {finding.fix}" if finding.fix else ""
    message = f"{finding.message}{mend}"
    return CodeMark(start=start, end=end, severity=str(finding.severity), message=message, line=line)
