"""Search and replace: matches, replacements, invalid patterns and timeouts."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies.designs import designs
from vicode.model import text_search
from vicode.model.design import Code, Declaration, Design, Guard, RunCode, State, Transition
from vicode.model.lowering import lower_edit
from vicode.model.text_search import TextQuery, find_text, replace_matches
from vicode.model.texts import TextKind, iter_texts
from vicode.store import read_design, save_design

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


def test_search_options() -> None:
    assert len(found("ball", whole_word=True)) == 7
    assert len(found("ball", match_case=True)) == 7
    assert len(found("ball", kinds=frozenset({TextKind.EXPRESSION}))) == 2
    assert found(r"(?P<a>b)all\s*[<>]", is_pattern=True)[0][0] == "when"
    assert found("b.ll") == []
    assert found("") == []


def test_replacements_may_refer_to_groups() -> None:
    changed = replace_matches(DESIGN, TextQuery(text="ball", whole_word=True, match_case=True), r"\1 puck")
    assert changed.count == 6
    assert changed.design.states[0].transitions[0].guard.when == r"\1 puck > 3 and football"
    pattern = TextQuery(text=r"self\.(\w+)", is_pattern=True)
    changed = replace_matches(DESIGN, pattern, r"self.my_\1")
    assert changed.design.states[0].enter[0] == RunCode(
        code=Code(texts=(("python", "self.my_ball += 1"), ("cpp", "ball++;")))
    )


def test_one_match_can_be_replaced() -> None:
    query = TextQuery(text="ball")
    hit = find_text(DESIGN, query).matches[2]
    changed = replace_matches(DESIGN, query, "puck", [(hit.path, hit.start)])
    assert (changed.count, changed.design.states[0].transitions[0].guard.when) == (1, "ball > 3 and footpuck")


@pytest.mark.parametrize(
    ("pattern", "replacement", "message"),
    [("(", "", "invalid pattern"), ("ball", r"\9", "invalid replacement"), ("ball", r"\g<x>", "invalid replacement")],
)
def test_invalid_queries_change_nothing(pattern: str, replacement: str, message: str) -> None:
    changed = replace_matches(DESIGN, TextQuery(text=pattern, is_pattern=True), replacement)
    assert message in changed.error
    assert changed.design == DESIGN


def test_a_search_times_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(text_search, "TIME_LIMIT_S", 0.05)
    design = replace(DESIGN, doc="x" * 5000)
    result = find_text(design, TextQuery(text="(x+x+)+y", is_pattern=True))
    assert result.error == text_search.SEARCH_TIMEOUT


@given(designs, st.sampled_from(["a", "go", " ", "\n", ":", "é", "self", "."]))
def test_replacing_back_restores_the_design(design: Design, text: str) -> None:
    query = TextQuery(text=text, match_case=True)
    hits = find_text(design, query).matches
    assert all(hit.matched == text for hit in hits)
    assert len(hits) == sum(located.text.count(text) for located in iter_texts(design))
    there = replace_matches(design, query, "⟦⟧")
    back = replace_matches(there.design, TextQuery(text="⟦⟧", match_case=True), text)
    assert (there.count, back.design) == (len(hits), design)


CONSTRUCTS = """\
vicode: 1
component: Rover
uses: {drive: Drive}
parameters: {near: 1}
latches:
  hot: {on: near > 2, doc: too near}
layers:
  Walk: {modulates: [drive]}
  Stop: {when: near > 3, for: near, doc: stops near walls, modulates: {drive: {speed: near}}}
"""


def test_the_texts_of_constructs_are_found_once_and_replaced() -> None:
    design = read_design(CONSTRUCTS).design
    assert design is not None
    found = find_text(design, TextQuery(text="near")).matches
    assert sorted(match.path for match in found) == [
        ("latches", "hot", "doc"),
        ("latches", "hot", "on"),
        ("layers", "Stop", "doc"),
        ("layers", "Stop", "for"),
        ("layers", "Stop", "modulates", "drive", "speed"),
        ("layers", "Stop", "when"),
    ]
    changed, error = lower_edit(design, replace_matches(design, TextQuery(text="near"), "far").design)
    assert error == ""
    assert save_design(changed, CONSTRUCTS) == CONSTRUCTS.replace("near", "far").replace("{far: 1}", "{near: 1}")
