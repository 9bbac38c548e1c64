"""Page URLs contain the selection and the trail; their content is untrusted."""

import pytest

from vicode.editor.view import ItemRef
from vicode.editor.view.page_urls import (
    DesignAddress,
    design_url,
    extend_trail,
    format_selection,
    parse_design_url,
    parse_selection,
    parse_trail,
)


@pytest.mark.parametrize(
    "selected",
    [
        ItemRef(kind="states", id="Kick"),
        ItemRef(kind="states", id="2nd"),
        ItemRef(kind="transitions", id="Kick/0/then/1"),
        ItemRef(kind="transitions", id="@common/0"),
        ItemRef(kind="common", id="@common"),
        ItemRef(kind="components", id="kicker"),
        ItemRef(kind="links", id="requires/Kick/perception"),
    ],
)
def test_a_selection_survives_formatting(selected: ItemRef) -> None:
    assert parse_selection(format_selection(selected)) == selected


def test_urls_are_readable() -> None:
    assert design_url("forward", "Player", ItemRef(kind="states", id="Kick")) == "/design/forward/Player?select=Kick"
    assert design_url("forward", "Turn", trail=("Player", "Fixmove")) == "/design/forward/Turn?from=Player,Fixmove"
    assert design_url("a/b?c", "x#y") == "/design/a%2Fb%3Fc/x%23y"


def test_the_url_of_a_design_is_read_back() -> None:
    kick = ItemRef(kind="transitions", id="Kick/0")
    url = design_url("team~a b", "Größe/2", kick, trail=("Player", "Turn"))
    assert parse_design_url(url) == DesignAddress(
        key="team~a b", component="Größe/2", selected=kick, trail="Player,Turn"
    )
    assert parse_design_url("/design/team/Player") == DesignAddress(key="team", component="Player")
    assert [parse_design_url(other) for other in ("/", "/broken/team/a.yaml", "/design/team", "None")] == [None] * 4


@pytest.mark.parametrize("text", ["", "javascript:alert(1)", "design:", "nothing:x"])
def test_an_invalid_selection_is_none(text: str) -> None:
    assert parse_selection(text) is None


def test_a_trail_contains_existing_components_once() -> None:
    known = {"A", "B", "C"}
    assert parse_trail("A,<b>,C", known, "B") == ("A", "C")
    assert parse_trail("A,B,C", known, "B") == ("A",)
    assert extend_trail(("A", "B"), "C") == ("A", "B", "C")
    assert len(extend_trail(tuple("DEFGHIJKLMN"), "C")) == 6
