"""Ids of actions stay with their actions, whatever others do with the list."""

from dataclasses import replace
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from vicode.editor.session.forms.list_ids import ListIds
from vicode.model.design import Action, Assign, Call, Design, State
from vicode.model.edits import rename_state

PATH = ("states", "A", "actions")


def design_with(actions: tuple[Action, ...], name: str = "A") -> Design:
    return Design(component="C", states=(State(name="B"), State(name=name, id="a", actions=actions)))


def assign(number: int) -> Assign:
    return Assign(values=((f"variable{number}", str(number)),))


def test_an_edited_action_keeps_its_id_and_a_new_one_gets_the_wanted_one() -> None:
    ids, old = ListIds(), design_with((assign(1), assign(2)))
    new = design_with((assign(1), Call(alias="kicker")))
    ids.follow(old, new)
    assert ids.ids(PATH, new.states[1].actions) == ("0", "1")
    grown = design_with((*new.states[1].actions, assign(3)))
    ids.want(PATH, "bwanted")
    ids.follow(new, grown)
    assert ids.ids(PATH, grown.states[1].actions) == ("0", "1", "bwanted")
    assert ids.index(PATH, grown.states[1].actions, "bwanted") == 2
    assert ids.index(PATH, grown.states[1].actions, "other") is None


def test_ids_that_no_browser_sends_are_not_taken() -> None:
    for wanted in ("", "0", "n1", "b/../../x", "b" * 99):
        ids, old, new = ListIds(), design_with(()), design_with((assign(1),))
        ids.want(PATH, wanted)
        ids.follow(old, new)
        assert ids.ids(PATH, new.states[1].actions) == ("n1",)


def test_ids_follow_a_renamed_state() -> None:
    ids, old = ListIds(), design_with((assign(1), assign(2)))
    smaller = design_with((assign(2),))
    ids.follow(old, smaller)
    renamed = rename_state(smaller, "A", "Start")
    ids.follow(smaller, renamed)
    assert ids.ids(("states", "Start", "actions"), (assign(2),)) == ("1",)
    back = replace(renamed, initial="Start")
    ids.follow(renamed, back)
    assert ids.ids(("states", "Start", "actions"), (assign(2),)) == ("1",)


@given(st.lists(st.lists(st.integers(0, 7), unique=True, max_size=6), min_size=2, max_size=6))
def test_an_id_names_the_same_action_as_long_as_it_exists(versions: list[list[int]]) -> None:
    ids, designs = ListIds(), [design_with(tuple(assign(each) for each in version)) for version in versions]
    named: dict[str, int] = {str(at): number for at, number in enumerate(versions[0])}
    for version, (old, new) in zip(versions[1:], pairwise(designs), strict=True):
        ids.follow(old, new)
        now = dict(zip(ids.ids(PATH, new.states[1].actions), version, strict=True))
        assert len(now) == len(version)
        for id_, number in named.items():
            if number in version:
                assert now[id_] == number
        named = now
