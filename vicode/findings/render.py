"""Findings as lines with a caret under the guilty text, and as JSON."""

import json
from collections.abc import Callable, Iterable

from vicode.findings.finding import Finding, SourceLocation

SourceLine = Callable[[str, int], str | None]
"""The text of a line (counted from 1) of a file, None when it cannot be had."""


def render_text(findings: Iterable[Finding], source_line: SourceLine = lambda _file, _line: None) -> str:
    """One line a finding, `file:line:column: severity code name: message; fix`, then the source with a caret."""
    lines: list[str] = []
    for finding in findings:
        rule = finding.rule
        fix = f"; {finding.fix}" if finding.fix else ""
        lines.append(
            f"{_location_prefix(finding.location)}{rule.severity} {rule.code} {rule.name}: {finding.message}{fix}"
        )
        lines += _excerpt(finding.location, source_line)
        for note in finding.notes:
            lines.append(f"  {_location_prefix(note.location)}note: {note.message}")
    return "".join(line + "\n" for line in lines)


def render_json(findings: Iterable[Finding]) -> str:
    """An array of objects: code, name, severity, message, fix, file, line, column, component, path, notes."""
    return json.dumps([_to_json(finding) for finding in findings], indent=2, ensure_ascii=False) + "\n"


def _to_json(finding: Finding) -> dict[str, object]:
    place, thing = finding.location, finding.subject
    return {
        "code": finding.rule.code,
        "name": finding.rule.name,
        "severity": str(finding.severity),
        "message": finding.message,
        "fix": finding.fix,
        "file": place.file if place else None,
        "line": place.line if place else None,
        "column": place.column if place else None,
        "component": thing.component if thing else None,
        "path": list(thing.path) if thing else None,
        "notes": [note.message for note in finding.notes],
    }


def _location_prefix(place: SourceLocation | None) -> str:
    return f"{place.file}:{place.line}:{place.column}: " if place else ""


def _excerpt(place: SourceLocation | None, source_line: SourceLine) -> list[str]:
    text = source_line(place.file, place.line) if place else None
    if place is None or not text or not text.strip():
        return []
    shown = "".join(char if char.isprintable() else " " for char in text.rstrip("\r\n"))
    # A minified or hostile line would fill the terminal; the caret must stay in view.
    start = max(0, place.column - 80)
    caret = " " * (place.column - 1 - start) + "^" * max(1, min(place.length, len(shown) - place.column + 1))
    return [f"    {shown[start : start + 160]}", f"    {caret[:160]}"]
