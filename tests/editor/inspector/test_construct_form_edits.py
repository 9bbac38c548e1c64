"""Edits of the forms of latches, interrupts, steps and layers; files and lowered designs are the oracle."""

from typing import Any

import pytest
import yaml

from tests.editor.inspector.test_form_edits import edit
from tests.editor.session.conftest import open_design
from vicode.decoding import decode_event
from vicode.editor.session import DocumentSession
from vicode.editor.session.forms.construct_form import construct_adders, construct_parts
from vicode.editor.session.forms.edits import FORM_EDITS
from vicode.editor.session.forms.form_data import FormWriter, form_lists, item_form
from vicode.editor.session.forms.form_paths import at_design
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.marks import ItemFields, marks_of
from vicode.editor.session.forms.nodes import Cards, Check, FormPart, Heading, Node, Row, Section, Title
from vicode.editor.view import ItemRef, item_at_path, item_label
from vicode.findings import Finding, FindingSubject, get_rule
from vicode.model.design import Design, State
from vicode.model.edits import rename_state
from vicode.model.lowering import lift_design
from vicode.model.merge import find_renamed_states, merge_designs
from vicode.model.project import Interface, Project
from vicode.store import read_design, save_design

HERE = {"of": "design", "id": ""}
PROJECT = Project(name="p", components=(Interface(component="Drive"),))
STATES = """\
vicode: 1
component: Rover
uses: {drive: Drive}
parameters: {near: 1}
initial: Walk
latches:
  hot: {on: near > 2, hold: 1}
interrupts:
  - {do: Cool, when: hot}
states:
  Walk: {transitions: [{to: Done, when: near > 9}]}
  Cool: {}
  Done: {final: true}
"""
LAYERS = """\
vicode: 1
component: Rover
uses: {drive: Drive}
parameters: {near: 1}
layers:
  Walk: {modulates: [drive]}
  Stop: {when: near > 2, requires: [drive], modulates: {drive: {speed: 0}}}
"""
COMPETENCE = """\
vicode: 1
component: Rover
uses: {drive: Drive}
parameters: {near: 1}
competence:
  goal: near > 9
  steps:
    Stop: {when: near > 2}
    Walk: {modulates: [drive]}
"""


def opened(text: str) -> DocumentSession:
    design = read_design(text).design
    assert design is not None
    return open_design(design)


def saved(document: DocumentSession, text: str) -> str:
    """The lines of the file that are new."""
    return "\n".join(line for line in save_design(document.design, text).splitlines() if line not in text.splitlines())


def iter_checks(nodes: tuple[Node, ...]) -> list[Check]:
    inner = [each for node in nodes for each in (node.nodes if isinstance(node, Row | Section) else (node,))]
    return [node for node in inner if isinstance(node, Check)]


def headings(nodes: tuple[Node, ...]) -> set[str]:
    return {node.text for node in nodes if isinstance(node, Heading)}


def test_a_design_without_constructs_shows_nothing_but_a_menu() -> None:
    nodes = item_form(PROJECT, Design(component="Plain", states=(State(name="A"),)), ItemRef(kind="design"), ListIds())
    assert not headings(nodes) & {"Latches", "Interrupts", "Steps", "Layers", "Competence"}
    cards = [node for node in nodes if isinstance(node, Cards)]
    assert [node.path for node in cards if node.menu] == [("variables",)]
    assert [node.adders for node in cards if node.path[0] == "design"] == [""] * 4


@pytest.mark.parametrize(
    ("text", "possible"),
    [
        (STATES, {"Latch"}),
        (STATES.replace("  - {do: Cool, when: hot}\n", "").replace("interrupts:\n", ""), {"Latch", "Interrupt"}),
        (LAYERS, {"Latch", "Interrupt", "Layer"}),
        (COMPETENCE, {"Latch", "Interrupt"}),
        ("vicode: 1\ncomponent: Rover\n", {"Latch", "Layer", "Competence"}),
    ],
)
def test_the_menu_adds_what_the_design_can_have(text: str, possible: set[str]) -> None:
    menu = construct_adders(PROJECT, opened(text).design)["constructs"]
    assert [each["label"] for each in menu] == ["Latch", "Interrupt", "Competence", "Layer"]
    assert {each["label"] for each in menu if each["adds"]} == possible


def test_what_is_derived_is_in_no_list() -> None:
    document = opened(STATES.replace("hot: {", "hot: {off: near < 1, "))
    forms = FormWriter().write(PROJECT, document.design, ListIds())
    assert "hot_until" not in forms["design/"]
    assert "cool_from" not in forms["states/Walk"]
    assert '"is_derived":true' in forms["states/Walk"]
    assert "hot_until" not in str(form_lists(PROJECT, document.design)["adders"]["actions"])


