"""Findings as SARIF 2.1.0 (OASIS), the format that code hosts read to show them beside the lines."""

import json
from collections.abc import Iterable
from urllib.parse import quote

from vicode.findings.catalogue import Severity
from vicode.findings.finding import Finding, Note, SourceLocation

_DISTRIBUTION = "vicode-fsm"
_LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "note"}


def render_sarif(findings: Iterable[Finding]) -> str:
    """Render a log with one run; notes are related locations."""
    found = tuple(findings)
    rules = {finding.rule.code: finding.rule for finding in found}
    driver = {
        "name": "vicode",
        **_version(),
        "rules": [
            {
                "id": rule.code,
                "name": rule.name,
                "shortDescription": {"text": rule.summary},
                "defaultConfiguration": {"level": _LEVELS[rule.severity]},
            }
            for rule in rules.values()
        ],
    }
    numbers = {code: number for number, code in enumerate(rules)}
    results = [{"ruleIndex": numbers[finding.rule.code], **_result(finding)} for finding in found]
    log = {
        "version": "2.1.0",
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "runs": [{"tool": {"driver": driver}, "columnKind": "unicodeCodePoints", "results": results}],
    }
    return json.dumps(log, indent=2, ensure_ascii=False) + "\n"


def _version() -> dict[str, str]:
    # Slow to import, and rarely needed.
    from importlib.metadata import PackageNotFoundError, version  # noqa: PLC0415

    try:
        return {"version": version(_DISTRIBUTION)}
    except PackageNotFoundError:
        return {}


def _result(finding: Finding) -> dict[str, object]:
    fix = f"; {finding.fix}" if finding.fix else ""
    result: dict[str, object] = {
        "ruleId": finding.rule.code,
        "level": _LEVELS[finding.severity],
        "message": {"text": f"{finding.message}{fix}"},
        "locations": [_place(finding.location)] if finding.location else [],
    }
    related = [_related(note, note.location) for note in finding.notes if note.location]
    return {**result, "relatedLocations": related} if related else result


def _related(note: Note, location: SourceLocation) -> dict[str, object]:
    return {**_place(location), "message": {"text": note.message}}


def _place(location: SourceLocation) -> dict[str, object]:
    region = {
        "startLine": location.line,
        "startColumn": location.column,
        "endColumn": location.column + max(1, location.length),
    }
    return {"physicalLocation": {"artifactLocation": {"uri": quote(location.file)}, "region": region}}
