"""Edits of the form of the design: its values, its declarations and what it uses."""

from dataclasses import replace

import pytest

from tests.editor.inspector.test_form_edits import edit
from tests.editor.session.conftest import open_design
from vicode.editor.session import DocumentSession, texts
from vicode.editor.session.forms.declaration_form import declared_symbol
from vicode.editor.session.forms.form_data import FormWriter, item_form
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.marks import ItemFields, marks_of
from vicode.editor.session.forms.nodes import Section, iter_fields
from vicode.editor.view import ItemRef
from vicode.findings import Finding, FindingSubject, get_rule
from vicode.model.design import Declaration, Design, State, Use
from vicode.model.project import Interface, Project
from vicode.model.rename import SymbolRef

HERE = {"of": "design", "id": ""}
DESIGN = Design(
    component="Player",
    initial="A",
    uses=(Use(alias="head", component="Head"),),
    parameters=(Declaration(name="speed", initial="1", unit="m/s"),),
    outputs=(Declaration(name="far", type="bool", arguments=(Declaration(name="limit", type="float"),)),),
    variables=(Declaration(name="count", initial="0"), Declaration(name="side", initial="1")),
    states=(State(name="A"), State(name="B")),
)
PROJECT = Project(name="p", components=(Interface(component="Head"), Interface(component="Eyes")))


@pytest.fixture
def document() -> DocumentSession:
    return open_design(DESIGN)


def test_values_of_the_design_are_written(document: DocumentSession) -> None:
    edit(document, "text", HERE, path="doc", base="", text="Plays.")
    edit(document, "text", HERE, path="frequency_hz", base="", text="12.5")
    edit(document, "choose", HERE, path="initial", value="B")
    edit(document, "choose", HERE, path="time_unit", value="ms")
    edit(document, "check", HERE, path="resume", value=True)
    edit(document, "text", HERE, path="members/python", base="", text="def f(self): ...")
    design = document.design
    assert (design.doc, design.frequency_hz, design.initial) == ("Plays.", 12.5, "B")
    assert (design.time_unit, design.resume) == ("ms", True)
    assert design.members.in_language("python") == "def f(self): ..."


@pytest.mark.parametrize(
    ("project", "design", "is_shown"),
    [
        (PROJECT, DESIGN, False),
        (replace(PROJECT, languages=("python", "xabsl")), DESIGN, True),
        (PROJECT, replace(DESIGN, time_unit="ms"), True),
        (PROJECT, replace(DESIGN, arithmetic="xabsl"), True),
    ],
)
def test_xabsl_is_shown_where_it_is_used(project: Project, design: Design, is_shown: bool) -> None:
    form = item_form(project, design, ItemRef(kind="design", id=""), ListIds())
    assert any(isinstance(node, Section) and node.title == "XABSL" for node in form) == is_shown


def test_a_frequency_that_is_no_number_is_refused(document: DocumentSession) -> None:
    edit(document, "text", HERE, path="frequency_hz", base="", text="10")
    assert edit(document, "text", HERE, path="frequency_hz", base="10", text="10x").error
    assert edit(document, "text", HERE, path="variables/0/range", base="", text="5, 1").error
    assert document.design.frequency_hz == 10
    assert document.design.variables == DESIGN.variables


def test_declarations_are_written_where_they_have_moved(document: DocumentSession) -> None:
    edit(document, "press", HERE, action="remove-card", path="variables/0")
    edit(document, "text", HERE, rev=0, path="variables/1/unit", base="", text="legs")
    edit(document, "choose", HERE, path="variables/1/type", value="int")
    edit(document, "text", HERE, path="outputs/0/arguments/0/range", base="", text="0, 9")
    edit(document, "check", HERE, path="parameters/0/tunable", value=True)
    assert document.design.variables == (Declaration(name="side", initial="1", unit="legs", type="int"),)
    assert document.design.outputs[0].arguments == (Declaration(name="limit", type="float", range=(0.0, 9.0)),)
    assert document.design.parameters[0].tunable
    edit(document, "choose", HERE, path="variables/1/type", value="from value")
    assert document.design.variables[0].type == ""


def test_a_new_declaration_has_the_id_and_the_name_that_the_browser_shows(document: DocumentSession) -> None:
    add = {"action": "add-card", "path": "variables", "adds": "variable"}
    edit(document, "press", HERE, rev=0, card="bwxyz1", text="variable", **add)
    edit(document, "text", HERE, rev=0, path="variables/bwxyz1/unit", base="", text="m")
    edit(document, "press", HERE, rev=0, card="bwxyz2", text="variable", **add)
    edit(document, "press", HERE, rev=0, card="bwxyz3", text="no name", **add)
    names = [(each.name, each.unit) for each in document.design.variables[2:]]
    assert names == [("variable", "m"), ("variable2", ""), ("variable3", "")]
    symbol = declared_symbol(document.design, document.shared.list_ids, "variables/bwxyz2/name")
    assert symbol == SymbolRef(component="Player", section="variables", name="variable2")


