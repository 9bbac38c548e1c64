"""Where in the text of a field something is wrong: from findings and lint to marks under characters."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from vicode.editor.session.lint import LintWarning
from vicode.findings import DesignPath, Finding, Severity

_PAIR = re.compile(r"[ \t]*(?P<name>[^=:\n]*?)[ \t]*[=:][ \t]*(?P<value>.*?)[ \t]*$", re.MULTILINE)


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeMark:
    """Characters of a text with what is wrong there."""

    start: int
    end: int
    severity: str
    message: str
    line: int
    """The line it begins on, counted from 1."""


def mark_text(
    text: str, path: DesignPath, findings: Iterable[Finding], lints: Iterable[LintWarning] = ()
) -> tuple[CodeMark, ...]:
    """The marks in a text that a path, or one below it, leads to."""
    marks = [_mark(text, span, finding) for finding in findings if (span := _span_in(text, path, finding))]
    marks += [
        _placed(text, (lint.start, lint.end), Severity.WARNING, f"{lint.message} ({lint.code})") for lint in lints
    ]
    return tuple(sorted(dict.fromkeys(marks), key=lambda mark: (mark.start, mark.end)))


def mark_assignments(text: str, path: DesignPath, findings: Iterable[Finding]) -> tuple[CodeMark, ...]:
    """The marks in lines `name = expression`; a path leads to the value of each name."""
    places = {found["name"]: (found.span("name"), found.start("value")) for found in _PAIR.finditer(text)}
    return tuple(_marks_of_pairs(text, path, findings, places))


def _marks_of_pairs(
    text: str, path: DesignPath, findings: Iterable[Finding], places: dict[str, tuple[tuple[int, int], int]]
) -> Iterator[CodeMark]:
    for finding in findings:
        thing = finding.subject
        if thing is None or thing.path[:-1] != path or thing.path[-1] not in places:
            continue
        name_span, value_at = places[str(thing.path[-1])]
        if thing.span is None:
            yield _mark(text, name_span, finding)
        else:
            yield _mark(text, (value_at + thing.span[0], value_at + thing.span[1]), finding)


def _span_in(text: str, path: DesignPath, finding: Finding) -> tuple[int, int] | None:
    thing = finding.subject
    if thing is None or thing.path[: len(path)] != path:
        return None
    return thing.span or (0, len(text))


def _mark(text: str, span: tuple[int, int], finding: Finding) -> CodeMark:
    mend = f" – {finding.fix}" if finding.fix else ""
    return _placed(text, span, finding.severity, f"{finding.message}{mend}")


def _placed(text: str, span: tuple[int, int], severity: str, message: str) -> CodeMark:
    start = max(0, min(span[0], len(text)))
    end = max(start, min(span[1], len(text)))
    return CodeMark(start=start, end=end, severity=str(severity), message=message, line=text.count("\n", 0, start) + 1)
