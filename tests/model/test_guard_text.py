"""Guards as people type them become the expression and the time of the design, or stay as typed."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.model.design import Code, Guard
from vicode.model.guard_text import change_guard, read_guard, settle_guard, write_guard

# What is typed, and the expression and the time in seconds that it means.
READ = (
    ("after 20 s", "", "20"),
    ("20 s", "", "20"),
    ("20s", "", "20"),
    (" After 20 Seconds ", "", "20"),
    ("20 sec", "", "20"),
    ("0.5 s", "", "0.5"),
    (".5s", "", ".5"),
    ("500 ms", "", "0.5"),
    ("500ms", "", "0.5"),
    ("1 min", "", "60"),
    ("1 min 30 s", "", "90"),
    ("2 h", "", "7200"),
    ("after 20", "", "20"),
    ("after TIMEOUT", "", "TIMEOUT"),
    ("distance<0.5 after 2 s", "distance<0.5", "2"),
    ("distance < 0.5 after 2", "distance < 0.5", "2"),
    ("distance < 0.5 after TIMEOUT", "distance < 0.5", "TIMEOUT"),
    ("distance < 0.5, after 2 s", "distance < 0.5", "2"),
    ("distance < 0.5 and 2 s", "distance < 0.5", "2"),
    ("distance < 0.5 and after 2 s", "distance < 0.5", "2"),
    ("distance < 0.5 && after 2 s", "distance < 0.5", "2"),
    ("a and b after 2 s", "a and b", "2"),
    ("a or b, after 2 s", "a or b", "2"),
    ("(a or b) after 2 s", "(a or b)", "2"),
    ("near(x, 3) after 250 ms", "near(x, 3)", "0.25"),
    ("after 2 s distance < 0.5", "distance < 0.5", "2"),
    ("after 2 s and distance < 0.5", "distance < 0.5", "2"),
    ("after 2 s, a or b", "a or b", "2"),
    ("after 2 s if a or b", "a or b", "2"),
    ("2 s and done(walk)", "done(walk)", "2"),
    ("not seen\n  after 2 s", "not seen", "2"),
    ("day after 3 s", "day", "3"),
)
# Expressions, texts with two readings, and texts that are neither.
KEPT = (
    "",
    "20",
    "s",
    "after",
    "distance < 0.5",
    "state_time > 20",
    "seconds > 3 and ms",
    "20 m",
    "0,5 s",
    "-2 s",
    "after -2 s",
    "007 s",
    "after and",
    "after if",
    "20 apples",
    "a or b after 2 s",
    "a or b and 2 s",
    "after 2 s and a or b",
    "a if b else c after 2 s",
    "(a) or (b) after 2 s",
    "after 2 s or a",
    "a or after 2 s",
    "not after 2 s",
    "distance < after 2 s",
    "distance < 0.5 2 s",
    "distance <",
    "after 2 s > 3",
    "after 2 s after 3 s",
    "a for 2 s",
    "after 2 - x > 3",
    "after TIMEOUT distance < 0.5",
    "x" * 2000 + " after 2 s",
)


@pytest.mark.parametrize(("text", "when", "after"), READ)
def test_a_text_with_one_reading_is_split(text: str, when: str, after: str) -> None:
    assert read_guard(text, "") == Guard(when=when, after=after)


@pytest.mark.parametrize("text", KEPT)
def test_other_texts_stay_as_typed(text: str) -> None:
    assert read_guard(text, "") is None
    assert change_guard(Guard(after="3"), text, "") == Guard(when=text)


@pytest.mark.parametrize(
    ("text", "after"), [("20 s", "20000"), ("500 ms", "500"), ("after 7", "7"), ("1.5 ms", "1.5"), ("0.1 s", "100")]
)
def test_times_are_converted_to_the_unit_of_the_design(text: str, after: str) -> None:
    assert read_guard(text, "ms") == Guard(after=after)


def test_the_code_of_a_guard_stays() -> None:
    code = Code(texts=(("python", "return True"),))
    assert change_guard(Guard(when="a", code=code), "20 s", "") == Guard(after="20", code=code)


def test_an_unchanged_expression_keeps_its_line_breaks() -> None:
    assert change_guard(Guard(when="a\n  and b"), "a and b after 2 s", "") == Guard(when="a\n  and b", after="2")


def test_typed_times_are_moved_to_where_they_belong() -> None:
    assert settle_guard(Guard(when="a after 2 s"), "") == Guard(when="a", after="2")
    assert settle_guard(Guard(when="a", after="500 ms"), "") == Guard(when="a", after="0.5")
    assert settle_guard(Guard(when="after 2 s", after="2"), "") == Guard(after="2")
    for guard in (Guard(when="after 3 s", after="2"), Guard(when="a", after="b after 2 s"), Guard(when="a")):
        assert settle_guard(guard, "") is guard


EXPRESSIONS = st.sampled_from(
    ("", "a", "a < 0.5", "a or b", "(a or b)", "a if b else c", "not a and b", 'x == "after 2 s"')
)
TIMES = st.sampled_from(("", "0", "2", "0.5", "12000", "TIMEOUT", "s"))


@given(EXPRESSIONS, TIMES, st.sampled_from(("", "ms")))
def test_a_written_guard_is_read_as_the_same(when: str, after: str, unit: str) -> None:
    text = write_guard(Guard(when=when, after=after), unit)
    assert text is not None
    assert change_guard(Guard(), text, unit) == Guard(when=when, after=after)


@pytest.mark.parametrize("guard", [Guard(when="a <", after="2"), Guard(when="a", after="2 * T"), Guard(when="20 s")])
def test_a_guard_with_errors_may_have_no_text(guard: Guard) -> None:
    assert write_guard(guard, "") is None
