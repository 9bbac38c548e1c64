"""An input is created in project.yaml and used in the design by one edit, which undo and redo revert in both files."""

from collections.abc import Callable
from pathlib import Path

import pytest

from vicode.editor.session import DocumentSession, Workspace
from vicode.editor.session.fixes import Fix, find_fixes
from vicode.editor.session.project.interface_edits import add_command, add_input
from vicode.editor.session.project.project_edits import edit_design_and_project
from vicode.model.project import Interface
from vicode.model.texts import rewrite_text

DESIGN = """vicode: 1
component: Waiter
initial: Wait
states:
  Wait: {transitions: [{to: Go, when: order_given and order_given}, {to: Go, when: "not order_given and battery > 3"}]}
  Go: {final: true}
"""
PROJECT = "vicode: 1\nproject: Cafe\ncomponents:\n  Motors: {parameters: {speed: 0}}\n"

Open = Callable[[str, str], tuple[Workspace, DocumentSession]]


@pytest.fixture
def open_waiter(tmp_path: Path) -> Open:
    def open_(design: str, project: str) -> tuple[Workspace, DocumentSession]:
        (tmp_path / "waiter.yaml").write_text(design)
        if project:
            (tmp_path / "project.yaml").write_text(project)
        workspace = Workspace(tmp_path, "cafe")
        document = workspace.open_document("Waiter")
        assert document is not None
        return workspace, document

    return open_


def create(workspace: Workspace, document: DocumentSession, name: str) -> None:
    fix = next(fix for fix in fixes(workspace, document) if fix.label.startswith(f"Create input {name} "))
    assert fix.edit_project is not None
    assert edit_design_and_project(document, workspace, fix.label, fix.edit, fix.edit_project) == ""


def fixes(workspace: Workspace, document: DocumentSession) -> list[Fix]:
    return [fix for each in document.findings for fix in find_fixes(workspace.project, document.design, each)]


def guards(document: DocumentSession) -> list[str]:
    return [item.guard.when for item in document.design.states[0].transitions]


def names(interface: Interface | None) -> list[tuple[str, str]]:
    return [(output.name, output.type) for output in interface.outputs] if interface else []


@pytest.mark.parametrize("project", [PROJECT, ""])
def test_an_unknown_name_becomes_an_input(open_waiter: Open, tmp_path: Path, project: str) -> None:
    workspace, document = open_waiter(DESIGN, project)
    create(workspace, document, "order_given")
    create(workspace, document, "battery")
    assert guards(document) == [
        "sensors.order_given and sensors.order_given",
        "not sensors.order_given and sensors.battery > 3",
    ]
    assert names(workspace.project.interface("Sensors")) == [("order_given", "bool"), ("battery", "float")]
    assert document.findings == ()

    assert document.undo() == ""
    assert names(workspace.project.interface("Sensors")) == [("order_given", "bool")]
    assert guards(document)[1] == "not sensors.order_given and battery > 3"
    assert document.undo() == ""
    assert (document.design.uses, guards(document)[0]) == ((), "order_given and order_given")
    assert workspace.project.interface("Sensors") is None
    file = tmp_path / "project.yaml"
    assert (file.read_text() if file.exists() else "") == project
    assert document.redo() == ""
    assert document.redo() == ""
    assert document.findings == ()
    assert document.redo_label == ""
    assert document.jump_to(0) == ""
    assert workspace.project.interface("Sensors") is None


def test_an_input_is_added_to_a_used_component_without_an_implementation(open_waiter: Open) -> None:
    project = PROJECT + "  Eyes: {implementation: 'a:B'}\n  Ears: {outputs: {noise: {type: float}}}\n"
    uses = "uses: {motors: Motors, eyes: Eyes, my_ears: Ears}\ninitial"
    workspace, document = open_waiter(DESIGN.replace("initial", uses, 1), project)
    create(workspace, document, "battery")
    assert names(workspace.project.interface("Ears")) == [("noise", "float"), ("battery", "float")]
    assert guards(document)[1] == "not order_given and my_ears.battery > 3"


def test_undo_keeps_the_file_if_the_design_conflicts(open_waiter: Open) -> None:
    workspace, document = open_waiter(DESIGN, PROJECT)
    document.user_id = "one"
    create(workspace, document, "battery")
    other = DocumentSession(document.shared, "two")
    path = ("states", "Wait", "transitions", 1, "when")
    other.edit("rewrite", lambda design: rewrite_text(design, path, lambda _text: "battery < 2"))
    assert document.undo() == "Undo or redo failed: these parts of the design have changed in the meantime"
    assert names(workspace.project.interface("Sensors")) == [("battery", "float")]


def test_an_existing_output_is_used(open_waiter: Open) -> None:
    project = PROJECT + "  Ears: {outputs: {order_given: {type: bool}}}\n"
    workspace, document = open_waiter(DESIGN.replace("initial", "uses: {ears: Ears}\ninitial", 1), project)
    labels = [fix.label for fix in fixes(workspace, document)]
    assert "Use ears.order_given" in labels
    assert not any(label.startswith("Create input order_given") for label in labels)


def test_inputs_and_commands_are_added_by_name(open_waiter: Open) -> None:
    workspace, document = open_waiter(DESIGN, "")
    for edit in (
        add_command(workspace.project, document.design, "walk", "speed, turn: int"),
        add_input(workspace.project, document.design, "order_given", "bool"),
    ):
        assert edit.error == ""
        assert not edit_design_and_project(document, workspace, edit.label, edit.change_design, edit.change_project)
    assert [(use.alias, use.component) for use in document.design.uses] == [("walk", "Walk"), ("sensors", "Sensors")]
    walk = workspace.project.interface("Walk")
    assert walk is not None
    assert [(each.name, each.type) for each in walk.parameters] == [("speed", "float"), ("turn", "int")]
    assert names(workspace.project.interface("Sensors")) == [("order_given", "bool")]
    assert document.undo_label == "add input order_given"


@pytest.mark.parametrize(
    ("name", "detail", "error"),
    [
        ("Walk", "", "there is already a component Walk"),
        ("run", "a, a", "there is already a parameter a"),
        ("run", "a b", "invalid"),
        ("", "", ""),
    ],
)
def test_invalid_commands_are_rejected(open_waiter: Open, name: str, detail: str, error: str) -> None:
    workspace, document = open_waiter(DESIGN, PROJECT + "  Walk: {}\n")
    edit = add_command(workspace.project, document.design, name, detail)
    assert edit.error
    assert error in edit.error or error == "invalid"


def test_an_input_that_exists_is_rejected(open_waiter: Open) -> None:
    workspace, document = open_waiter(DESIGN, PROJECT + "  Sensors: {outputs: {battery: {type: float}}}\n")
    assert add_input(workspace.project, document.design, "battery", "bool").error == "there is already an input battery"
