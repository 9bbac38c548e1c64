"""Findings: sorting, rendering as text and JSON, and name suggestions."""

import json
from dataclasses import replace

from vicode.findings import (
    Finding,
    FindingSubject,
    Note,
    Severity,
    SourceLocation,
    did_you_mean,
    get_rule,
    nearest_name,
    render_json,
    render_text,
    sort_findings,
    worst_severity,
)


def _finding(code: str, line: int = 1, column: int = 1, length: int = 1) -> Finding:
    place = SourceLocation(file="goalie.yaml", line=line, column=column, length=length)
    return Finding(rule=get_rule(code), message="wrong", fix="fix it", location=place)


def test_findings_are_sorted_by_location_without_duplicates() -> None:
    late, early, other = _finding("D401", 10), _finding("D421", 9, 2), _finding("D402", 9, 2)
    assert sort_findings([late, early, late, other]) == (other, early, late)


def test_worst_severity() -> None:
    assert worst_severity([]) is None
    assert worst_severity([_finding("D430"), _finding("D421")]) is Severity.WARNING


def test_the_caret_marks_the_location() -> None:
    text = render_text([_finding("D402", 3, 9, 4)], lambda _file, _line: "  - {to: Jmup}\n")
    assert text == ("goalie.yaml:3:9: error D402 unknown-state: wrong; fix it\n      - {to: Jmup}\n            ^^^^\n")


def test_notes_follow_their_finding() -> None:
    finding = Finding(
        rule=get_rule("D413"),
        message="the id 'a' is given twice",
        notes=(Note(message="first here", location=SourceLocation(file="goalie.yaml", line=2, column=3)),),
    )
    assert render_text([finding]) == (
        "error D413 duplicate-id: the id 'a' is given twice\n  goalie.yaml:2:3: note: first here\n"
    )


def test_json_contains_subject_and_location() -> None:
    thing = FindingSubject(component="Goalie", path=("states", "Wait"))
    finding = Finding(
        rule=get_rule("D422"),
        message="never left",
        subject=thing,
        location=SourceLocation(file="g.yaml", line=4, column=3),
    )
    (shown,) = json.loads(render_json([finding]))
    assert shown == {
        "code": "D422",
        "name": "dead-end",
        "severity": "warning",
        "message": "never left",
        "fix": "",
        "file": "g.yaml",
        "line": 4,
        "column": 3,
        "component": "Goalie",
        "path": ["states", "Wait"],
        "notes": [],
    }


def test_nearest_name_ignores_case_and_typos() -> None:
    assert nearest_name("kik", ["Wait", "Kick"]) == "Kick"
    assert nearest_name("", ["Wait"]) is None
    assert did_you_mean("zzz", ["Wait"], "add it") == "add it"


def test_a_finding_has_the_name_that_its_fix_proposes() -> None:
    finding = Finding(
        rule=get_rule("D402"), message="unknown state", fix=did_you_mean("kik", ["Wait", "Kick"], "add it")
    )
    assert (finding.fix, finding.suggestion) == ("did you mean 'Kick'?", "Kick")
    assert replace(finding, fix=did_you_mean("x", [], "did you mean 'y'?")).suggestion == ""
