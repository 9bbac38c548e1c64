"""Another name for what is declared: an edit of one design, or files that change together."""

from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from tests.editor.session.conftest import texts_of
from vicode.check import check_project
from vicode.editor.session import DocumentSession, Workspace, rename_symbol
from vicode.editor.session.rename_symbol import apply_symbol_rename, plan_symbol_rename
from vicode.model.design import Code, RunCode
from vicode.model.edits import remove_states
from vicode.model.rename import SymbolRef, is_declared, sibling_names
from vicode.store import open_project

SPEED = SymbolRef(component="Body", section="parameters", name="forward")


def things_of(workspace: Workspace) -> list[SymbolRef]:
    project = workspace.project
    kinds = [SymbolRef(section=section, name="") for section in ("constants", "enumerations", "components", "agents")]
    kinds += [SymbolRef(section="elements", owner=enumeration.name, name="") for enumeration in project.enumerations]
    for name in project.interfaces():
        sections = ("uses", "parameters", "outputs", "variables")
        kinds += [SymbolRef(component=name, section=section, name="") for section in sections]
    return [
        SymbolRef(section=kind.section, name=name, component=kind.component, owner=kind.owner)
        for kind in kinds
        for name in sibling_names(project, kind)
    ]


def some_of(workspace: Workspace) -> list[SymbolRef]:
    """One thing of every kind, and of every kind one that a person declared for a class written by hand."""
    project = workspace.project
    found = {(each.section, project.design(each.component) is None): each for each in things_of(workspace)}
    return list(found.values())


def test_every_kind_of_name_can_be_another_and_come_back(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)
    codes = Counter(finding.rule.code for finding in check_project(workspace.project))
    things = some_of(workspace)
    assert {"uses", "parameters", "outputs", "variables", "constants", "elements"} <= {item.section for item in things}
    for thing in things:
        plan = plan_symbol_rename(workspace, thing, "something_new")
        assert plan.error == "", thing
        if plan.design is not None:
            continue
        assert apply_symbol_rename(workspace, plan) == ""
        renamed = open_project(folder)
        there = SymbolRef(section=thing.section, name=plan.new, component=thing.component, owner=thing.owner)
        if thing.section != "components":
            assert is_declared(renamed.project, there), thing
        assert Counter(finding.rule.code for finding in (*renamed.findings, *check_project(renamed.project))) == codes
        back = plan_symbol_rename(workspace, there, thing.name)
        assert apply_symbol_rename(workspace, back) == ""
        assert texts_of(folder) == before, thing


def test_a_name_that_only_one_design_says_is_an_edit_of_it(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)
    plan = plan_symbol_rename(workspace, SymbolRef(component="Player", section="variables", name="kick"), "shot")
    assert plan.design is not None
    assert plan.changes == ()
    assert [variable.name for variable in plan.design.variables if variable.name in ("kick", "shot")] == ["shot"]
    assert texts_of(folder) == before


@pytest.mark.parametrize(
    ("thing", "new", "words"),
    [
        (SPEED, "", "enter a name"),
        (SPEED, "so fast", "such as soFast"),
        (SPEED, "turn", "there is already a parameter turn"),
        (SPEED, "go_straight", "'go_straight' is already the name of"),
        (SPEED, "state_time", "a name of the runtime"),
        (SPEED, "class", "class"),
        (SymbolRef(component="Body", section="parameters", name="gone"), "x", "no parameter gone any more"),
        (SymbolRef(section="constants", name="pan_threshold"), "speed", "'speed' is already the name of"),
        (SymbolRef(section="elements", owner="Side", name="left"), "right", "already an element right"),
    ],
)
def test_what_cannot_be_a_name_is_told(workspace: Workspace, thing: SymbolRef, new: str, words: str) -> None:
    assert words in plan_symbol_rename(workspace, thing, new).error


def test_what_code_says_already_is_no_new_name(workspace: Workspace) -> None:
    document = workspace.open_document("Player")
    assert document is not None
    note = Code(texts=(("python", "self.memory = 1"),))
    document.edit("note", lambda design: replace(design, common=replace(design.common, actions=(RunCode(code=note),))))
    plan = plan_symbol_rename(workspace, SymbolRef(component="Player", section="variables", name="kick"), "memory")
    assert plan.error == "the code of Player already uses self.memory for something else"


def test_nothing_is_written_while_something_of_it_is_unsaved(workspace: Workspace, folder: Path) -> None:
    document = workspace.open_document("FollowBall")
    assert document is not None
    document.edit("move", lambda design: remove_states(design, ["Align"]))
    assert (
        plan_symbol_rename(workspace, SPEED, "ahead").error == "FollowBall has unsaved changes: save or undo them first"
    )


