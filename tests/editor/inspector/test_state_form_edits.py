"""Edits of the form of a state: what it does, its name, its lists, and what is refused without a loss."""

from dataclasses import replace
from typing import Any

import pytest

from tests.editor.inspector.test_form_edits import edit
from tests.editor.session.conftest import open_design
from vicode.decoding import MalformedEventError
from vicode.editor.session import DocumentSession, texts
from vicode.editor.session.forms.action_form import adders
from vicode.editor.session.forms.form_data import FormWriter, item_form
from vicode.editor.session.forms.form_places import FormResult
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.marks import ItemFields, marks_of
from vicode.editor.session.forms.nodes import Cards, Section, iter_fields
from vicode.editor.view import ItemRef
from vicode.findings import Finding, FindingSubject, get_rule
from vicode.model.design import (
    Assign,
    Call,
    Code,
    CommonSection,
    Declaration,
    Design,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.edits import rename_state
from vicode.model.project import Interface, Project

COUNT = Assign(values=(("count", "0"),))
CODE = RunCode(code=Code(texts=(("python", "self.log()"),)))
DESIGN = Design(
    component="Player",
    initial="A",
    uses=(Use(alias="kicker", component="Kicker"), Use(alias="head", component="Head")),
    variables=(Declaration(name="count", type="int", initial="0"),),
    states=(
        State(
            name="A",
            id="a",
            actions=(COUNT, CODE, Call(alias="kicker")),
            modulates=(Call(alias="head", arguments=(("speed", "0.5"),)),),
            transitions=(Transition(to="B"),),
        ),
        State(name="B"),
    ),
    common=CommonSection(actions=(COUNT,)),
)
PROJECT = Project(
    name="p",
    components=(
        Interface(component="Head", parameters=(Declaration(name="speed", type="float", unit="m/s"),)),
        Interface(component="Kicker"),
    ),
)
A = {"of": "states", "id": "A"}
COMMON = {"of": "common", "id": "@common"}


@pytest.fixture
def document() -> DocumentSession:
    return open_design(DESIGN)


def state(document: DocumentSession, name: str = "A") -> State:
    found = document.design.state(name)
    assert found is not None
    return found


def texts_of(nodes: Any) -> dict[str, Any]:
    return {"/".join(map(str, node.path)): node.value for node in iter_fields(nodes)}


def test_each_field_is_written(document: DocumentSession) -> None:
    for path, text in (("doc", "near"), ("capacity", "2"), ("synchronized", "3"), ("xabsl_name", " a ")):
        assert edit(document, "text", A, path=path, base="", text=text).error == ""
    for path in ("final", "disabled"):
        edit(document, "check", A, path=path, value=True)
    edit(document, "choose", A, path="color", value="red")
    edit(document, "choose-several", A, path="requires", base=[], value=["head", "kicker"])
    edit(document, "check", {"of": "states", "id": "B"}, path="initial", value=True)
    assert document.design.initial == "B"
    changed = {
        "doc": "near",
        "capacity": 2,
        "synchronized": 3,
        "xabsl_name": "a",
        "final": True,
        "disabled": True,
        "color": "red",
        "requires": ("head", "kicker"),
    }
    assert state(document) == replace(DESIGN.states[0], at=state(document).at, **changed)
    for _ in range(9):
        assert document.undo() == ""
    assert document.design == DESIGN


def test_values_that_no_field_can_have_are_refused(document: DocumentSession) -> None:
    assert "whole number" in edit(document, "text", A, path="capacity", base="", text="many").error
    assert edit(document, "choose", A, path="color", value="mauve").error
    assert edit(document, "choose-several", A, path="doc", base=[], value=["x"]).error
    edit(document, "check", A, path="initial", value=False)
    assert document.design == DESIGN


def test_what_others_have_chosen_meanwhile_is_kept(document: DocumentSession) -> None:
    rev = document.rev
    edit(document, "choose-several", A, path="requires", base=[], value=["head"])
    edit(document, "choose-several", A, path="requires", base=[], value=["kicker"], rev=rev)
    assert state(document).requires == ("head", "kicker")
    edit(document, "choose-several", A, path="requires", base=["head", "kicker"], value=["kicker"])
    assert state(document).requires == ("kicker",)


@pytest.mark.parametrize("text", ["= 0.7", "speed 0.7", "speed =", "speed = 1\nspeed = 2", "speed"])
def test_a_parameter_that_cannot_be_read_keeps_the_old_value(document: DocumentSession, text: str) -> None:
    result = edit(document, "text", A, path="modulates/head/arguments", base="speed = 0.5", text=text)
    assert result.error
    assert document.design is DESIGN
    # Typed on: the text that was refused is not part of the design.
    written = edit(document, "text", A, path="modulates/head/arguments", base=text, text="speed = 0.7")
    assert written == FormResult(own="speed = 0.7")
    assert state(document).modulates == (Call(alias="head", arguments=(("speed", "0.7"),)),)


def test_an_empty_value_in_the_file_can_be_corrected() -> None:
    broken = replace(DESIGN.states[0], modulates=(Call(alias="head", arguments=(("speed 0.7", ""),)),))
    document = open_design(replace(DESIGN, states=(broken, DESIGN.states[1])))
    edit(document, "text", A, path="modulates/head/arguments", base="speed 0.7 = ", text="speed = 0.7")
    assert state(document).modulates[0].arguments == (("speed", "0.7"),)


def test_a_name_in_the_file_that_no_line_can_express_is_not_rewritten() -> None:
    odd = replace(DESIGN.states[0], modulates=(Call(alias="head", arguments=(("a=b", "1"), ("speed", "0.5"))),))
    design = replace(DESIGN, states=(odd, DESIGN.states[1]))
    document = open_design(design)
    shown = "a=b = 1\nspeed = 0.5"
    result = edit(document, "text", A, path="modulates/head/arguments", base=shown, text="a=b = 1\nspeed = 0.7")
    assert "edit it in the file" in result.error
    assert document.design is design


def test_the_last_assignment_is_removed_with_its_action(document: DocumentSession) -> None:
    assert edit(document, "text", A, path="actions/0/values", base="count = 0", text=" ").error
    assert state(document).actions[0] == COUNT
    edit(document, "press", A, action="remove-card", path="actions/0")
    assert state(document).actions == DESIGN.states[0].actions[1:]


def test_two_people_set_different_parameters(document: DocumentSession) -> None:
    rev, path, base = document.rev, "modulates/head/arguments", "speed = 0.5"
    edit(document, "text", A, path=path, base=base, text="speed = 0.5\nturn = 1")
    result = edit(document, "text", A, path=path, base=base, text="speed = 0.7", rev=rev)
    assert result == FormResult(own="speed = 0.7")
    assert state(document).modulates[0].arguments == (("speed", "0.7"), ("turn", "1"))


def test_a_new_action_is_edited_under_the_id_of_the_browser(document: DocumentSession) -> None:
    rev = document.rev
    add = {"action": "add-card", "path": "enter", "rev": rev}
    edit(document, "press", A, adds="set", card="babcd", text="count = 0", **add)
    edit(document, "press", A, adds="code", card="bcode", **add)
    edit(document, "text", A, path="enter/babcd/values", base="count = 0", text="count = 1", rev=rev)
    edit(document, "text", A, path="enter/bcode/code/python", base="", text="pass", rev=rev)
    assert state(document).enter == (
        Assign(values=(("count", "1"),)),
        RunCode(code=Code(texts=(("python", "pass"),))),
    )
    edit(document, "press", A, action="add-card", path="actions", adds="call", card="bcall", to="head")
    edit(document, "text", A, path="actions/bcall/arguments", base="", text="speed = 1")
    assert state(document).actions[-1] == Call(alias="head", arguments=(("speed", "1"),))


def test_an_edit_finds_its_action_wherever_others_have_moved_it(document: DocumentSession) -> None:
    rev = document.rev
    edit(document, "press", A, action="move-card", path="actions/1", to="-1")
    edit(document, "press", A, action="move-card", path="actions/1", to="-1")
    edit(document, "press", A, action="add-card", path="actions", adds="set", card="bnew1", text="count = 9")
    edit(document, "press", A, action="move-card", path="actions/bnew1", to="-1")
    document.edit("rename", lambda design: rename_state(design, "A", "Start"))
    result = edit(document, "text", A, path="actions/1/code/python", base="self.log()", text="pass", rev=rev)
    assert result.error == ""
    assert state(document, "Start").actions == (
        RunCode(code=Code(texts=(("python", "pass"),))),
        COUNT,
        Assign(values=(("count", "9"),)),
        Call(alias="kicker"),
    )


def test_actions_that_are_gone_are_not_edited(document: DocumentSession) -> None:
    edit(document, "press", A, action="remove-card", path="actions/1")
    before = document.design
    assert edit(document, "text", A, path="actions/1/code/python", base="self.log()", text="x").error
    for action in ("remove-card", "move-card"):
        assert edit(document, "press", A, action=action, path="actions/1", to="1").error
    assert document.design is before


def test_components_are_modulated_and_left(document: DocumentSession) -> None:
    edit(document, "press", A, action="add-card", path="modulates", adds="modulation", card="kicker", to="kicker")
    edit(document, "text", A, path="modulates/kicker/arguments", base="", text="power = 1")
    assert [call.alias for call in state(document).modulates] == ["head", "kicker"]
    edit(document, "press", A, action="remove-card", path="modulates/head")
    assert state(document).modulates == (Call(alias="kicker", arguments=(("power", "1"),)),)


@pytest.mark.parametrize(
    "fields",
    [
        {"path": "actions", "adds": "call", "to": "nobody"},
        {"path": "modulates", "adds": "modulation", "to": "nobody"},
        {"path": "transitions", "adds": "code"},
        {"path": "doc", "adds": "code"},
        {"path": "actions", "adds": "set", "text": "= 7"},
        {"path": "actions", "adds": "poem"},
    ],
)
def test_only_known_cards_are_added(document: DocumentSession, fields: dict[str, str]) -> None:
    assert edit(document, "press", A, action="add-card", card="babcd", **fields).error
    assert document.design is DESIGN


def test_a_state_is_renamed_unless_the_name_is_taken(document: DocumentSession) -> None:
    rev = document.rev
    refused = edit(document, "name", A, path="name", base="A", text="B")
    assert "already" in refused.error
    assert document.design is DESIGN
    result = edit(document, "name", A, path="name", base="A", text=" Start ")
    assert (result.own, result.error) == ("Start", "")
    assert result.renamed == (ItemRef(kind="states", id="A"), ItemRef(kind="states", id="Start"))
    again = edit(document, "name", A, path="name", base="A", text="Begin", rev=rev)
    assert again.own == "Begin"
    assert document.design.initial == "Begin"
    assert edit(document, "name", {"of": "transitions", "id": "Begin/0"}, path="name", base="", text="x").error


def test_malformed_edits_are_not_decoded(document: DocumentSession) -> None:
    for kind, fields in (
        ("choose-several", {"path": "requires", "base": [], "value": [1]}),
        ("name", {"path": "name", "text": "x"}),
        ("press", {"action": "add-card", "card": 7}),
    ):
        with pytest.raises(MalformedEventError):
            edit(document, kind, A, **fields)


def test_the_form_of_every_state_is_edited(document: DocumentSession) -> None:
    edit(document, "text", COMMON, path="doc", base="", text="always")
    edit(document, "text", COMMON, path="actions/0/values", base="count = 0", text="count = 1")
    edit(document, "press", COMMON, action="add-stay", path="transitions")
    assert document.design.common == CommonSection(
        doc="always", actions=(Assign(values=(("count", "1"),)),), transitions=(Stay(),)
    )


def test_the_form_shows_each_part_of_a_state() -> None:
    full = replace(
        DESIGN.states[0],
        doc="near",
        enter=(COUNT,),
        leave=(CODE,),
        requires=("head",),
        capacity=1,
        synchronized=2,
        xabsl_name="a",
    )
    design = replace(DESIGN, states=(full, DESIGN.states[1]))
    nodes = item_form(PROJECT, design, ItemRef(kind="states", id="A"), ListIds())
    assert texts_of(nodes) == {
        "name": "A",
        "doc": "near",
        "actions/0/values": "count = 0",
        "actions/1/code/python": "self.log()",
        "actions/2/arguments": "",
        "modulates/head/arguments": "speed = 0.5",
        "requires": ("head",),
        "enter/0/values": "count = 0",
        "leave/0/code/python": "self.log()",
        "capacity": "1",
        "synchronized": "2",
        "xabsl_name": "a",
    }
    assert [(node.key, node.is_set) for node in nodes if isinstance(node, Section)] == [
        ("enter-leave", True),
        ("more", True),
    ]
    plain = item_form(PROJECT, design, ItemRef(kind="states", id="B"), ListIds())
    assert not any(node.is_set for node in plain if isinstance(node, Section))
    # XABSL matters to the whole project, to a state with a name in it, or not at all.
    assert "xabsl_name" not in texts_of(plain)
    with_xabsl = Project(name="p", languages=("python", "xabsl"))
    assert "xabsl_name" in texts_of(item_form(with_xabsl, design, ItemRef(kind="states", id="B"), ListIds()))
    assert [card.title for node in nodes if isinstance(node, Cards) for card in node.cards] == [
        "Set",
        "Code",
        "Call kicker",
        "head",
    ]


def test_new_cards_begin_with_what_can_stand_there() -> None:
    found = adders(PROJECT, DESIGN)
    assert [adder["label"] for adder in found["actions"]] == ["Set", "Call", "Code"]
    assert [adder["label"] for adder in found["effects"]] == ["Set", "Code"]
    assert found["actions"][0]["nodes"][0]["value"] == "count = 0"


def test_only_the_forms_that_changed_are_written_again(document: DocumentSession) -> None:
    writer, ids = FormWriter(), document.shared.list_ids
    before = writer.write(PROJECT, document.design, ids)
    edit(document, "press", A, action="remove-card", path="actions/0")
    after = writer.write(PROJECT, document.design, ids)
    assert [key for key in after if after[key] != before[key]] == ["states/A"]
    assert '"actions","1","code","python"' in after["states/A"]
    edit(document, "check", {"of": "states", "id": "B"}, path="initial", value=True)
    last = writer.write(PROJECT, document.design, ids)
    assert [key for key in last if last[key] != after[key]] == ["design/", "states/A", "states/B"]


def test_findings_stand_at_their_fields(document: DocumentSession) -> None:
    edit(document, "press", A, action="remove-card", path="actions/0")
    fields = ItemFields.of(PROJECT, document.design, ItemRef(kind="states", id="A"), document.shared.list_ids)
    places = {
        ("modulates", "head", "speed"): ("modulates/head/arguments", "speed"),
        ("modulates", "head"): ("modulates/head/arguments", "speed = 0.5"),
        ("actions", 0, "code"): ("actions/1/code/python", "self.log()"),
        ("requires", 0): ("requires", ""),
    }
    shown = texts_of(fields.nodes)
    for path, (field, words) in places.items():
        subject = FindingSubject(component="Player", path=("states", "A", *path))
        (mark,) = marks_of(fields, [Finding(rule=get_rule("D403"), message="wrong", subject=subject)])
        assert mark["path"] == field
        text = shown[field] if isinstance(shown[field], str) else ""
        assert text[mark["start"] : mark["end"]] == words


def test_a_new_modulation_is_typed_into_before_the_browser_knows_its_revision(document: DocumentSession) -> None:
    rev = document.rev
    add = {"action": "add-card", "path": "modulates", "adds": "modulation", "card": "kicker", "to": "kicker"}
    edit(document, "press", A, rev=rev, **add)
    path = "modulates/kicker/arguments"
    assert edit(document, "text", A, path=path, base="", text="s", rev=rev).error != texts.ITEM_MISSING
    assert edit(document, "text", A, path=path, base="s", text="speed = 1", rev=rev).error == ""
    assert state(document).modulates[-1] == Call(alias="kicker", arguments=(("speed", "1"),))
