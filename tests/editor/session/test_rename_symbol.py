"""Rename symbol: an edit of one design, or a change of several files."""

from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from tests.editor.session.conftest import texts_of
from vicode.check import check_project
from vicode.editor.session import DocumentSession, Workspace
from vicode.editor.session.project.renames import apply_symbol_rename
from vicode.model.design import Code, RunCode
from vicode.model.edits import remove_states
from vicode.model.rename import SymbolRef, is_declared, sibling_names
from vicode.services.rename import files
from vicode.services.rename.symbol import plan_symbol_rename
from vicode.store import open_project

SPEED = SymbolRef(component="Body", section="parameters", name="forward")


def all_symbols(workspace: Workspace) -> list[SymbolRef]:
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


def sample_symbols(workspace: Workspace) -> list[SymbolRef]:
    """One symbol of each section, declared in a design and in project.yaml."""
    project = workspace.project
    samples = {(symbol.section, project.design(symbol.component) is None): symbol for symbol in all_symbols(workspace)}
    return list(samples.values())


def test_every_kind_of_symbol_can_be_renamed_and_renamed_back(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)
    codes = Counter(finding.rule.code for finding in check_project(workspace.project))
    symbols = sample_symbols(workspace)
    assert {"uses", "parameters", "outputs", "variables", "constants", "elements"} <= {item.section for item in symbols}
    for symbol in symbols:
        plan = plan_symbol_rename(workspace, symbol, "something_new")
        assert plan.error == "", symbol
        if plan.design is not None:
            continue
        assert apply_symbol_rename(workspace, plan) == ""
        renamed = open_project(folder)
        there = SymbolRef(section=symbol.section, name=plan.new, component=symbol.component, owner=symbol.owner)
        if symbol.section != "components":
            assert is_declared(renamed.project, there), symbol
        assert Counter(finding.rule.code for finding in (*renamed.findings, *check_project(renamed.project))) == codes
        back = plan_symbol_rename(workspace, there, symbol.name)
        assert apply_symbol_rename(workspace, back) == ""
        assert texts_of(folder) == before, symbol


def test_a_symbol_of_one_design_is_renamed_by_an_edit(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)
    plan = plan_symbol_rename(workspace, SymbolRef(component="Player", section="variables", name="kick"), "shot")
    assert plan.design is not None
    assert plan.changes == ()
    assert [variable.name for variable in plan.design.variables if variable.name in ("kick", "shot")] == ["shot"]
    assert texts_of(folder) == before


@pytest.mark.parametrize(
    ("symbol", "new", "message"),
    [
        (SPEED, "", "enter a name"),
        (SPEED, "so fast", "such as soFast"),
        (SPEED, "turn", "there is already a parameter turn"),
        (SPEED, "go_straight", "'go_straight' is already the name of"),
        (SPEED, "state_time", "is reserved by the runtime"),
        (SPEED, "class", "class"),
        (SymbolRef(component="Body", section="parameters", name="gone"), "x", "parameter gone no longer exists"),
        (SymbolRef(section="constants", name="pan_threshold"), "speed", "'speed' is already the name of"),
        (SymbolRef(section="elements", owner="Side", name="left"), "right", "already an element right"),
    ],
)
def test_an_invalid_name_is_an_error(workspace: Workspace, symbol: SymbolRef, new: str, message: str) -> None:
    assert message in plan_symbol_rename(workspace, symbol, new).error


def test_a_name_used_in_code_is_an_error(workspace: Workspace) -> None:
    document = workspace.open_document("Player")
    assert document is not None
    note = Code(texts=(("python", "self.memory = 1"),))
    document.edit("note", lambda design: replace(design, common=replace(design.common, actions=(RunCode(code=note),))))
    plan = plan_symbol_rename(workspace, SymbolRef(component="Player", section="variables", name="kick"), "memory")
    assert plan.error == "the code of Player already uses self.memory for something else"


def test_a_rename_requires_saved_designs(workspace: Workspace, folder: Path) -> None:
    document = workspace.open_document("FollowBall")
    assert document is not None
    document.edit("move", lambda design: remove_states(design, ["Align"]))
    assert (
        plan_symbol_rename(workspace, SPEED, "ahead").error == "FollowBall has unsaved changes: save or undo them first"
    )


