"""Edits of project.yaml: writing, errors, undo."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.editor.session.conftest import texts_of
from vicode.editor.session import Workspace
from vicode.editor.session.project import project_edits
from vicode.editor.session.project.project_edits import ProjectEditResult, edit_project_file
from vicode.editor.session.project.project_paths import ProjectNodePath
from vicode.editor.session.project.renames import RenameEdit, apply_symbol_rename
from vicode.model.project import Project
from vicode.model.references import ReferenceLocation, find_references
from vicode.model.rename import SymbolRef, sibling_names
from vicode.services.rename.symbol import plan_symbol_rename
from vicode.store import open_project


def node(*path: str | int) -> ProjectNodePath:
    return ProjectNodePath(steps=tuple(zip(path[::2], path[1::2], strict=True)))  # type: ignore[arg-type]


KICK, NET_X = node("enumerations", 1), node("constants", 9)
PERCEPTION, AGENT = node("components", 0), node("agents", 0)


def taken_back(written: ProjectEditResult) -> str:
    assert written.edit is not None
    return written.edit.undo("")


def test_an_edit_of_the_project_is_written_and_undone(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)

    def change(project: Project) -> Project:
        return replace(
            project, enumerations=tuple(replace(enumeration, internal=True) for enumeration in project.enumerations)
        )

    written = edit_project_file(workspace, change)
    assert written.error == ""
    assert [enumeration.internal for enumeration in workspace.project.enumerations] == [True, True]
    assert "# Lengths in mm" in (folder / "project.yaml").read_text()
    assert taken_back(written) == ""
    assert texts_of(folder) == before
    nothing = edit_project_file(workspace, lambda project: project)
    assert (nothing.edit, nothing.error) == (None, "")

    # What others wrote elsewhere stays; the same lines are theirs.
    again = edit_project_file(workspace, change)
    now = (folder / "project.yaml").read_text()
    (folder / "project.yaml").write_text(now + "# mine\n")
    assert taken_back(again) == ""
    assert (folder / "project.yaml").read_text() == before["project.yaml"] + "# mine\n"
    (folder / "project.yaml").write_text(now.replace("internal: true", "internal: false"))
    assert taken_back(again) == "Undo or redo failed: these lines of project.yaml have changed in the meantime"
    (folder / "project.yaml").write_text("vicode: [")
    assert edit_project_file(workspace, change).error.startswith("project.yaml cannot be read: a value is missing")
    (folder / "project.yaml").write_text("# later\n")
    empty = "project.yaml cannot be read: the file is empty; start with 'vicode: 1'"
    assert edit_project_file(workspace, change).error == empty
    latin_1 = 'vicode: 1\ndoc: "für"\n'.encode("latin-1")
    (folder / "project.yaml").write_bytes(latin_1)
    assert edit_project_file(workspace, change).error.endswith("is not UTF-8; save the file as UTF-8")
    assert taken_back(again).startswith("Undo or redo failed: ")
    assert (folder / "project.yaml").read_bytes() == latin_1
    (folder / "project.yaml").unlink()
    # Without a file one is made; to take that back removes it.
    made = edit_project_file(workspace, change)
    assert "internal: true" in (folder / "project.yaml").read_text()
    assert taken_back(made) == ""
    assert not (folder / "project.yaml").exists()


def test_each_part_of_the_project_can_be_added_changed_and_removed(workspace: Workspace, folder: Path) -> None:
    before = workspace.project
    for add in (
        project_edits.add_enumeration,
        project_edits.add_constant,
        project_edits.add_component,
        lambda project: project_edits.add_agent(project, "Turn"),
        lambda project: KICK.update(project, project_edits.add_element),
        *(
            lambda project, section=section: PERCEPTION.update(
                project, lambda part: project_edits.add_declaration(part, section)
            )
            for section in ("parameters", "outputs", "variables")
        ),
    ):
        assert edit_project_file(workspace, add).error == ""
        assert open_project(folder).findings == ()
    project = workspace.project
    assert project.enumerations[-1].element_names == ("first",)
    assert project.agents[-1].root == "Turn"
    for spot in (
        node("enumerations", len(before.enumerations)),
        node("constants", len(before.constants)),
        node("components", len(before.components)),
        node("agents", 1),
        node("enumerations", 1, "elements", 3),
        node("components", 0, "parameters", 0),
        node("components", 0, "outputs", len(before.components[0].outputs)),
        node("components", 0, "variables", 0),
    ):
        assert find_references(workspace.project, spot.symbol_ref(workspace.project)) == ()
        assert edit_project_file(workspace, spot.remove, spot).error == ""
    assert workspace.project == before
    assert "# Lengths in mm" in (folder / "project.yaml").read_text()


@pytest.mark.parametrize(
    ("spot", "changes", "words"),
    [
        (NET_X, {"initial": "1 +"}, "invalid syntax"),
        (NET_X, {"type": "length"}, "length"),
        (NET_X, {"range": (10.0, 0.0)}, "the range from 10 to 0 is empty"),
        (AGENT, {"root": "Nobody"}, "Nobody"),
        (PERCEPTION, {"implementation": "here and there"}, "here and there"),
        (KICK, {"elements": ()}, "Kick"),
        (ProjectNodePath(steps=()), {"languages": ("cobol",)}, "cobol"),
        (ProjectNodePath(steps=()), {"name": "json"}, "would hide a module of Python's standard library"),
    ],
)
def test_edits_that_add_errors_are_rejected(
    workspace: Workspace, folder: Path, spot: ProjectNodePath, changes: dict[str, object], words: str
) -> None:
    before = texts_of(folder)
    written = edit_project_file(workspace, lambda project: spot.update(project, lambda old: replace(old, **changes)))
    assert words in written.error
    assert texts_of(folder) == before


def test_references_are_listed_before_removal_and_broken_designs_after(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)
    assert find_references(workspace.project, NET_X.symbol_ref(workspace.project)) == (
        ReferenceLocation(component="Player", description="transition 1 of state CircleBall, when"),
        ReferenceLocation(component="Player", description="enter action 1 of state CircleBall, set, side"),
    )
    written = edit_project_file(workspace, NET_X.remove, NET_X)
    assert written.broken_designs == ("Player",)
    assert taken_back(written) == ""
    assert texts_of(folder) == before
    kick = find_references(workspace.project, KICK.symbol_ref(workspace.project))
    assert ReferenceLocation(description="type of parameter kick of Kicker") in kick
    assert {each.component for each in kick} == {"", "Player"}
    removed = edit_project_file(workspace, KICK.remove, KICK, allow_errors=True)
    assert removed.broken_designs == ("project.yaml", "Player")
    assert "unknown type 'Kick'" in [each.message for each in workspace.project_findings]
    assert taken_back(removed) == ""
    assert workspace.project_findings == ()


def test_references_are_the_places_that_a_rename_changes(workspace: Workspace) -> None:
    project = workspace.project
    spots = [
        node(section, at) for section in ("constants", "components") for at in range(len(getattr(project, section)))
    ]
    spots += [node("components", 0, "outputs", at) for at in range(len(project.components[0].outputs))]
    spots += [
        node("components", 0, "outputs", len(project.components[0].outputs) - 1, "arguments", at) for at in (0, 1)
    ]
    for spot in spots:
        thing = spot.symbol_ref(project)
        assert thing.name == spot.name(project)
        assert thing.name in sibling_names(project, thing)
        texts = "".join(repr(design) for design in project.designs) + repr(project.agents)
        texts += " ".join(each.assume for each in project.components)
        assert bool(find_references(project, thing)) <= (thing.name in texts)
    assert SymbolRef(component="Perception", section="outputs", name="ball_seen") in [
        spot.symbol_ref(project) for spot in spots
    ]


def test_an_edit_fails_if_another_program_renamed_the_node(workspace: Workspace, folder: Path) -> None:
    file = folder / "project.yaml"
    file.write_text(file.read_text().replace("net_x:", "goal_x:"))
    written = edit_project_file(workspace, NET_X.remove, NET_X)
    assert written.error == "another program has just changed project.yaml: check it and try again"
    assert "goal_x:" in file.read_text()


def test_an_edit_of_the_project_is_an_entry_of_the_open_design(workspace: Workspace, folder: Path) -> None:
    player = workspace.open_document("Player")
    assert player is not None
    before = texts_of(folder)["project.yaml"]

    def text() -> str:
        return texts_of(folder)["project.yaml"]

    player.edit("say", lambda design: replace(design, doc="Plays."))
    written = edit_project_file(workspace, project_edits.add_constant, summary="one more constant")
    assert written.edit is not None
    player.record_compound(written.edit)
    player.edit("say more", lambda design: replace(design, doc="Plays well."))
    changed = text()
    assert changed != before
    assert [step.label for step in player.history.path] == [
        "open",
        "say",
        "project.yaml: one more constant",
        "say more",
    ]
    assert not player.is_saved

    for doc, wanted in (("Plays.", changed), ("Plays.", before)):
        assert player.undo() == ""
        assert (player.design.doc, text()) == (doc, wanted)
    assert player.undo() == ""
    assert player.design.doc != "Plays."
    for doc, wanted in (("Plays.", before), ("Plays.", changed), ("Plays well.", changed)):
        assert player.redo() == ""
        assert (player.design.doc, text()) == (doc, wanted)
    assert player.redo_label == ""

    # Going anywhere in the history brings the file along, or says why not, and goes there all the same.
    last = player.history.current_id
    assert player.jump_to(0) == ""
    assert text() == before
    assert player.jump_to(last) == ""
    assert (player.design.doc, text()) == ("Plays well.", changed)
    (folder / "project.yaml").write_text(changed.replace("constant: 0", "constant: 1"))
    told = player.jump_to(0)
    assert told.startswith(
        "“project.yaml: one more constant” was kept. Undo or redo failed: these lines of project.yaml"
    )
    assert player.design.doc not in ("Plays.", "Plays well.")
    assert "constant: 1" in text()


def test_a_new_edit_clears_the_redo_stack(workspace: Workspace, folder: Path) -> None:
    player = workspace.open_document("Player")
    assert player is not None
    before = texts_of(folder)
    player.edit("say", lambda design: replace(design, doc="Plays."))
    written = edit_project_file(workspace, project_edits.add_constant, summary="one more constant")
    assert written.edit is not None
    player.record_compound(written.edit)
    assert player.undo() == ""
    assert player.redo_label == "project.yaml: one more constant"
    assert player.undo() == ""
    player.edit("say otherwise", lambda design: replace(design, doc="Otherwise."))
    assert player.redo_label == ""
    assert texts_of(folder) == before


def test_renaming_an_unused_symbol_is_an_entry(workspace: Workspace, folder: Path) -> None:
    player = workspace.open_document("Player")
    assert player is not None
    assert edit_project_file(workspace, project_edits.add_constant).edit is not None
    before = texts_of(folder)
    thing = SymbolRef(section="constants", name="constant")
    plan = plan_symbol_rename(workspace, thing, "half_length")
    assert plan.is_declaration_only
    assert apply_symbol_rename(workspace, plan) == ""
    player.record_compound(RenameEdit(workspace=workspace, symbol=thing, new="half_length"))
    after = texts_of(folder)
    assert player.undo_label == "rename constant to half_length"
    assert player.undo() == ""
    assert texts_of(folder) == before
    assert player.redo() == ""
    assert texts_of(folder) == after


def test_an_element_moves_up(workspace: Workspace) -> None:
    def elements() -> tuple[str, ...]:
        found = workspace.project.enumeration("Kick")
        return found.element_names if found else ()

    kick = next(at for at, enumeration in enumerate(workspace.project.enumerations) if enumeration.name == "Kick")
    spots = [node("enumerations", kick, "elements", at) for at in range(3)]
    assert elements() == ("front", "diagonal", "lateral")
    assert edit_project_file(workspace, spots[2].move_up, spots[2]).error == ""
    assert elements() == ("front", "lateral", "diagonal")
    # The first one stays.
    assert edit_project_file(workspace, spots[0].move_up, spots[0]).edit is None


def test_a_removed_element_takes_its_xabsl_name(workspace: Workspace) -> None:
    (kick,) = (each for each in workspace.project.enumerations if each.name == "Kick")
    named = replace(kick, xabsl_elements=(("front", "ahead"), ("lateral", "aside")))
    project = Project(name="One", enumerations=(named,))
    (left,) = node("enumerations", 0, "elements", 0).remove(project).enumerations
    assert left.element_names == ("diagonal", "lateral")
    assert left.xabsl_elements == (("lateral", "aside"),)
