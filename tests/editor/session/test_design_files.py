"""Design files: rename, duplicate, trash, restore, templates and the overview."""

from pathlib import Path

import pytest

from tests.editor.session.conftest import texts_of
from vicode.check import check_project
from vicode.editor.session import Library, Workspace, templates
from vicode.editor.session.project import renames, trash
from vicode.editor.session.project.overview import ProjectOverview
from vicode.findings import Severity
from vicode.services.rename import component as rename_component
from vicode.store import open_project


def assert_sound(folder: Path) -> None:
    opened = open_project(folder)
    findings = [*opened.findings, *check_project(opened.project)]
    assert [finding for finding in findings if finding.severity is Severity.ERROR] == []


def test_renaming_a_component_changes_only_its_references(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)
    plan = rename_component.plan_component_rename(workspace, "Player", "Striker")
    assert texts_of(folder) == before
    assert [change.file.name for change in plan.changes] == ["striker.yaml", "project.yaml"]
    assert renames.apply_component_rename(workspace, plan) == ""
    after = texts_of(folder)
    assert after["striker.yaml"] == before["player.yaml"].replace("component: Player", "component: Striker")
    assert after["project.yaml"] == before["project.yaml"].replace("root: Player", "root: Striker")
    assert workspace.project.design("Striker") is not None
    assert workspace.project.design("Player") is None
    assert workspace.removed_components == {"Player": "Striker"}
    assert_sound(folder)


def test_renaming_back_restores_the_files(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)
    assert workspace.open_document("Player") is not None
    for old, new in (("FaceBall", "LookAtBall"), ("LookAtBall", "FaceBall")):
        plan = rename_component.plan_component_rename(workspace, old, new)
        assert {change.file.name for change in plan.changes} >= {"player.yaml", "follow_ball.yaml"}
        assert renames.apply_component_rename(workspace, plan) == ""
        assert_sound(folder)
    assert texts_of(folder) == before
    player = workspace.open_document("Player")
    assert player is not None
    assert player.is_saved
    assert {use.component for use in player.design.uses} >= {"FaceBall"}


