"""Edits of the form of a transition: written, merged with those of others, or refused with a reason."""

from dataclasses import replace
from typing import Any

import pytest

from tests.editor.session.conftest import open_design
from vicode.decoding import MalformedEventError, decode_event
from vicode.editor.session import DocumentSession
from vicode.editor.session.forms.edits import FORM_EDITS
from vicode.editor.session.forms.form_data import item_form
from vicode.editor.session.forms.form_places import FormResult
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.nodes import CodeText, Decisions, Languages, TextField
from vicode.editor.view import ItemRef
from vicode.model.design import Code, CommonSection, DecisionGroup, Design, Guard, State, Stay, Transition
from vicode.model.edits import remove_states, rename_state
from vicode.model.project import Project

DESIGN = Design(
    component="Player",
    initial="A",
    states=(
        State(
            name="A",
            transitions=(
                Transition(to="B", guard=Guard(when="x < 1")),
                DecisionGroup(guard=Guard(when="y"), then=(Transition(to="A"), Stay()), otherwise=(Stay(),)),
            ),
        ),
        State(name="B"),
    ),
    common=CommonSection(transitions=(Transition(to="B", guard=Guard(after="2")),)),
)
FIRST = {"of": "transitions", "id": "A/0"}
GROUP = {"of": "transitions", "id": "A/1"}


@pytest.fixture
def document() -> DocumentSession:
    return open_design(DESIGN)


def edit(document: DocumentSession, kind: str, item: dict[str, str] = FIRST, **fields: Any) -> FormResult:
    payload = {"kind": kind, "id": 1, "rev": document.rev, "item": item, **fields}
    return decode_event(payload, FORM_EDITS).apply(document)


def first(document: DocumentSession) -> Any:
    return document.design.states[0].transitions[0]


def test_texts_choices_and_checks_are_written(document: DocumentSession) -> None:
    edit(document, "text", path="guard/when", base="x < 1", text="x < 2")
    edit(document, "text", path="guard/after", base="", text="3")
    edit(document, "text", path="doc", base="", text="near")
    edit(document, "choose", path="to", value="A")
    edit(document, "check", path="disabled", value=True)
    assert first(document) == Transition(to="A", guard=Guard(when="x < 2", after="3"), doc="near", disabled=True)


def test_letters_of_one_field_are_one_entry_of_the_history(document: DocumentSession) -> None:
    for base, text in (("", "n"), ("n", "ne"), ("ne", "near")):
        edit(document, "text", path="doc", base=base, text=text)
    assert document.undo() == ""
    assert document.design == DESIGN


def test_what_others_typed_meanwhile_is_kept(document: DocumentSession) -> None:
    rev = document.rev
    edit(document, "text", path="guard/when", base="x < 1", text="x < 1!!")
    result = edit(document, "text", path="guard/when", base="x < 1", text="NEW", rev=rev)
    assert first(document).guard.when == "NEW!!"
    assert result == FormResult(own="NEW")


def test_an_edit_follows_its_item_to_a_new_place(document: DocumentSession) -> None:
    rev = document.rev
    document.edit("rename", lambda design: rename_state(design, "A", "Start"))
    document.edit(
        "reorder",
        lambda design: replace(
            design,
            states=tuple(replace(state, transitions=state.transitions[::-1]) for state in design.states),
        ),
    )
    result = edit(document, "text", path="doc", base="", text="near", rev=rev)
    assert result.error == ""
    assert document.design.states[0].transitions[1].doc == "near"


def test_an_edit_of_a_removed_item_is_refused(document: DocumentSession) -> None:
    rev = document.rev
    document.edit("remove", lambda design: remove_states(design, ["A"]))
    before = document.design
    for kind, fields in (
        ("text", {"path": "doc", "base": "", "text": "near"}),
        ("choose", {"path": "to", "value": "B"}),
        ("check", {"path": "disabled", "value": True}),
        ("press", {"action": "add-code"}),
    ):
        assert edit(document, kind, rev=rev, **fields).error == "this item no longer exists"
    assert document.design is before


@pytest.mark.parametrize("path", ["", "id", "guard", "guard/code", "guard/code/cobol", "to/0", "states", "__class__"])
def test_only_the_fields_of_the_form_can_be_written(document: DocumentSession, path: str) -> None:
    assert edit(document, "text", path=path, base="", text="x").error
    assert document.design is DESIGN