def test_who_works_on_a_touched_design_hears_of_it(workspace: Workspace, folder: Path) -> None:
    document = workspace.open_document("FollowBall")
    assert document is not None
    heard: list[str] = []
    document.subscribe(lambda _by: heard.append(document.shared.notice.text))
    person = workspace.users.get_or_create_user("ada", "Ada")
    assert apply_symbol_rename(workspace, plan_symbol_rename(workspace, SPEED, "ahead"), person.id) == ""
    assert heard[-1] == "Ada renamed parameter forward to ahead in 2 files"
    assert document.is_saved
    assert document.design.states[0].modulates[1].arguments[0][0] == "ahead"


def labels_of(document: DocumentSession) -> list[str]:
    return [step.label for step in document.history.path[1:]]


def two_hands(workspace: Workspace) -> tuple[DocumentSession, DocumentSession]:
    """Ada's hold on the design that declares the name, and on one that says it."""
    person = workspace.users.get_or_create_user("ada", "Ada")
    body, follow = workspace.open_document("Body"), workspace.open_document("FollowBall")
    assert body is not None
    assert follow is not None
    return DocumentSession(body.shared, person.id), DocumentSession(follow.shared, person.id)


def test_the_histories_of_all_designs_tell_of_the_name_and_take_it_back(workspace: Workspace, folder: Path) -> None:
    body, follow = two_hands(workspace)
    before = follow.design
    follow.edit("say", lambda design: replace(design, doc="Follows."))
    workspace.save(follow)
    said = texts_of(folder)
    assert apply_symbol_rename(workspace, plan_symbol_rename(workspace, SPEED, "ahead"), "ada") == ""
    after = texts_of(folder)
    assert labels_of(body) == ["rename forward to ahead"]
    assert [step.user_id for step in body.history.path[1:]] == ["ada"]
    # Undo of either design is undo of both; so is redo.
    assert follow.undo() == ""
    assert texts_of(folder) == said
    assert labels_of(body) == ["rename forward to ahead", "undo rename forward to ahead"]
    assert (body.undo_label, body.redo_label) == ("", "rename forward to ahead")
    assert body.redo() == ""
    assert texts_of(folder) == after
    assert body.undo() == ""
    # What was done before it can still be taken back.
    assert follow.undo() == ""
    assert follow.design == before


def test_going_back_in_the_history_takes_a_name_back_in_all_files(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)
    body, follow = two_hands(workspace)
    assert apply_symbol_rename(workspace, plan_symbol_rename(workspace, SPEED, "ahead"), "ada") == ""
    after = texts_of(folder)
    named = body.history.current_id
    body.edit("say", lambda design: replace(design, doc="Legs."))
    assert body.jump_to(0) == ""
    assert texts_of(folder) == before
    assert body.is_saved
    assert follow.is_saved
    assert body.jump_to(named) == ""
    assert texts_of(folder) == after
    # What another design has not saved stands in the way, and everything stays.
    follow.edit("say", lambda design: replace(design, doc="Follows."))
    assert body.jump_to(0) == "FollowBall has unsaved changes: save or undo them first"
    assert body.history.current_id == named
    assert "FollowBall has unsaved changes" in body.undo()
    assert texts_of(folder) == after


def test_a_file_that_cannot_be_written_leaves_the_others_as_they_were(
    workspace: Workspace, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = texts_of(folder)
    plan = plan_symbol_rename(workspace, SPEED, "ahead")
    assert [change.file.name for change in plan.changes] == ["body.yaml", "follow_ball.yaml"]
    write = rename_symbol.write_text

    def refusing(file: Path, text: str) -> None:
        if file.name == "follow_ball.yaml":
            raise OSError("the disk is full")
        write(file, text)

    monkeypatch.setattr(rename_symbol, "write_text", refusing)
    with pytest.raises(OSError, match="full"):
        apply_symbol_rename(workspace, plan)
    assert texts_of(folder) == before


def test_a_plan_for_other_files_is_not_carried_out(workspace: Workspace, folder: Path) -> None:
    plan = plan_symbol_rename(workspace, SPEED, "ahead")
    file = folder / "follow_ball.yaml"
    file.write_text(file.read_text().replace("The ball is ahead.", "The ball is there."))
    assert (
        apply_symbol_rename(workspace, plan)
        == "another program has just changed follow_ball.yaml: check it and try again"
    )
    assert "ahead:" not in file.read_text()


def test_a_class_written_by_hand_is_pointed_out(workspace: Workspace) -> None:
    plan = plan_symbol_rename(workspace, SymbolRef(component="Head", section="outputs", name="pan"), "yaw")
    assert "in the hand-written class field.head:Head" in plan.note
    assert "project.yaml" in [change.file.name for change in plan.changes]


def test_whoever_is_at_a_design_that_does_not_say_the_name_hears_of_a_new_one_too(workspace: Workspace) -> None:
    turn = workspace.open_document("Turn")
    assert turn is not None
    heard: list[str] = []
    turn.shared.listeners.append(lambda by: heard.append(by.user_id))
    thing = SymbolRef(section="constants", name="net_x")
    assert apply_symbol_rename(workspace, plan_symbol_rename(workspace, thing, "goal_x"), "someone") == ""
    assert "someone" in heard
    assert "goal_x" in [constant.name for constant in workspace.project.constants]