def test_users_of_changed_designs_are_notified(workspace: Workspace, folder: Path) -> None:
    document = workspace.open_document("FollowBall")
    assert document is not None
    notices: list[str] = []
    document.shared.changes.subscribe(lambda _by: notices.append(document.shared.notice.text))
    user = workspace.users.get_or_create_user("ada", "Ada")
    assert apply_symbol_rename(workspace, plan_symbol_rename(workspace, SPEED, "ahead"), user.id) == ""
    assert notices[-1] == "Ada renamed parameter forward to ahead in 2 files"
    assert document.is_saved
    assert document.design.states[0].modulates[1].arguments[0][0] == "ahead"


def labels_of(document: DocumentSession) -> list[str]:
    return [step.label for step in document.history.path[1:]]


def two_sessions(workspace: Workspace) -> tuple[DocumentSession, DocumentSession]:
    """Ada's sessions on the design that declares the symbol, and on one that refers to it."""
    user = workspace.users.get_or_create_user("ada", "Ada")
    body, follow = workspace.open_document("Body"), workspace.open_document("FollowBall")
    assert body is not None
    assert follow is not None
    return DocumentSession(body.shared, user.id), DocumentSession(follow.shared, user.id)


def test_the_histories_of_all_designs_contain_a_rename_and_undo_it(workspace: Workspace, folder: Path) -> None:
    body, follow = two_sessions(workspace)
    before = follow.design
    follow.edit("say", lambda design: replace(design, doc="Follows."))
    workspace.save(follow)
    texts = texts_of(folder)
    assert apply_symbol_rename(workspace, plan_symbol_rename(workspace, SPEED, "ahead"), "ada") == ""
    after = texts_of(folder)
    assert labels_of(body) == ["rename forward to ahead"]
    assert [step.user_id for step in body.history.path[1:]] == ["ada"]
    # Undo of either design is undo of both; so is redo.
    assert follow.undo() == ""
    assert texts_of(folder) == texts
    assert labels_of(body) == ["rename forward to ahead", "undo rename forward to ahead"]
    assert (body.undo_label, body.redo_label) == ("", "rename forward to ahead")
    assert body.redo() == ""
    assert texts_of(folder) == after
    assert body.undo() == ""
    # Earlier edits can still be undone.
    assert follow.undo() == ""
    assert follow.design == before


def test_jumping_in_the_history_undoes_a_rename_in_all_files(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)
    body, follow = two_sessions(workspace)
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


def test_a_failed_write_restores_the_other_files(
    workspace: Workspace, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = texts_of(folder)
    plan = plan_symbol_rename(workspace, SPEED, "ahead")
    assert [change.file.name for change in plan.changes] == ["body.yaml", "follow_ball.yaml"]
    write = files.replace_text

    def refusing(file: Path, old: str | None, new: str) -> None:
        if file.name == "follow_ball.yaml":
            raise OSError("the disk is full")
        write(file, old, new)

    monkeypatch.setattr(files, "replace_text", refusing)
    with pytest.raises(OSError, match="full"):
        apply_symbol_rename(workspace, plan)
    assert texts_of(folder) == before


def test_an_outdated_plan_is_rejected(workspace: Workspace, folder: Path) -> None:
    plan = plan_symbol_rename(workspace, SPEED, "ahead")
    file = folder / "follow_ball.yaml"
    file.write_text(file.read_text().replace("The ball is ahead.", "The ball is there."))
    assert (
        apply_symbol_rename(workspace, plan)
        == "another program has just changed follow_ball.yaml: check it and try again"
    )
    assert "ahead:" not in file.read_text()


def test_a_hand_written_class_is_noted(workspace: Workspace) -> None:
    plan = plan_symbol_rename(workspace, SymbolRef(component="Head", section="outputs", name="pan"), "yaw")
    assert "in the hand-written class field.head:Head" in plan.note
    assert "project.yaml" in [change.file.name for change in plan.changes]


def test_windows_on_unaffected_designs_are_notified(workspace: Workspace) -> None:
    turn = workspace.open_document("Turn")
    assert turn is not None
    notices: list[str] = []
    turn.shared.changes.subscribe(lambda by: notices.append(by.user_id))
    symbol = SymbolRef(section="constants", name="net_x")
    assert apply_symbol_rename(workspace, plan_symbol_rename(workspace, symbol, "goal_x"), "someone") == ""
    assert "someone" in notices
    assert "goal_x" in [constant.name for constant in workspace.project.constants]
