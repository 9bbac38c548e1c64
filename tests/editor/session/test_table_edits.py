"""The table: its rows, differences, and edits of cells."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.editor.session.conftest import apply_table_edit, open_design
from tests.strategies.designs import designs
from vicode.editor.session import DocumentSession, EditResult
from vicode.editor.session.gestures.table_edits import MAX_CELL_LENGTH
from vicode.editor.view import ItemRef, diff_tables, make_table
from vicode.model.design import COMMON, Call, CommonSection, DecisionGroup, Design, Guard, State, Transition, Use
from vicode.store import read_design, save_design

DESIGN = Design(
    component="Player",
    initial="A",
    uses=(Use(alias="head", component="Head"), Use(alias="legs", component="Legs")),
    common=CommonSection(transitions=(Transition(to="A", guard=Guard(when="fallen")),)),
    states=(
        State(
            name="A",
            modulates=(Call(alias="legs", arguments=(("speed", "1"),)),),
            transitions=(
                Transition(to="B", guard=Guard(after="5")),
                DecisionGroup(guard=Guard(when="x"), then=(Transition(to="A"),), otherwise=(Transition(to="B"),)),
            ),
        ),
        State(name="B", final=True),
    ),
)


def rows(document: DocumentSession) -> dict[str, dict[str, Any]]:
    return {row["id"]: row for row in make_table(document.design, ())["rows"]}


def write(document: DocumentSession, row: str, column: str, value: str) -> EditResult:
    base = rows(document)[row]["cells"].get(column, "")
    return apply_table_edit(document, {"kind": "set", "row": row, "column": column, "value": value, "base": base})


def test_rows_are_in_the_order_of_the_decisions(document: DocumentSession) -> None:
    table = rows(document)
    assert list(table) == [
        "common/@common",
        "transitions/@common/0",
        "states/A",
        "transitions/A/0",
        "transitions/A/1",
        "transitions/A/1/then/0",
        "transitions/A/1/else/0",
        "states/B",
    ]
    assert [row["lead"] for row in table.values()] == ["", "1 →", "", "1 →", "2 if", "1 →", "else 1 →", ""]
    assert [row["level"] for row in table.values()] == [1, 2, 1, 2, 2, 3, 3, 1]
    assert table["states/A"]["cells"]["modulates"] == "legs"
    assert table["transitions/A/0"]["cells"]["after"] == "5"


@given(old=designs, new=designs)
def test_a_diff_transforms_one_table_into_another(old: Design, new: Design) -> None:
    before, after = make_table(old, ()), make_table(new, ())
    changes = diff_tables(before, after)
    shown = {row["id"]: row for row in before["rows"]}
    for key in changes["remove"]:
        del shown[key]
    shown.update({row["id"]: row for row in changes["upsert"]})
    order = changes.get("order", [row["id"] for row in before["rows"]])
    assert [shown[key] for key in order] == after["rows"]
    assert changes.get("states", before["states"]) == after["states"]


@pytest.mark.parametrize(
    ("row", "column", "value"),
    [
        ("states/A", "doc", "looks\naround"),
        ("states/A", "requires", "head, legs"),
        ("states/B", "modulates", "head"),
        ("transitions/A/0", "name", "A"),
        ("transitions/A/0", "when", "x > 1"),
        ("transitions/A/0", "after", "7"),
        ("transitions/A/1/else/0", "doc", "last way"),
        ("transitions/@common/0", "when", "up"),
    ],
)
def test_a_cell_is_edited_and_undone(document: DocumentSession, row: str, column: str, value: str) -> None:
    assert not write(document, row, column, value).error
    assert rows(document)[row]["cells"][column] == value
    document.undo()
    assert document.design == DESIGN


def test_times_in_cells_are_read_as_people_write_them(document: DocumentSession) -> None:
    write(document, "transitions/A/0", "after", "500 ms")
    write(document, "transitions/A/1/else/0", "when", "x > 1 after 2 s")
    cells = rows(document)
    assert cells["transitions/A/0"]["cells"]["after"] == "0.5"
    assert (cells["transitions/A/1/else/0"]["cells"]["when"], cells["transitions/A/1/else/0"]["cells"]["after"]) == (
        "x > 1",
        "2",
    )


def test_adding_a_modulation_keeps_existing_arguments(document: DocumentSession) -> None:
    write(document, "states/A", "modulates", "head legs")
    calls = document.design.states[0].modulates
    assert calls == (Call(alias="head"), Call(alias="legs", arguments=(("speed", "1"),)))


def test_renaming_a_state_keeps_its_position(document: DocumentSession) -> None:
    assert write(document, "states/B", "name", "Rest").new_selection == (ItemRef(kind="states", id="Rest"),)
    assert rows(document)["transitions/A/0"]["cells"]["name"] == "Rest"


@pytest.mark.parametrize(
    ("row", "column", "value", "message"),
    [
        ("states/A", "name", "B", "already a state"),
        ("states/A", "name", "<img>", "not a valid name"),
        ("states/A", "requires", "nobody", "this design uses no component 'nobody'"),
        ("transitions/A/0", "name", "C", "no state 'C'"),
        ("transitions/A/1", "name", "B", "only a transition"),
        ("states/A", "when", "x", "cannot be changed"),
        ("states/A", "code", "pass", "expected one of name, when"),
        ("states/A", "final", "yes", "expected one of name, when"),
        ("states/A", "doc", "x" * (MAX_CELL_LENGTH + 1), "too long"),
        ("common/@common", "name", "all", "inspector"),
    ],
)
def test_an_invalid_cell_is_an_error(
    document: DocumentSession, row: str, column: str, value: str, message: str
) -> None:
    assert message in write(document, row, column, value).error
    assert document.design == DESIGN


def test_a_concurrent_change_of_a_cell_is_not_overwritten(document: DocumentSession) -> None:
    payload = {"kind": "set", "row": "states/A", "column": "doc", "value": "mine", "base": "before"}
    write(document, "states/A", "doc", "theirs")
    assert "the cell has changed to 'theirs'" in apply_table_edit(document, payload).error
    assert document.design.states[0].doc == "theirs"


def test_flags_are_toggled(document: DocumentSession) -> None:
    for row, column in (("states/A", "final"), ("states/B", "initial"), ("transitions/A/0", "disabled")):
        apply_table_edit(document, {"kind": "toggle", "row": row, "column": column})
        assert rows(document)[row]["cells"][column] is True
    assert (
        "mark another" in apply_table_edit(document, {"kind": "toggle", "row": "states/B", "column": "initial"}).error
    )


def test_rows_are_added_below_and_selected(document: DocumentSession) -> None:
    outcome = apply_table_edit(document, {"kind": "add-transition", "row": "transitions/A/0"})
    assert outcome.new_selection == (ItemRef(kind="transitions", id="A/1"),)
    assert rows(document)["transitions/A/1"]["cells"]["name"] == "B"
    apply_table_edit(document, {"kind": "add-transition", "row": "common/@common"})
    assert len(document.design.common.transitions) == 2
    outcome = apply_table_edit(document, {"kind": "add-state", "row": "transitions/A/0"})
    assert [state.name for state in document.design.states] == ["A", "State", "B"]
    assert outcome.new_selection == (ItemRef(kind="states", id="State"),)
    apply_table_edit(document, {"kind": "add-state", "row": ""})
    assert document.design.states[-1].name == "State2"


def test_rows_are_moved_and_removed(document: DocumentSession) -> None:
    outcome = apply_table_edit(document, {"kind": "move", "row": "transitions/A/0", "by": 1})
    assert outcome.new_selection == (ItemRef(kind="transitions", id="A/1"),)
    apply_table_edit(document, {"kind": "move", "row": "transitions/A/1", "by": 1})
    assert rows(document)["transitions/A/1"]["cells"]["after"] == "5"
    apply_table_edit(document, {"kind": "move", "row": "states/B", "by": -1})
    assert [state.name for state in document.design.states] == ["B", "A"]
    apply_table_edit(document, {"kind": "remove", "row": "transitions/A/0"})
    apply_table_edit(document, {"kind": "remove", "row": "states/B"})
    assert list(rows(document)) == ["common/@common", "transitions/@common/0", "states/A"]


def test_the_order_of_states_reaches_the_file(document: DocumentSession) -> None:
    text = save_design(DESIGN, "")
    apply_table_edit(document, {"kind": "move", "row": "states/B", "by": -1})
    again = read_design(save_design(document.design, text), "player.yaml").design
    assert again == document.design


_WILD = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20) | st.sampled_from(list("AB")),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner, max_size=3),
    max_leaves=4,
)
_KINDS = st.sampled_from(["set", "toggle", "add-state", "add-transition", "remove", "move"]) | st.text(max_size=9)
_ROWS = st.sampled_from(["states/A", "transitions/A/1/then/0", "transitions/A/9", "common/@common", COMMON, ""]) | _WILD
_COLUMNS = st.sampled_from(["name", "when", "after", "requires", "modulates", "doc", "final", "initial"]) | _WILD


@given(kind=_KINDS, row=_ROWS, column=_COLUMNS, value=_WILD, base=_WILD, by=_WILD)
def test_arbitrary_payloads_neither_raise_nor_break_a_design(
    kind: str, row: object, column: object, value: object, base: object, by: object
) -> None:
    document = open_design(DESIGN)
    fields = {"row": row, "column": column, "value": value, "base": base, "by": by}
    for names in (("row",), ("row", "by"), ("row", "column"), ("row", "column", "value", "base")):
        apply_table_edit(document, {"kind": kind, **{name: fields[name] for name in names}})
    assert read_design(save_design(document.design, ""), "player.yaml").design is not None