def test_a_rename_that_fails_leaves_all_files_as_they_were(
    workspace: Workspace, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = texts_of(folder)
    plan = rename_component.plan_component_rename(workspace, "Player", "Striker")
    removed = folder / "player.yaml"
    unlink = Path.unlink

    def refuse(path: Path, *, missing_ok: bool = False) -> None:
        if path == removed:
            raise OSError("read-only")
        unlink(path, missing_ok=missing_ok)

    monkeypatch.setattr(Path, "unlink", refuse)
    with pytest.raises(OSError, match="read-only"):
        renames.apply_component_rename(workspace, plan)
    assert texts_of(folder) == before
    assert workspace.project.design("Player") is not None
    assert workspace.project.design("Striker") is None


def test_an_interrupted_rename_leaves_a_project_without_errors(workspace: Workspace, folder: Path) -> None:
    plan = rename_component.plan_component_rename(workspace, "FaceBall", "LookAtBall")
    for change in plan.changes:
        change.file.write_text(change.new)
        assert_sound(folder)
        assert (folder / "face_ball.yaml").exists()


@pytest.mark.parametrize(
    ("new", "message"),
    [
        ("Turn", "already a component Turn"),
        ("Perception", "already a component Perception"),
        ("1st", "letters, digits"),
        ("../x", "letters, digits"),
        ("FaceBall", "the name is unchanged"),
        ("Taken", "already a file taken.yaml"),
        ("Upper", "already a file upper.yaml"),
        ("Project", "already a file project.yaml"),
    ],
)
def test_an_invalid_component_name_is_an_error(workspace: Workspace, folder: Path, new: str, message: str) -> None:
    (folder / "taken.yaml").write_text("nothing: of ours\n")
    (folder / "UPPER.yaml").write_text("nothing: of ours\n")
    before = texts_of(folder)
    plan = rename_component.plan_component_rename(workspace, "FaceBall", new)
    assert message in plan.error
    assert plan.changes == ()
    assert texts_of(folder) == before


def test_renaming_requires_saved_and_unchanged_files(workspace: Workspace, folder: Path) -> None:
    player = workspace.open_document("Player")
    assert player is not None
    player.edit("doc", lambda design: design.__class__(component="Player", doc="mine"))
    player.undo()
    plan = rename_component.plan_component_rename(workspace, "FaceBall", "LookAtBall")
    assert plan.error == ""
    file = folder / "follow_ball.yaml"
    file.write_text(file.read_text() + "# theirs\n")
    assert "another program has just changed" in renames.apply_component_rename(workspace, plan)
    assert (folder / "face_ball.yaml").exists()
    player.edit("add", lambda design: design.__class__(component="Player", uses=design.uses, states=design.states))
    assert (
        "Player has unsaved changes"
        in rename_component.plan_component_rename(workspace, "FaceBall", "LookAtBall").error
    )


def test_a_copy_keeps_comments(workspace: Workspace, folder: Path) -> None:
    name = trash.copy_name(workspace, "Player")
    trash.duplicate_design(workspace, "Player", name)
    assert name == "Player2"
    text = (folder / "player2.yaml").read_text()
    assert text == (folder / "player.yaml").read_text().replace("component: Player", "component: Player2")
    assert_sound(folder)


def test_a_trashed_design_can_be_restored(
    workspace: Workspace, folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The location of the trash on Linux; on other systems the content of the trash is not checked.
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    before = (folder / "turn.yaml").read_bytes()
    assert trash.find_dependents(workspace, "Turn") == ("Body",)
    trashed = trash.move_to_trash(workspace, "Turn")
    assert not (folder / "turn.yaml").exists()
    assert workspace.project.design("Turn") is None
    assert workspace.removed_components == {"Turn": ""}
    assert trash.restore_from_trash(workspace, trashed) == ""
    assert (folder / "turn.yaml").read_bytes() == before
    assert workspace.project.design("Turn") is not None
    assert workspace.removed_components == {}
    assert "turn.yaml already exists" in trash.restore_from_trash(workspace, trashed)


def test_an_unsaved_design_cannot_be_trashed(workspace: Workspace) -> None:
    turn = workspace.open_document("Turn")
    assert turn is not None
    turn.edit("doc", lambda design: design.__class__(component="Turn"))
    assert "unsaved changes" in trash.validate_move_to_trash(workspace, "Turn")


@pytest.mark.parametrize("template", templates.list_templates(), ids=lambda template: template.name)
def test_every_template_has_no_errors(workspace: Workspace, folder: Path, template: templates.Template) -> None:
    text = templates.instantiate_template(template, "Fresh", workspace.project)
    workspace.create("Fresh", text)
    assert (folder / "fresh.yaml").read_text() == text
    assert_sound(folder)
    assert workspace.project.design("Fresh") is not None


def test_a_new_design_without_a_template_has_no_description(workspace: Workspace) -> None:
    text = templates.instantiate_template(templates.list_templates()[0], "Fresh", workspace.project)
    assert text == "vicode: 1\ncomponent: Fresh\ninitial: Start\nstates:\n  Start: {at: [160, 120]}\n"


def test_a_template_uses_the_sensor_of_the_project(workspace: Workspace) -> None:
    template = next(item for item in templates.list_templates() if item.name == "follow_what_is_seen")
    text = templates.instantiate_template(template, "Fresh", workspace.project)
    assert "perception.ball_seen" in text
    assert "sense" not in text


def test_the_overview_counts_findings_and_lists_broken_files(folder: Path) -> None:
    (folder / "wobbly.yaml").write_text("vicode: 1\ncomponent: Wobbly\nstates: {A: {transitions: [{to: B}]}}\n")
    (folder / "broken.yaml").write_text("vicode: 1\ncomponent: Broken\nstates: [\n")
    workspace = Library(folder).workspaces[0]
    overview = ProjectOverview(workspace)
    cards = {card.component: card for card in overview.cards()}
    assert cards["Wobbly"].counts[Severity.ERROR] >= 1
    assert cards["Player"].counts == {}
    assert cards["Player"].is_root
    (broken,) = overview.broken_files()
    assert (broken.file, broken.line) == ("broken.yaml", 3)
    kicker = next(item for item in overview.hand_written_components() if item.component == "Kicker")
    assert kicker.used_by == ("Player",)
    document = workspace.open_document("Wobbly")
    assert document is not None
    document.edit("states", lambda design: design.__class__(component="Wobbly"))
    assert {card.component for card in overview.cards() if card.is_unsaved} == {"Wobbly"}


def test_a_new_design_gets_no_file_that_another_file_system_would_merge_with_one(workspace: Workspace) -> None:
    (workspace.folder / "UPPER.yaml").write_text("nothing: of ours\n")
    for name in ("Upper", "Project"):
        assert "there is already a file" in trash.validate_component_name(workspace, name)
        assert not workspace.can_create(name)
        with pytest.raises(FileExistsError):
            workspace.create(name)
