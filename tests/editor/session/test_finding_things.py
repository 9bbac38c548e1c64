"""Finding by name: what is listed, what a query means first, and how it is told which letters were found."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.editor.session import Library
from vicode.editor.session.finding_things import Goal, Index, Kind, Thing, rank
from vicode.editor.session.ranking import align
from vicode.editor.view import Selected

DESIGNS = Path(__file__).parents[3] / "designs"


@pytest.fixture(scope="module")
def things() -> list[Thing]:
    return Index(Library(DESIGNS)).things()


def first(things: list[Thing], query: str, here: Goal | None = None) -> Thing:
    return rank(things, query, here)[0].thing


@pytest.mark.parametrize(
    ("query", "kind", "title", "component"),
    [
        ("kick", Kind.STATE, "Kick", "Player"),
        ("lfb", Kind.STATE, "LookForBall", "Player"),
        ("player", Kind.COMPONENT, "Player", "Player"),
        ("ball lost", Kind.TRANSITION, "WatchBall → LookForBall", "Player"),
        ("wb", Kind.STATE, "WatchBall", "Player"),
        ("net beside", Kind.TRANSITION, "SearchNet → AlignLateral", "Player"),
        ("fallen", Kind.TRANSITION, "every state → GetUp", "Player"),
        ("kicks", Kind.DECLARATION, "kicks", "Player"),
        ("stand_up", Kind.USE, "stand_up", "Player"),
    ],
)
def test_what_is_meant_comes_first(things: list[Thing], query: str, kind: Kind, title: str, component: str) -> None:
    found = first(things, query, Goal(project="forward", component="Player"))
    assert (found.kind, found.title) == (kind, title)
    assert found.goal is not None
    assert found.goal.component == component


def test_where_a_thing_is(things: list[Thing]) -> None:
    tree = first(things, "net beside")
    assert tree.goal == Goal(
        project="forward", component="Player", selected=Selected(of="transitions", id="SearchNet/0/then/2")
    )
    assert tree.where == "Player · Forward"
    hand_written = first(things, "kicker hand-written")
    assert hand_written.goal is not None
    assert hand_written.goal.selected == Selected(of="components", id="kicker")


def test_the_open_design_comes_before_others(things: list[Thing]) -> None:
    for component in ("Player", "FaceBall", "FollowBall"):
        here = Goal(project="forward", component=component)
        found = rank(things, "", here)
        assert {match.thing.goal.component for match in found[:3] if match.thing.goal} == {component}


def test_every_word_must_be_found(things: list[Thing]) -> None:
    assert rank(things, "kick zzz") == ()
    assert rank(things, "qqqq") == ()


def test_found_letters_are_told(things: list[Thing]) -> None:
    (match, *_rest) = rank(things, "lfb")
    assert [match.thing.title[place] for place in match.places] == ["L", "F", "B"]


def test_only_what_changed_is_listed_again() -> None:
    index = Index(Library(DESIGNS))
    before = {id(thing) for thing in index.things() if thing.goal and thing.kind is Kind.STATE}
    after = {id(thing) for thing in index.things() if thing.goal and thing.kind is Kind.STATE}
    assert before == after


@given(word=st.text("abAB_ ", min_size=1, max_size=5), text=st.text("abAB_. ", max_size=12))
def test_aligned_letters_are_those_of_the_word(word: str, text: str) -> None:
    found = align(word.lower(), text)
    rest = iter(text.lower())
    is_subsequence = all(letter in rest for letter in word.lower())
    assert (found is not None) == is_subsequence
    if found:
        assert "".join(text[place].lower() for place in found.places) == word.lower()
        assert list(found.places) == sorted(set(found.places))


@given(st.text(max_size=30))
def test_no_query_is_too_odd(query: str) -> None:
    things = [Thing(Kind.STATE, title) for title in ("Kick", "İstanbul", "ß", "[a-z]*", "", "a\nb", "x" * 500)]
    rank(things, query)