@pytest.mark.parametrize("path", ["", "doc", "requires", "transitions/0", "states"])
def test_decisions_are_only_added_to_lists_of_decisions(document: DocumentSession, path: str) -> None:
    for item in (FIRST, {"of": "states", "id": "A"}):
        for action in ("add-stay", "add-group", "remove-row", "move-row"):
            assert edit(document, "press", item, action=action, path=path, to="0").error
    assert document.design is DESIGN


def test_malformed_edits_are_not_decoded(document: DocumentSession) -> None:
    for fields in ({"path": 1}, {"path": "doc", "base": "", "text": None}, {"path": "doc", "text": "x"}):
        with pytest.raises(MalformedEventError):
            edit(document, "text", **fields)
    with pytest.raises(MalformedEventError):
        edit(document, "press", action="format-disk")


def test_code_is_added_edited_in_each_language_and_removed(document: DocumentSession) -> None:
    edit(document, "press", action="add-code")
    assert first(document).id
    edit(document, "text", path="guard/code/python", base="return self.state_time > 2\n", text="return True")
    edit(document, "text", path="guard/code/cpp", base="", text="return true;")
    assert first(document).guard.code == Code(texts=(("python", "return True"), ("cpp", "return true;")))
    edit(document, "press", action="remove-code")
    assert first(document).guard.code is None


def test_rows_of_a_group_are_added_moved_and_removed(document: DocumentSession) -> None:
    edit(document, "press", GROUP, action="add-stay", path="else")
    edit(document, "press", GROUP, action="move-row", path="then", index=0, to="1")
    edit(document, "press", GROUP, action="remove-row", path="else", index=0)
    group = document.design.states[0].transitions[1]
    assert isinstance(group, DecisionGroup)
    assert [type(each) for each in group.then] == [Stay, Transition]
    assert group.otherwise == (Stay(),)
    assert edit(document, "press", GROUP, action="remove-row", path="then", index=7).error


def test_a_removed_transition_is_no_longer_selected(document: DocumentSession) -> None:
    result = edit(document, "press", {"of": "transitions", "id": "@common/0"}, action="remove")
    assert result.new_selection == ()
    assert document.design.common.transitions == ()


def test_the_form_shows_each_part_of_a_decision() -> None:
    coded = replace(
        DESIGN.states[0].transitions[0],
        guard=Guard(when="x", after="1", code=Code(texts=(("python", "return x"), ("cpp", "return x;")))),
    )
    design = replace(DESIGN, time_unit="ms", states=(replace(DESIGN.states[0], transitions=(coded,)), DESIGN.states[1]))
    nodes = item_form(Project(name="p"), design, ItemRef(kind="transitions", id="A/0"), ListIds())
    texts = {node.label: node.value for node in nodes if isinstance(node, TextField | CodeText)}
    assert texts.items() >= {"When": "x", "After (milliseconds in this state)": "1", "Description": ""}.items()
    (code,) = (node for node in nodes if isinstance(node, Languages))
    assert [(text.language, text.value) for text in code.texts] == [("python", "return x"), ("cpp", "return x;")]
    group = item_form(Project(name="p"), DESIGN, ItemRef(kind="transitions", id="A/1"), ListIds())
    lists = [node for node in group if isinstance(node, Decisions)]
    assert [[row.target for row in each.rows] for each in lists] == [["→ A", "stay"], ["stay"]]


def test_a_time_typed_into_the_guard_is_moved_when_the_field_is_left(document: DocumentSession) -> None:
    edit(document, "text", path="guard/when", base="x < 1", text="x < 2 after 500 ms")
    assert first(document).guard == Guard(when="x < 2 after 500 ms")
    edit(document, "settle", path="guard/when")
    assert first(document).guard == Guard(when="x < 2", after="0.5")
    # Typing and moving are one entry of the history.
    assert document.undo() == ""
    assert document.design == DESIGN


def test_a_guard_without_a_time_is_not_edited_again(document: DocumentSession) -> None:
    edit(document, "text", path="guard/when", base="x < 1", text="x < 2 or after 2 s")
    rev = document.rev
    assert edit(document, "settle", path="guard/when").error == ""
    assert document.rev == rev
    assert edit(document, "settle", path="doc").error == ""


def test_always_is_shown_only_where_nothing_else_is_required(document: DocumentSession) -> None:
    def hint(key: str) -> str:
        nodes = item_form(Project(name="p"), document.design, ItemRef(kind="transitions", id=key), ListIds())
        return next(node.hint for node in nodes if isinstance(node, CodeText) and node.label == "When")

    edit(document, "text", path="guard/when", base="x < 1", text="")
    assert hint("A/0") == "always"
    edit(document, "text", path="guard/after", base="", text="2")
    assert hint("A/0") == ""
