"""Findings as SARIF."""

import json

from vicode.findings import Finding, Note, SourceLocation, get_rule, render_sarif


def test_a_finding_has_rule_level_message_and_places() -> None:
    finding = Finding(
        rule=get_rule("D423"),
        message="this decision is never taken",
        fix="delete it",
        location=SourceLocation(file="my designs/ball ü.yaml", line=3, column=9, length=4),
        notes=(Note(message="taken instead", location=SourceLocation(file="a.yaml", line=2, column=1)),),
    )
    (run,) = json.loads(render_sarif([finding, finding]))["runs"]
    assert [rule["id"] for rule in run["tool"]["driver"]["rules"]] == ["D423"]
    assert run["columnKind"] == "unicodeCodePoints"
    result, other = run["results"]
    assert result == other
    assert (result["ruleId"], result["ruleIndex"], result["level"]) == ("D423", 0, "warning")
    assert result["message"] == {"text": "this decision is never taken; delete it"}
    (place,) = result["locations"]
    assert place["physicalLocation"] == {
        "artifactLocation": {"uri": "my%20designs/ball%20%C3%BC.yaml"},
        "region": {"startLine": 3, "startColumn": 9, "endColumn": 13},
    }
    (related,) = result["relatedLocations"]
    assert related["message"] == {"text": "taken instead"}


def test_without_findings_the_log_has_no_results() -> None:
    log = json.loads(render_sarif([]))
    assert log["version"] == "2.1.0"
    assert log["runs"][0]["results"] == []