def test_forms_of_derived_items_are_those_of_their_constructs() -> None:
    ids = ListIds()
    for text, item, key in (
        (STATES, ItemRef(kind="transitions", id="Walk/0"), "design/interrupts/0"),
        (LAYERS, ItemRef(kind="states", id="Stop"), "design/layers/1"),
        (COMPETENCE, ItemRef(kind="states", id="Walk"), "design/competence/steps/1"),
        (COMPETENCE, ItemRef(kind="states", id="Choose"), "design/competence"),
    ):
        design = opened(text).design
        parts = [node.form for node in item_form(PROJECT, design, item, ids) if isinstance(node, FormPart)]
        assert parts == [key]
        assert key in construct_parts(PROJECT, design, ids)
    edge = item_form(PROJECT, opened(STATES).design, ItemRef(kind="transitions", id="Walk/0"), ids)
    assert [(each.text, each.name) for each in edge if isinstance(each, Title)] == [("Interrupt by", "Cool")]


def test_fields_are_written_to_the_file() -> None:
    document = opened(STATES)
    edit(document, "text", HERE, path="latches/0/off", base="", text="near < 1")
    edit(document, "text", HERE, path="interrupts/0/during", base="", text="Walk, C*")
    edit(document, "choose", HERE, path="interrupts/0/then", value="restart")
    edit(document, "text", HERE, path="interrupts/0/every", base="", text="5")
    assert saved(document, STATES) == (
        "  hot: {on: near > 2, off: near < 1, hold: 1}\n"
        "  - {do: Cool, while: [Walk, C*], when: hot, then: restart, every: 5}"
    )
    edit(document, "choose", HERE, path="interrupts/0/then", value="resume")
    assert "then:" not in save_design(document.design, STATES)


def test_a_required_condition_is_not_removed() -> None:
    document = opened(STATES)
    for path, base in (("latches/0/on", "near > 2"), ("interrupts/0/when", "hot")):
        assert edit(document, "text", HERE, path=path, base=base, text=" ").error == "this is required"
    assert document.is_saved


def test_new_items_have_the_ids_and_names_of_the_browser() -> None:
    document = opened(COMPETENCE)
    edit(document, "press", HERE, action="add-card", path="latches", adds="latches", card="b1234", text="cold")
    edit(document, "text", HERE, path="latches/b1234/on", base="", text="near < 0")
    edit(document, "press", HERE, action="add-card", path="competence/steps", adds="steps", card="b5678", text="Stop")
    edit(document, "text", HERE, path="competence/steps/b5678/retries", base="", text="3")
    edit(document, "press", HERE, action="add-card", path="competence/steps/b5678/modulates", card="drive", to="drive")
    edit(document, "text", HERE, path="competence/steps/b5678/modulates/drive/arguments", base="", text="speed = 1")
    assert "    Step: {retries: 3, modulates: {drive: {speed: 1}}}\n" in save_design(document.design, COMPETENCE)
    assert "latches:\n  cold: {on: near < 0}\n" in save_design(document.design, COMPETENCE)
    for _each in range(6):
        assert document.undo() == ""
    assert document.is_saved


@pytest.mark.parametrize(
    ("text", "path", "to", "expected"),
    [
        (LAYERS, "layers/1", "-1", ["Stop", "Walk"]),
        (COMPETENCE, "competence/steps/0", "1", ["Walk", "Stop"]),
    ],
)
def test_the_order_is_changed(text: str, path: str, to: str, expected: list[str]) -> None:
    document = opened(text)
    edit(document, "press", HERE, action="move-card", path=path, to=to)
    steps = document.design.competence.steps if document.design.competence else ()
    assert [each.name for each in (*document.design.layers, *steps)] == expected
    assert [each.name for each in document.design.states if each.name in expected] == expected


def test_removed_steps_and_layers_take_their_states_along() -> None:
    document = opened(LAYERS + "interrupts: [{do: Stop, when: near > 5}]\nframes: {F: {states: [Stop]}}\n")
    edit(document, "press", HERE, action="remove-card", path="layers/1/modulates/drive")
    assert document.design.layers[1].modulates == ()
    edit(document, "press", HERE, action="remove-card", path="layers/1")
    left = lift_design(document.design)
    assert [each.name for each in left.layers] == ["Walk"]
    assert (left.interrupts, left.frames) == ((), ())
    document = opened(COMPETENCE)
    edit(document, "press", HERE, action="remove-card", path="competence")
    assert document.design.states == ()
    edit(document, "press", HERE, action="add-card", path="competence", adds="competence")
    assert [each.name for each in document.design.states] == ["Choose", "Done", "Failed"]


