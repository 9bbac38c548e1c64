"""A design file that cannot be parsed: its text, its errors, and saving the corrected text."""

from dataclasses import dataclass
from pathlib import Path

from vicode.editor.session.code.code_marks import CodeMark, message_with_fix
from vicode.findings import Finding
from vicode.store import FileChangedError, is_project_text, read_design, read_project_file, replace_text


class FileModifiedError(Exception):
    """Another program has written the file since it was read."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ParsedText:
    """The result of parsing a text; `component` is empty if the text contains no design.

    `is_sound_project`: it is a project.yaml without errors.
    """

    findings: tuple[Finding, ...]
    marks: tuple[CodeMark, ...]
    component: str
    is_sound_project: bool = False


def read_file_text(file: Path) -> str:
    """Read a file as UTF-8, keeping its line ends.

    Raises:
        OSError: The file cannot be read.
        UnicodeDecodeError: The file is not UTF-8.
    """
    return file.read_bytes().decode("utf-8")


def parse_text(text: str, name: str) -> ParsedText:
    starts = _line_starts(text)
    if is_project_text(name, text.encode(errors="replace")):
        found = read_project_file(text, name).findings
        marks = tuple(_mark(text, starts, finding) for finding in found if finding.location is not None)
        return ParsedText(findings=found, marks=marks, component="", is_sound_project=not found)
    read = read_design(text, name)
    marks = tuple(_mark(text, starts, finding) for finding in read.findings if finding.location is not None)
    component = read.design.component if read.design else ""
    return ParsedText(findings=read.findings, marks=marks, component=component)


def write_fixed_text(file: Path, text: str, original: str) -> None:
    """Replace the text of a file atomically.

    Raises:
        FileModifiedError: The file no longer contains `original`.
        OSError: The file cannot be written.
    """
    try:
        replace_text(file, original, text)
    except FileChangedError:
        raise FileModifiedError from None


def _line_starts(text: str) -> list[int]:
    """The offset of each line; only newline characters end a line, as in the YAML reader."""
    starts = [0]
    starts += [index + 1 for index, char in enumerate(text) if char == "\n"]
    return starts


def _mark(text: str, starts: list[int], finding: Finding) -> CodeMark:
    location = finding.location
    assert location is not None
    line = max(1, min(location.line, len(starts)))
    start = min(starts[line - 1] + max(0, location.column - 1), len(text))
    end = min(start + max(1, location.length), len(text))
    severity, message = str(finding.severity), message_with_fix(finding)
    return CodeMark(start=start, end=end, severity=severity, message=message, line=line)
