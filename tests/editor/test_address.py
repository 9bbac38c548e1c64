"""Addresses: what is selected and the way one came are in them, and nothing in them is trusted."""

import pytest

from vicode.editor.view import Selected
from vicode.editor.view.address import (
    design_address,
    selected_of_text,
    text_of_selected,
    trail_of_text,
    trail_onwards,
)


@pytest.mark.parametrize(
    "selected",
    [
        Selected(of="states", id="Kick"),
        Selected(of="states", id="2nd"),
        Selected(of="transitions", id="Kick/0/then/1"),
        Selected(of="transitions", id="@common/0"),
        Selected(of="common", id="@common"),
        Selected(of="components", id="kicker"),
        Selected(of="links", id="requires/Kick/perception"),
    ],
)
def test_a_selection_comes_back_from_its_text(selected: Selected) -> None:
    assert selected_of_text(text_of_selected(selected)) == selected


def test_addresses_are_readable() -> None:
    assert design_address("forward", "Player", Selected(of="states", id="Kick")) == "/design/forward/Player?select=Kick"
    assert design_address("forward", "Turn", trail=("Player", "Fixmove")) == "/design/forward/Turn?from=Player,Fixmove"
    assert design_address("a/b?c", "x#y") == "/design/a%2Fb%3Fc/x%23y"


@pytest.mark.parametrize("text", ["", "javascript:alert(1)", "design:", "nothing:x"])
def test_what_is_no_thing_is_none(text: str) -> None:
    assert selected_of_text(text) is None


def test_a_trail_holds_only_what_exists_and_never_goes_in_circles() -> None:
    known = {"A", "B", "C"}
    assert trail_of_text("A,<b>,C", known, "B") == ("A", "C")
    assert trail_of_text("A,B,C", known, "B") == ("A",)
    assert trail_onwards(("A", "B"), "C") == ("A", "B", "C")
    assert len(trail_onwards(tuple("DEFGHIJKLMN"), "C")) == 6
