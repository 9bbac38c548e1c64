"""Rendering of findings as text with source excerpts, and as JSON."""

import json
from collections import Counter
from collections.abc import Callable, Iterable

from vicode.findings.catalogue import Severity
from vicode.findings.finding import Finding, SourceLocation

SourceLine = Callable[[str, int], str | None]
"""Returns the text of a line of a file (starting at 1), None if it is not available."""


def render_text(findings: Iterable[Finding], source_line: SourceLine = lambda _file, _line: None) -> str:
    """Render each finding as `file:line:column: severity code name: message; fix`, followed by a source excerpt."""
    lines: list[str] = []
    for finding in findings:
        rule = finding.rule
        fix = f"; {finding.fix}" if finding.fix else ""
        words = f"{rule.severity} {rule.code} {rule.name}: {finding.message}{fix}"
        lines.append(escape_text(f"{_location_prefix(finding.location)}{words}"))
        lines += _excerpt(finding.location, source_line)
        for note in finding.notes:
            lines.append(escape_text(f"  {_location_prefix(note.location)}note: {note.message}"))
    return "".join(line + "\n" for line in lines)


def render_json(findings: Iterable[Finding]) -> str:
    """Render an array of objects: code, name, severity, message, fix, file, line, column, component, path, notes."""
    return json.dumps([_to_json(finding) for finding in findings], indent=2, ensure_ascii=False) + "\n"


def escape_text(line: str) -> str:
    """Write control characters as `repr` does: names and paths must neither command a terminal nor begin a line."""
    return line if line.isprintable() else "".join(char if char.isprintable() else repr(char)[1:-1] for char in line)


def _to_json(finding: Finding) -> dict[str, object]:
    location, subject = finding.location, finding.subject
    return {
        "code": finding.rule.code,
        "name": finding.rule.name,
        "severity": str(finding.severity),
        "message": finding.message,
        "fix": finding.fix,
        "file": location.file if location else None,
        "line": location.line if location else None,
        "column": location.column if location else None,
        "component": subject.component if subject else None,
        "path": list(subject.path) if subject else None,
        "notes": [note.message for note in finding.notes],
    }


def _location_prefix(location: SourceLocation | None) -> str:
    return f"{location.file}:{location.line}:{location.column}: " if location else ""


def _excerpt(location: SourceLocation | None, source_line: SourceLine) -> list[str]:
    text = source_line(location.file, location.line) if location else None
    if location is None or not text or not text.strip():
        return []
    shown = "".join(char if char.isprintable() else " " for char in text.rstrip("\r\n"))
    # A very long line would fill the terminal; keep the caret visible.
    start = max(0, location.column - 80)
    caret = " " * (location.column - 1 - start) + "^" * max(1, min(location.length, len(shown) - location.column + 1))
    return [f"    {shown[start : start + 160]}", f"    {caret[:160]}"]


def count_findings(findings: Iterable[Finding]) -> str:
    """Count the findings of each severity, as text."""
    counts = Counter(finding.severity for finding in findings)
    words = [
        f"{counts[severity]} {severity}{'s' * (counts[severity] != 1)}" for severity in Severity if counts[severity]
    ]
    return ", ".join(words) or "no findings"
