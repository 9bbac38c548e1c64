"""The order of findings, filters, and stepping."""

from vicode.editor.session.finding_list import filter_findings, group_by_severity, next_finding, sort_findings
from vicode.findings import DesignPath, Finding, FindingSubject, Severity, get_rule


def finding(code: str, message: str, *path: str | int) -> Finding:
    return Finding(rule=get_rule(code), message=message, subject=FindingSubject(component="A", path=path))


TRAP = finding("D422", "never left", "states", "Kick")
NAME = finding("E303", "no such name", "states", "Kick", "transitions", 0, "when")
STATE = finding("D402", "no such state", "states", "Wait", "transitions", 0, "to")
TYPE = finding("E304", "expected bool", "states", "Kick", "transitions", 0, "when")
ALL: tuple[Finding, ...] = (TRAP, NAME, STATE, TYPE)
NOWHERE: DesignPath = ()


def test_findings_are_sorted_by_severity_and_item() -> None:
    assert sort_findings(ALL) == (NAME, TYPE, STATE, TRAP)
    assert group_by_severity(ALL) == ((Severity.ERROR, (NAME, TYPE, STATE)), (Severity.WARNING, (TRAP,)))


def test_a_filter_matches_message_code_and_path() -> None:
    assert filter_findings(ALL, "kick NO", ()) == (NAME,)
    assert filter_findings(ALL, "e30", {Severity.WARNING}) == (NAME, TYPE)
    assert filter_findings(ALL, "", {Severity.ERROR}) == (TRAP,)


def test_stepping_wraps_around() -> None:
    assert next_finding(ALL, None, 1) == NAME
    assert next_finding(ALL, None, -1) == TRAP
    assert next_finding(ALL, TRAP, 1) == NAME
    assert next_finding(ALL, NAME, -1) == TRAP
    assert next_finding(ALL, finding("D411", "gone", *NOWHERE), 1) == NAME
    assert next_finding((), TRAP, 1) is None
