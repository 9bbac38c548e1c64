"""The order of findings, their filter, and going round."""

from vicode.editor.session.problems import following, grouped, matching, ordered
from vicode.findings import Finding, Path, Severity, Thing, rule


def finding(code: str, message: str, *path: str | int) -> Finding:
    return Finding(rule=rule(code), message=message, thing=Thing(component="A", path=path))


TRAP = finding("D422", "never left", "states", "Kick")
NAME = finding("E303", "no such name", "states", "Kick", "transitions", 0, "when")
STATE = finding("D402", "no such state", "states", "Wait", "transitions", 0, "to")
TYPE = finding("E304", "expected bool", "states", "Kick", "transitions", 0, "when")
ALL: tuple[Finding, ...] = (TRAP, NAME, STATE, TYPE)
NOWHERE: Path = ()


def test_the_worst_come_first_and_one_thing_together() -> None:
    assert ordered(ALL) == (NAME, TYPE, STATE, TRAP)
    assert grouped(ALL) == ((Severity.ERROR, (NAME, TYPE, STATE)), (Severity.WARNING, (TRAP,)))


def test_every_word_of_a_filter_is_found_in_words_code_or_place() -> None:
    assert matching(ALL, "kick NO", ()) == (NAME,)
    assert matching(ALL, "e30", {Severity.WARNING}) == (NAME, TYPE)
    assert matching(ALL, "", {Severity.ERROR}) == (TRAP,)


def test_going_on_goes_round() -> None:
    assert following(ALL, None, 1) == NAME
    assert following(ALL, None, -1) == TRAP
    assert following(ALL, TRAP, 1) == NAME
    assert following(ALL, NAME, -1) == TRAP
    assert following(ALL, finding("D411", "gone", *NOWHERE), 1) == NAME
    assert following((), TRAP, 1) is None
