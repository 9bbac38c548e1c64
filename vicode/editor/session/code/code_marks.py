"""Marks under the characters of a text field, from findings and lint warnings."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from vicode.editor.session.forms.pairs import PAIR
from vicode.findings import DesignPath, Finding, Severity
from vicode.services.lint import LintWarning


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeMark:
    """A range of characters with a message."""

    start: int
    end: int
    severity: str
    message: str
    line: int
    """The line of `start`, from 1."""
    finding: Finding | None = None


def mark_text(
    text: str, path: DesignPath, findings: Iterable[Finding], lints: Iterable[LintWarning] = ()
) -> tuple[CodeMark, ...]:
    """The marks in the text at `path`, from findings at or below that path."""
    marks = [_mark(text, span, finding) for finding in findings if (span := _span_in(text, path, finding))]
    marks += [
        _make_mark(text, (lint.start, lint.end), Severity.WARNING, f"{lint.message} ({lint.code})") for lint in lints
    ]
    return tuple(sorted(dict.fromkeys(marks), key=lambda mark: (mark.start, mark.end)))


def mark_assignments(text: str, path: DesignPath, findings: Iterable[Finding]) -> tuple[CodeMark, ...]:
    """The marks in lines `name = expression`; findings are at `path` plus the name."""
    places = {found["name"]: (found.span("name"), found.start("value")) for found in PAIR.finditer(text)}
    return tuple(_marks_of_pairs(text, path, findings, places))


def _marks_of_pairs(
    text: str, path: DesignPath, findings: Iterable[Finding], places: dict[str, tuple[tuple[int, int], int]]
) -> Iterator[CodeMark]:
    for finding in findings:
        subject = finding.subject
        if subject is None or subject.path[:-1] != path or subject.path[-1] not in places:
            continue
        name_span, value_at = places[str(subject.path[-1])]
        if subject.span is None:
            yield _mark(text, name_span, finding)
        else:
            yield _mark(text, (value_at + subject.span[0], value_at + subject.span[1]), finding)


def _span_in(text: str, path: DesignPath, finding: Finding) -> tuple[int, int] | None:
    subject = finding.subject
    if subject is None or subject.path[: len(path)] != path:
        return None
    return subject.span or (0, len(text))


def message_with_fix(finding: Finding) -> str:
    return f"{finding.message} – {finding.fix}" if finding.fix else finding.message


def _mark(text: str, span: tuple[int, int], finding: Finding) -> CodeMark:
    return replace(_make_mark(text, span, finding.severity, message_with_fix(finding)), finding=finding)


def _make_mark(text: str, span: tuple[int, int], severity: str, message: str) -> CodeMark:
    start = max(0, min(span[0], len(text)))
    end = max(start, min(span[1], len(text)))
    return CodeMark(start=start, end=end, severity=str(severity), message=message, line=text.count("\n", 0, start) + 1)
