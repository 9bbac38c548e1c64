"""What project.yaml declares, changed from the editor: written at once, refused in words, taken back."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.editor.session.conftest import texts_of
from vicode.editor.session import Workspace, project_edits
from vicode.editor.session.declared_names import NewName, plan_name, rename_in_files
from vicode.editor.session.mentions import Mention, mentions_of
from vicode.editor.session.project_edits import Written, change_project_file
from vicode.editor.session.project_spots import Spot, outline_of_project
from vicode.model.project import Project
from vicode.model.renaming import Declared, names_beside
from vicode.store import open_project

KICK, NET_X = Spot.of("enumerations", 1), Spot.of("constants", 9)
PERCEPTION, AGENT = Spot.of("components", 0), Spot.of("agents", 0)


def taken_back(written: Written) -> str:
    assert written.edit is not None
    return written.edit.take_back("")


def test_a_change_of_the_project_is_written_and_taken_back(workspace: Workspace, folder: Path) -> None:
    before = texts_of(folder)

    def change(project: Project) -> Project:
        return replace(project, enumerations=tuple(replace(each, internal=True) for each in project.enumerations))

    written = change_project_file(workspace, change)
    assert written.refused == ""
    assert [each.internal for each in workspace.project.enumerations] == [True, True]
    assert "# Lengths in mm" in (folder / "project.yaml").read_text()
    assert taken_back(written) == ""
    assert texts_of(folder) == before
    nothing = change_project_file(workspace, lambda project: project)
    assert (nothing.edit, nothing.refused) == (None, "")

    # What others wrote elsewhere stays; the same lines are theirs.
    again = change_project_file(workspace, change)
    now = (folder / "project.yaml").read_text()
    (folder / "project.yaml").write_text(now + "# mine\n")
    assert taken_back(again) == ""
    assert (folder / "project.yaml").read_text() == before["project.yaml"] + "# mine\n"
    (folder / "project.yaml").write_text(now.replace("internal: true", "internal: false"))
    assert taken_back(again) == "Not done: project.yaml was changed since, in the same lines"
    (folder / "project.yaml").write_text("vicode: [")
    assert change_project_file(workspace, change).refused.startswith("project.yaml cannot be read: a value is missing")
    (folder / "project.yaml").write_text("# later\n")
    empty = "project.yaml cannot be read: the file is empty; begin with 'vicode: 1'"
    assert change_project_file(workspace, change).refused == empty
    latin_1 = 'vicode: 1\ndoc: "für"\n'.encode("latin-1")
    (folder / "project.yaml").write_bytes(latin_1)
    assert change_project_file(workspace, change).refused.endswith("is not UTF-8; save the file as UTF-8")
    assert taken_back(again).startswith("Not done: ")
    assert (folder / "project.yaml").read_bytes() == latin_1
    (folder / "project.yaml").unlink()
    # Without a file one is made; to take that back removes it.
    made = change_project_file(workspace, change)
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
        lambda project: KICK.write(project, project_edits.add_element),
        *(
            lambda project, section=section: PERCEPTION.write(
                project, lambda part: project_edits.add_declaration(part, section)
            )
            for section in ("parameters", "outputs", "variables")
        ),
    ):
        shape = outline_of_project(workspace.project)
        assert change_project_file(workspace, add).refused == ""
        assert outline_of_project(workspace.project) != shape
        assert open_project(folder).findings == ()
    project = workspace.project
    assert project.enumerations[-1].element_names == ("first",)
    assert project.agents[-1].root == "Turn"
    for spot in (
        Spot.of("enumerations", len(before.enumerations)),
        Spot.of("constants", len(before.constants)),
        Spot.of("components", len(before.components)),
        Spot.of("agents", 1),
        KICK.inner("elements", 3),
        PERCEPTION.inner("parameters", 0),
        PERCEPTION.inner("outputs", len(before.components[0].outputs)),
        PERCEPTION.inner("variables", 0),
    ):
        assert mentions_of(workspace.project, spot.declared(workspace.project)) == ()
        assert change_project_file(workspace, spot.without, spot).refused == ""
    assert workspace.project == before
    assert "# Lengths in mm" in (folder / "project.yaml").read_text()


@pytest.mark.parametrize(
    ("spot", "changes", "words"),
    [
        (NET_X, {"initial": "1 +"}, "invalid syntax"),
        (NET_X, {"type": "length"}, "length"),
        (NET_X, {"range": (10.0, 0.0)}, "no value lies from 10 to 0"),
        (AGENT, {"root": "Nobody"}, "Nobody"),
        (PERCEPTION, {"implementation": "here and there"}, "here and there"),
        (KICK, {"elements": ()}, "Kick"),
        (Spot(steps=()), {"languages": ("cobol",)}, "cobol"),
        (Spot(steps=()), {"name": "json"}, "would hide a module of Python's library"),
    ],
)
def test_what_makes_no_sound_project_is_refused(
    workspace: Workspace, folder: Path, spot: Spot, changes: dict[str, object], words: str
) -> None:
    before = texts_of(folder)
    written = change_project_file(workspace, lambda project: spot.write(project, lambda old: replace(old, **changes)))
    assert words in written.refused
    assert texts_of(folder) == before


def test_what_is_used_is_told_before_it_is_removed_and_who_has_errors_afterwards(
    workspace: Workspace, folder: Path
) -> None:
    before = texts_of(folder)
    assert mentions_of(workspace.project, NET_X.declared(workspace.project)) == (
        Mention(component="Player", words="transition 1 of state CircleBall, when"),
        Mention(component="Player", words="enter 1 of state CircleBall, set, side"),
    )
    written = change_project_file(workspace, NET_X.without, NET_X)
    assert written.broken == ("Player",)
    assert taken_back(written) == ""
    assert texts_of(folder) == before
    kick = mentions_of(workspace.project, KICK.declared(workspace.project))
    assert Mention(words="type of parameter kick of Kicker") in kick
    assert {each.component for each in kick} == {"", "Player"}
    removed = change_project_file(workspace, KICK.without, KICK, is_agreed=True)
    assert removed.broken == ("project.yaml", "Player")
    assert "there is no type 'Kick'" in [each.message for each in workspace.project_findings]
    assert taken_back(removed) == ""
    assert workspace.project_findings == ()


def test_every_thing_is_found_where_another_name_for_it_would_be_said(workspace: Workspace) -> None:
    project = workspace.project
    spots = [
        Spot.of(section, at) for section in ("constants", "components") for at in range(len(getattr(project, section)))
    ]
    spots += [PERCEPTION.inner("outputs", at) for at in range(len(project.components[0].outputs))]
    spots += [
        PERCEPTION.inner("outputs", len(project.components[0].outputs) - 1).inner("arguments", at) for at in (0, 1)
    ]
    for spot in spots:
        thing = spot.declared(project)
        assert thing.name == spot.name(project)
        assert thing.name in names_beside(project, thing)
        texts = "".join(repr(design) for design in project.designs) + repr(project.agents)
        assert bool(mentions_of(project, thing)) <= (thing.name in texts)
    assert Declared(component="Perception", section="outputs", name="ball_seen") in [
        spot.declared(project) for spot in spots
    ]


def test_a_file_that_another_program_changed_is_looked_at_first(workspace: Workspace, folder: Path) -> None:
    file = folder / "project.yaml"
    file.write_text(file.read_text().replace("net_x:", "goal_x:"))
    written = change_project_file(workspace, NET_X.without, NET_X)
    assert written.refused == "project.yaml was just changed by another program: look again"
    assert "goal_x:" in file.read_text()


def test_a_change_of_the_project_is_a_step_of_the_design_beside_which_it_was_made(
    workspace: Workspace, folder: Path
) -> None:
    player = workspace.document("Player")
    assert player is not None
    before = texts_of(folder)["project.yaml"]

    def text() -> str:
        return texts_of(folder)["project.yaml"]

    player.edit("say", lambda design: replace(design, doc="Plays."))
    written = change_project_file(workspace, project_edits.add_constant, what="one more constant")
    assert written.edit is not None
    player.note(written.edit)
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
    last = player.history.at
    assert player.jump(0) == ""
    assert text() == before
    assert player.jump(last) == ""
    assert (player.design.doc, text()) == ("Plays well.", changed)
    (folder / "project.yaml").write_text(changed.replace("constant: 0", "constant: 1"))
    told = player.jump(0)
    assert told.startswith("project.yaml: one more constant stays as it is. Not done: project.yaml was changed since")
    assert player.design.doc not in ("Plays.", "Plays well.")
    assert "constant: 1" in text()


def test_who_does_something_new_has_nothing_to_do_again(workspace: Workspace, folder: Path) -> None:
    player = workspace.document("Player")
    assert player is not None
    before = texts_of(folder)
    player.edit("say", lambda design: replace(design, doc="Plays."))
    written = change_project_file(workspace, project_edits.add_constant, what="one more constant")
    assert written.edit is not None
    player.note(written.edit)
    assert player.undo() == ""
    assert player.redo_label == "project.yaml: one more constant"
    assert player.undo() == ""
    player.edit("say otherwise", lambda design: replace(design, doc="Otherwise."))
    assert player.redo_label == ""
    assert texts_of(folder) == before


def test_a_name_that_only_the_project_says_is_a_step_too(workspace: Workspace, folder: Path) -> None:
    player = workspace.document("Player")
    assert player is not None
    assert change_project_file(workspace, project_edits.add_constant).edit is not None
    before = texts_of(folder)
    thing = Declared(section="constants", name="constant")
    plan = plan_name(workspace, thing, "half_length")
    assert plan.is_alone
    assert rename_in_files(workspace, plan) == ""
    player.note(NewName(workspace=workspace, thing=thing, new="half_length"))
    after = texts_of(folder)
    assert player.undo_label == "rename constant to half_length"
    assert player.undo() == ""
    assert texts_of(folder) == before
    assert player.redo() == ""
    assert texts_of(folder) == after


def test_an_element_goes_before_the_one_before_it(workspace: Workspace) -> None:
    def elements() -> tuple[str, ...]:
        found = workspace.project.enumeration("Kick")
        return found.element_names if found else ()

    kick = next(at for at, each in enumerate(workspace.project.enumerations) if each.name == "Kick")
    spots = [Spot.of("enumerations", kick).inner("elements", at) for at in range(3)]
    assert elements() == ("front", "diagonal", "lateral")
    assert change_project_file(workspace, spots[2].earlier, spots[2]).refused == ""
    assert elements() == ("front", "lateral", "diagonal")
    # The first one stays.
    assert change_project_file(workspace, spots[0].earlier, spots[0]).edit is None