def test_arguments_are_added_and_removed(document: DocumentSession) -> None:
    path = "outputs/0/arguments"
    edit(document, "press", HERE, action="add-card", path=path, adds="argument", card="bwxyz1", text="side")
    edit(document, "text", HERE, path=f"{path}/bwxyz1/doc", base="", text="Left is 1.")
    arguments = document.design.outputs[0].arguments or ()
    assert [each.name for each in arguments] == ["limit", "side"]
    assert arguments[1].doc == "Left is 1."
    # The ids stay with the output when it moves.
    document.edit("add", lambda old: replace(old, outputs=(Declaration(name="near"), *old.outputs)))
    edit(document, "text", HERE, path=f"{path}/bwxyz1/unit", base="", text="m")
    assert (document.design.outputs[1].arguments or ())[1].unit == "m"
    edit(document, "press", HERE, action="remove-arguments", path=path)
    assert document.design.outputs[1].arguments is None


def test_used_components_are_added_and_removed(document: DocumentSession) -> None:
    edit(document, "press", HERE, action="add-use", to="Eyes")
    assert document.design.uses[1:] == (Use(alias="eyes", component="Eyes"),)
    edit(document, "press", HERE, action="remove-use", to="head")
    assert [use.alias for use in document.design.uses] == ["eyes"]
    assert edit(document, "press", HERE, action="remove-use", to="head").error == texts.ITEM_MISSING


@pytest.mark.parametrize(
    ("action", "path"),
    [
        ("add-card", ""),
        ("add-card", "states"),
        ("add-card", "variables/0/arguments"),
        ("add-card", "outputs/7/arguments"),
        ("add-card", "uses/head"),
        ("remove-card", "variables"),
        ("remove-card", "variables/9"),
        ("remove-card", "states/A"),
        ("remove-arguments", "outputs/0"),
        ("remove", ""),
        ("add-stay", ""),
        ("add-code", ""),
        ("add-use", ""),
    ],
)
def test_buttons_only_change_lists_of_the_form(document: DocumentSession, action: str, path: str) -> None:
    assert edit(document, "press", HERE, action=action, path=path, adds="variable", card="bwxyz1").error
    assert document.design is DESIGN


@pytest.mark.parametrize("path", ["", "component", "states", "uses", "variables", "variables/0", "variables/0/name"])
def test_names_and_lists_are_not_written_as_texts(document: DocumentSession, path: str) -> None:
    assert edit(document, "text", HERE, path=path, base="", text="x").error
    assert document.design is DESIGN


def test_findings_stand_at_the_fields_of_declarations(document: DocumentSession) -> None:
    ids = document.shared.list_ids
    fields = ItemFields.of(PROJECT, DESIGN, ItemRef(kind="design"), ids)
    places = {
        ("variables", "side", "initial"): ["variables/1/name", "variables/1/initial"],
        ("parameters", "speed", "default"): ["parameters/0/name", "parameters/0/initial"],
        ("outputs", "far", "arguments", "limit", "type"): [
            "outputs/0/name",
            "outputs/0/arguments/0/name",
            "outputs/0/arguments/0/type",
        ],
        ("variables", "side"): ["variables/1/name"],
        ("frequency",): ["frequency_hz"],
        ("initial",): ["initial"],
        ("module",): ["module/python"],
    }
    for path, shown in places.items():
        finding = Finding(rule=get_rule("D403"), message="wrong", subject=FindingSubject(component="Player", path=path))
        assert sorted(mark["path"] for mark in marks_of(fields, [finding])) == sorted(shown)


def test_the_form_is_written_again_only_for_what_it_shows(document: DocumentSession) -> None:
    writer, ids = FormWriter(), document.shared.list_ids
    before = writer.write(PROJECT, document.design, ids)
    edit(document, "text", {"of": "states", "id": "A"}, path="doc", base="", text="First.")
    after = writer.write(PROJECT, document.design, ids)
    assert after["design/"] is before["design/"]
    edit(document, "press", HERE, action="remove-card", path="variables/0")
    last = writer.write(PROJECT, document.design, ids)
    assert '"variables","1","unit"' in last["design/"]
    assert '"variables","0"' not in last["design/"]
    paths = {node.path for node in iter_fields(item_form(PROJECT, document.design, ItemRef(kind="design"), ids))}
    assert ("variables", "1", "range") in paths
