"""The search index: its items, their ranking, and the matched letters."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.editor.session import Library
from vicode.editor.session.search.fuzzy_match import align
from vicode.editor.session.search.search_index import SearchIndex, SearchItem, SearchKind, SearchTarget, rank_items
from vicode.editor.view import ItemRef

DESIGNS = Path(__file__).parents[3] / "designs"


@pytest.fixture(scope="module")
def items() -> list[SearchItem]:
    return SearchIndex(Library(DESIGNS)).items()


def first(items: list[SearchItem], query: str, here: SearchTarget | None = None) -> SearchItem:
    return rank_items(items, query, here)[0].item


@pytest.mark.parametrize(
    ("query", "kind", "title", "component"),
    [
        ("kick", SearchKind.STATE, "Kick", "Player"),
        ("lfb", SearchKind.STATE, "LookForBall", "Player"),
        ("player", SearchKind.COMPONENT, "Player", "Player"),
        ("ball lost", SearchKind.TRANSITION, "WatchBall → LookForBall", "Player"),
        ("wb", SearchKind.STATE, "WatchBall", "Player"),
        ("net beside", SearchKind.TRANSITION, "SearchNet → AlignLateral", "Player"),
        ("fallen", SearchKind.TRANSITION, "every state → GetUp", "Player"),
        ("kicks", SearchKind.DECLARATION, "kicks", "Player"),
        ("stand_up", SearchKind.USE, "stand_up", "Player"),
    ],
)
def test_the_intended_item_ranks_first(
    items: list[SearchItem], query: str, kind: SearchKind, title: str, component: str
) -> None:
    found = first(items, query, SearchTarget(project="forward", component="Player"))
    assert (found.kind, found.title) == (kind, title)
    assert found.target is not None
    assert found.target.component == component


def test_items_have_targets(items: list[SearchItem]) -> None:
    tree = first(items, "net beside")
    assert tree.target == SearchTarget(
        project="forward", component="Player", selected=ItemRef(kind="transitions", id="SearchNet/0/then/2")
    )
    assert tree.location == "Player · Forward"
    hand_written = first(items, "kicker hand-written")
    assert hand_written.target is not None
    assert hand_written.target.selected == ItemRef(kind="components", id="kicker")


def test_items_of_the_open_design_rank_first(items: list[SearchItem]) -> None:
    for component in ("Player", "FaceBall", "FollowBall"):
        here = SearchTarget(project="forward", component=component)
        found = rank_items(items, "", here)
        assert {match.item.target.component for match in found[:3] if match.item.target} == {component}


def test_every_word_must_match(items: list[SearchItem]) -> None:
    assert rank_items(items, "kick zzz") == ()
    assert rank_items(items, "qqqq") == ()


def test_matched_letters_are_reported(items: list[SearchItem]) -> None:
    (match, *_rest) = rank_items(items, "lfb")
    assert [match.item.title[place] for place in match.positions] == ["L", "F", "B"]


def test_latches_are_found_by_their_conditions(items: list[SearchItem]) -> None:
    found = first(items, "rover.bumped backing")
    assert (found.kind, found.title, found.location) == (SearchKind.DECLARATION, "backing", "ByCompetence · Styles")


def test_unchanged_designs_are_cached() -> None:
    index = SearchIndex(Library(DESIGNS))
    before = {id(thing) for thing in index.items() if thing.target and thing.kind is SearchKind.STATE}
    after = {id(thing) for thing in index.items() if thing.target and thing.kind is SearchKind.STATE}
    assert before == after


@given(word=st.text("abAB_ ", min_size=1, max_size=5), text=st.text("abAB_. ", max_size=12))
def test_aligned_positions_spell_the_word(word: str, text: str) -> None:
    found = align(word.lower(), text)
    rest = iter(text.lower())
    is_subsequence = all(letter in rest for letter in word.lower())
    assert (found is not None) == is_subsequence
    if found:
        assert "".join(text[place].lower() for place in found.positions) == word.lower()
        assert list(found.positions) == sorted(set(found.positions))


@given(st.text(max_size=30))
def test_no_query_raises(query: str) -> None:
    items = [
        SearchItem(SearchKind.STATE, title) for title in ("Kick", "İstanbul", "ß", "[a-z]*", "", "a\nb", "x" * 500)
    ]
    rank_items(items, query)
