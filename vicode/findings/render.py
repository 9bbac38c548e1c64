"""Findings as lines with a caret under the guilty text, and as JSON."""

import json
from collections.abc import Callable, Iterable

from vicode.findings.finding import Finding, Place

SourceLine = Callable[[str, int], str | None]
"""The text of a line (counted from 1) of a file, None when it cannot be had."""


def render_text(findings: Iterable[Finding], source_line: SourceLine = lambda _file, _line: None) -> str:
    """One line a finding, `file:line:column: severity code name: message; mend`, then the source with a caret."""
    lines: list[str] = []
    for finding in findings:
        rule = finding.rule
        mend = f"; {finding.mend}" if finding.mend else ""
        lines.append(f"{_prefix(finding.place)}{rule.severity} {rule.code} {rule.name}: {finding.message}{mend}")
        lines += _excerpt(finding.place, source_line)
        for note in finding.notes:
            lines.append(f"  {_prefix(note.place)}note: {note.message}")
    return "".join(line + "\n" for line in lines)


def render_json(findings: Iterable[Finding]) -> str:
    """An array of objects: code, name, severity, message, mend, file, line, column, component, path, notes."""
    return json.dumps([_as_object(finding) for finding in findings], indent=2, ensure_ascii=False) + "\n"


def _as_object(finding: Finding) -> dict[str, object]:
    place, thing = finding.place, finding.thing
    return {
        "code": finding.rule.code,
        "name": finding.rule.name,
        "severity": str(finding.severity),
        "message": finding.message,
        "mend": finding.mend,
        "file": place.file if place else None,
        "line": place.line if place else None,
        "column": place.column if place else None,
        "component": thing.component if thing else None,
        "path": list(thing.path) if thing else None,
        "notes": [note.message for note in finding.notes],
    }


def _prefix(place: Place | None) -> str:
    return f"{place.file}:{place.line}:{place.column}: " if place else ""


def _excerpt(place: Place | None, source_line: SourceLine) -> list[str]:
    text = source_line(place.file, place.line) if place else None
    if place is None or not text or not text.strip():
        return []
    shown = "".join(char if char.isprintable() else " " for char in text.rstrip("\r\n"))
    # A minified or hostile line would fill the terminal; the caret must stay in view.
    start = max(0, place.column - 80)
    caret = " " * (place.column - 1 - start) + "^" * max(1, min(place.length, len(shown) - place.column + 1))
    return [f"    {shown[start : start + 160]}", f"    {caret[:160]}"]
