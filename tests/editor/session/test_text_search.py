"""Search and replace: what is found is there, replacing there and back is nothing, no pattern can hang the server."""

from dataclasses import replace
from time import monotonic

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies.designs import designs
from vicode.editor.session.text_search import TextQuery, find_text, replace_matches
from vicode.model.design import Code, Declaration, Design, Guard, RunCode, State, Transition
from vicode.model.texts import TextKind, iter_texts

DESIGN = Design(
    component="Player",
    doc="Looks for the Ball.",
    initial="Look",
    variables=(Declaration(name="ball", initial="0"),),
    members=Code(texts=(("python", "def near(self):\n    ball = self.ball\n    return ball < 3\n"),)),
    states=(
        State(
            name="Look",
            enter=(RunCode(code=Code(texts=(("python", "self.ball += 1"), ("cpp", "ball++;")))),),
            transitions=(Transition(to="Look", guard=Guard(when="ball > 3 and football", after="2")),),
        ),
    ),
)


def found(text: str, **options: object) -> list[tuple[str, int, str]]:
    query = replace(TextQuery(text=text), **options)
    return [
        (str(hit.path[-1]), hit.line, f"{hit.before}[{hit.matched}]{hit.after}")
        for hit in find_text(DESIGN, query).matches
    ]


def test_all_texts_are_searched_with_their_lines() -> None:
    assert found("ball") == [
        ("doc", 1, "Looks for the [Ball]."),
        ("when", 1, "[ball] > 3 and football"),
        ("when", 1, "ball > 3 and foot[ball]"),
        ("python", 2, "[ball] = self.ball"),
        ("python", 2, "ball = self.[ball]"),
        ("python", 3, "return [ball] < 3"),
        ("python", 1, "self.[ball] += 1"),
        ("cpp", 1, "[ball]++;"),
    ]


def test_words_case_kinds_and_patterns() -> None:
    assert len(found("ball", whole_word=True)) == 7
    assert len(found("ball", match_case=True)) == 7
    assert len(found("ball", kinds=frozenset({TextKind.EXPRESSION}))) == 2
    assert found(r"(?P<a>b)all\s*[<>]", is_pattern=True)[0][0] == "when"
    assert found("b.ll") == []
    assert found("") == []


def test_replacing_puts_in_text_or_groups() -> None:
    changed = replace_matches(DESIGN, TextQuery(text="ball", whole_word=True, match_case=True), r"\1 puck")
    assert changed.count == 6
    assert changed.design.states[0].transitions[0].guard.when == r"\1 puck > 3 and football"
    pattern = TextQuery(text=r"self\.(\w+)", is_pattern=True)
    changed = replace_matches(DESIGN, pattern, r"self.my_\1")
    assert changed.design.states[0].enter[0] == RunCode(
        code=Code(texts=(("python", "self.my_ball += 1"), ("cpp", "ball++;")))
    )


def test_one_hit_can_be_replaced_alone() -> None:
    query = TextQuery(text="ball")
    hit = find_text(DESIGN, query).matches[2]
    changed = replace_matches(DESIGN, query, "puck", [(hit.path, hit.start)])
    assert (changed.count, changed.design.states[0].transitions[0].guard.when) == (1, "ball > 3 and footpuck")


@pytest.mark.parametrize(
    ("pattern", "replacement", "words"),
    [("(", "", "invalid pattern"), ("ball", r"\9", "invalid replacement"), ("ball", r"\g<x>", "invalid replacement")],
)
def test_mistakes_are_told_and_change_nothing(pattern: str, replacement: str, words: str) -> None:
    changed = replace_matches(DESIGN, TextQuery(text=pattern, is_pattern=True), replacement)
    assert words in changed.error
    assert changed.design == DESIGN


def test_a_pattern_that_would_take_for_ever_is_given_up() -> None:
    design = replace(DESIGN, doc="x" * 5000)
    start = monotonic()
    answer = find_text(design, TextQuery(text="(x+x+)+y", is_pattern=True))
    assert "too long" in answer.error
    # The limit is a second; a busy machine may take its time, but not for ever.
    assert monotonic() - start < 60


@given(designs, st.sampled_from(["a", "go", " ", "\n", ":", "é", "self", "."]))
def test_replacing_there_and_back_is_nothing(design: Design, text: str) -> None:
    query = TextQuery(text=text, match_case=True)
    hits = find_text(design, query).matches
    assert all(hit.matched == text for hit in hits)
    assert len(hits) == sum(located.text.count(text) for located in iter_texts(design))
    there = replace_matches(design, query, "⟦⟧")
    back = replace_matches(there.design, TextQuery(text="⟦⟧", match_case=True), text)
    assert (there.count, back.design) == (len(hits), design)
