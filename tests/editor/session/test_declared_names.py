"""Another name for what is declared: an edit of one design, or files that change together."""

from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from tests.editor.session.conftest import texts_of
from vicode.check import check_project
from vicode.editor.session import Document, Workspace, declared_names
from vicode.editor.session.declared_names import plan_name, rename_in_files
from vicode.model.design import Code, RunCode
from vicode.model.edits import remove_states
from vicode.model.renaming import Declared, has_declared, names_beside
from vicode.store import open_project

SPEED = Declared(component="Body", section="parameters", name="forward")


def things_of(workspace: Workspace) -> list[Declared]:
    project = workspace.project
    kinds = [Declared(section=section, name="") for section in ("constants", "enumerations", "components", "agents")]
    kinds += [Declared(section="elements", owner=each.name, name="") for each in project.enumerations]
    for name in project.interfaces():
        sections = ("uses", "parameters", "outputs", "variables")
        kinds += [Declared(component=name, section=section, name="") for section in sections]
    return [
        Declared(section=kind.section, name=name, component=kind.component, owner=kind.owner)
        for kind in kinds
        for name in names_beside(project, kind)
    ]


def some_of(workspace: Workspace) -> list[Declared]:
    """One thing of every kind, and of every kind one that a person declared for a class written by hand."""
    project = workspace.project
    found = {(each.section, project.design(each.component) is None): each for each in things_of(workspace)}
    return list(found.values())


def test_every_kind_of_name_can_be_another_and_come_back(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)
    codes = Counter(each.rule.code for each in check_project(workspace.project))
    things = some_of(workspace)
    assert {"uses", "parameters", "outputs", "variables", "constants", "elements"} <= {each.section for each in things}
    for thing in things:
        plan = plan_name(workspace, thing, "something_new")
        assert plan.refused == "", thing
        if plan.design is not None:
            continue
        assert rename_in_files(workspace, plan) == ""
        renamed = open_project(folder)
        there = Declared(section=thing.section, name=plan.new, component=thing.component, owner=thing.owner)
        if thing.section != "components":
            assert has_declared(renamed.project, there), thing
        assert Counter(each.rule.code for each in (*renamed.findings, *check_project(renamed.project))) == codes
        back = plan_name(workspace, there, thing.name)
        assert rename_in_files(workspace, back) == ""
        assert texts_of(folder) == before, thing


def test_a_name_that_only_one_design_says_is_an_edit_of_it(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)
    plan = plan_name(workspace, Declared(component="Player", section="variables", name="kick"), "shot")
    assert plan.design is not None
    assert plan.changes == ()
    assert [each.name for each in plan.design.variables if each.name in ("kick", "shot")] == ["shot"]
    assert texts_of(folder) == before


@pytest.mark.parametrize(
    ("thing", "new", "words"),
    [
        (SPEED, "", "it needs a name"),
        (SPEED, "so fast", "such as soFast"),
        (SPEED, "turn", "there is already a parameter turn"),
        (SPEED, "go_straight", "'go_straight' is already the name of"),
        (SPEED, "state_time", "a name of the runtime"),
        (SPEED, "class", "class"),
        (Declared(component="Body", section="parameters", name="gone"), "x", "no parameter gone any more"),
        (Declared(section="constants", name="pan_threshold"), "speed", "'speed' is already the name of"),
        (Declared(section="elements", owner="Side", name="left"), "right", "already an element right"),
    ],
)
def test_what_cannot_be_a_name_is_told(workspace: Workspace, thing: Declared, new: str, words: str) -> None:
    assert words in plan_name(workspace, thing, new).refused


def test_what_code_says_already_is_no_new_name(workspace: Workspace) -> None:
    document = workspace.document("Player")
    assert document is not None
    note = Code(texts=(("python", "self.memory = 1"),))
    document.edit("note", lambda design: replace(design, common=replace(design.common, actions=(RunCode(code=note),))))
    plan = plan_name(workspace, Declared(component="Player", section="variables", name="kick"), "memory")
    assert plan.refused == "the code of Player says self.memory already, and means something else"


def test_nothing_is_written_while_something_of_it_is_unsaved(workspace: Workspace, folder: Path) -> None:
    document = workspace.document("FollowBall")
    assert document is not None
    document.edit("move", lambda design: remove_states(design, ["Align"]))
    assert plan_name(workspace, SPEED, "ahead").refused == "FollowBall has unsaved changes: save or undo them first"


