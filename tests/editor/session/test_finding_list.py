"""The order of findings, their filter, and going round."""

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


def test_the_worst_come_first_and_one_thing_together() -> None:
    assert sort_findings(ALL) == (NAME, TYPE, STATE, TRAP)
    assert group_by_severity(ALL) == ((Severity.ERROR, (NAME, TYPE, STATE)), (Severity.WARNING, (TRAP,)))


def test_every_word_of_a_filter_is_found_in_words_code_or_place() -> None:
    assert filter_findings(ALL, "kick NO", ()) == (NAME,)
    assert filter_findings(ALL, "e30", {Severity.WARNING}) == (NAME, TYPE)
    assert filter_findings(ALL, "", {Severity.ERROR}) == (TRAP,)


def test_going_on_goes_round() -> None:
    assert next_finding(ALL, None, 1) == NAME
    assert next_finding(ALL, None, -1) == TRAP
    assert next_finding(ALL, TRAP, 1) == NAME
    assert next_finding(ALL, NAME, -1) == TRAP
    assert next_finding(ALL, finding("D411", "gone", *NOWHERE), 1) == NAME
    assert next_finding((), TRAP, 1) is None