def test_a_used_component_is_removed_from_steps_and_layers() -> None:
    for text in (LAYERS, COMPETENCE):
        document = opened(text)
        edit(document, "press", HERE, action="remove-use", to="drive")
        assert "drive" not in save_design(document.design, text)


@pytest.mark.parametrize(
    "path",
    ["layers", "competence/steps", "competence", "layers/9", "competence/steps/0/when", "latches/9/modulates"],
)
def test_requests_that_the_design_cannot_have_are_refused(path: str) -> None:
    document = opened(STATES)
    for action in ("add-card", "remove-card", "move-card"):
        if (action, path) != ("remove-card", "competence"):
            assert edit(document, "press", HERE, action=action, path=path, to="1", adds="latches").error
    assert document.is_saved


def test_edits_in_other_forms_are_edits_of_the_design() -> None:
    payload: dict[str, Any] = {"item": {"of": "states", "id": "Stop"}, "path": "design/layers/1/when"}
    event = {"kind": "text", "id": 1, "rev": 0, "base": "near > 2", "text": "near > 3", **payload}
    document = opened(LAYERS)
    at_design(decode_event(event, FORM_EDITS)).apply(document)
    assert document.design.layers[1].when == "near > 3"
    assert document.design.common.transitions[0].guard.when == "near > 3"  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("path", "field"),
    [
        (("layers", "Stop", "when"), "design/layers/1/when"),
        (("layers", "Stop", "for"), "design/layers/1/hold"),
        (("states", "Stop", "modulates", "drive", "speed"), "design/layers/1/modulates/drive/arguments"),
    ],
)
def test_findings_are_at_the_fields(path: tuple[str, ...], field: str) -> None:
    design = opened(LAYERS).design
    finding = Finding(
        rule=get_rule("E303"), message="unknown", subject=FindingSubject(component="Rover", path=path, span=(0, 1))
    )
    fields = ItemFields.of(PROJECT, design, ItemRef(kind="design"), ListIds())
    assert [mark["path"] for mark in marks_of(fields, [finding])] == [field]
    assert item_at_path(path) == ItemRef(kind="states", id="Stop")


def test_items_have_labels() -> None:
    design = opened(STATES).design
    assert item_label(design, ("latches", "hot", "on")) == "latch hot"
    assert item_label(design, ("interrupts", 0, "when")) == "an interrupt"


def test_only_final_states_can_be_failed() -> None:
    document, ids = opened(STATES), ListIds()
    forms = [
        [node.path for node in iter_checks(item_form(PROJECT, document.design, ItemRef(kind="states", id=name), ids))]
        for name in ("Walk", "Done")
    ]
    assert [("failed",) in paths for paths in forms] == [False, True]
    edit(document, "check", {"of": "states", "id": "Done"}, path="failed", value=True)
    assert saved(document, STATES) == "  Done: {final: true, failed: true}"


def test_two_people_edit_one_latch() -> None:
    base = opened(STATES).design
    ours, theirs = opened(STATES), opened(STATES)
    edit(ours, "text", HERE, path="latches/0/on", base="near > 2", text="near > 4")
    edit(theirs, "text", HERE, path="latches/0/doc", base="", text="too hot")
    merged = merge_designs(base, ours.design, theirs.design)
    assert merged.conflicts == ()
    assert [(each.on, each.doc) for each in merged.design.latches] == [("near > 4", "too hot")]


def test_a_renamed_step_is_the_same_state() -> None:
    old = opened(COMPETENCE).design
    new = rename_state(rename_state(old, "Walk", "Go"), "Stop", "Halt")
    assert find_renamed_states(old, new) == {"Walk": "Go", "Stop": "Halt"}


@pytest.mark.parametrize("section", ["competence", "layers"])
def test_the_empty_state_of_a_new_design_is_replaced(section: str) -> None:
    text = "vicode: 1\ncomponent: P\ninitial: Start\nstates: {Start: {}}\n"
    document = opened(text)
    edit(document, "press", HERE, action="add-card", path=section, adds=section, card="b1", text="Walk")
    written = yaml.safe_load(save_design(document.design))
    assert set(written) == {"vicode", "component", section}
    assert document.undo() == ""
    assert save_design(document.design, text) == text
    document = opened(text.replace("Start: {}", "Start: {doc: mine}"))
    edit(document, "press", HERE, action="add-card", path=section, adds=section, card="b1", text="Walk")
    assert document.is_saved