def test_who_works_on_a_touched_design_hears_of_it(workspace: Workspace, folder: Path) -> None:
    document = workspace.document("FollowBall")
    assert document is not None
    heard: list[str] = []
    document.watch(lambda _by: heard.append(document.sheet.news.text))
    person = workspace.people.greet("ada", "Ada")
    assert rename_in_files(workspace, plan_name(workspace, SPEED, "ahead"), person.id) == ""
    assert heard[-1] == "Ada renamed parameter forward to ahead in 2 files"
    assert document.is_saved
    assert document.design.states[0].modulates[1].arguments[0][0] == "ahead"


def labels_of(document: Document) -> list[str]:
    return [step.label for step in document.history.path[1:]]


def two_hands(workspace: Workspace) -> tuple[Document, Document]:
    """Ada's hold on the design that declares the name, and on one that says it."""
    person = workspace.people.greet("ada", "Ada")
    body, follow = workspace.document("Body"), workspace.document("FollowBall")
    assert body is not None
    assert follow is not None
    return Document(body.sheet, person.id), Document(follow.sheet, person.id)


def test_the_histories_of_all_designs_tell_of_the_name_and_take_it_back(workspace: Workspace, folder: Path) -> None:
    body, follow = two_hands(workspace)
    before = follow.design
    follow.edit("say", lambda design: replace(design, doc="Follows."))
    workspace.save(follow)
    said = texts_of(folder)
    assert rename_in_files(workspace, plan_name(workspace, SPEED, "ahead"), "ada") == ""
    after = texts_of(folder)
    assert labels_of(body) == ["rename forward to ahead"]
    assert [step.person for step in body.history.path[1:]] == ["ada"]
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
    assert rename_in_files(workspace, plan_name(workspace, SPEED, "ahead"), "ada") == ""
    after = texts_of(folder)
    named = body.history.at
    body.edit("say", lambda design: replace(design, doc="Legs."))
    assert body.jump(0) == ""
    assert texts_of(folder) == before
    assert body.is_saved
    assert follow.is_saved
    assert body.jump(named) == ""
    assert texts_of(folder) == after
    # What another design has not saved stands in the way, and everything stays.
    follow.edit("say", lambda design: replace(design, doc="Follows."))
    assert body.jump(0) == "FollowBall has unsaved changes: save or undo them first"
    assert body.history.at == named
    assert "FollowBall has unsaved changes" in body.undo()
    assert texts_of(folder) == after


def test_a_file_that_cannot_be_written_leaves_the_others_as_they_were(
    workspace: Workspace, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = texts_of(folder)
    plan = plan_name(workspace, SPEED, "ahead")
    assert [change.file.name for change in plan.changes] == ["body.yaml", "follow_ball.yaml"]
    write = declared_names.write_text

    def refusing(file: Path, text: str) -> None:
        if file.name == "follow_ball.yaml":
            raise OSError("the disk is full")
        write(file, text)

    monkeypatch.setattr(declared_names, "write_text", refusing)
    with pytest.raises(OSError, match="full"):
        rename_in_files(workspace, plan)
    assert texts_of(folder) == before


def test_a_plan_for_other_files_is_not_carried_out(workspace: Workspace, folder: Path) -> None:
    plan = plan_name(workspace, SPEED, "ahead")
    file = folder / "follow_ball.yaml"
    file.write_text(file.read_text().replace("The ball is ahead.", "The ball is there."))
    assert rename_in_files(workspace, plan) == "follow_ball.yaml was just changed by another program: look again"
    assert "ahead:" not in file.read_text()


def test_a_class_written_by_hand_is_pointed_out(workspace: Workspace) -> None:
    plan = plan_name(workspace, Declared(component="Head", section="outputs", name="pan"), "yaw")
    assert "that class is written by hand" in plan.note
    assert "project.yaml" in [change.file.name for change in plan.changes]


def test_whoever_is_at_a_design_that_does_not_say_the_name_hears_of_a_new_one_too(workspace: Workspace) -> None:
    turn = workspace.document("Turn")
    assert turn is not None
    heard: list[str] = []
    turn.sheet.watchers.append(lambda by: heard.append(by.person))
    thing = Declared(section="constants", name="net_x")
    assert rename_in_files(workspace, plan_name(workspace, thing, "goal_x"), "someone") == ""
    assert "someone" in heard
    assert "goal_x" in [each.name for each in workspace.project.constants]
