"""Edits of generated code by other programs become edits of open designs."""

from dataclasses import replace
from pathlib import Path

import pytest

from vicode.editor.session import DocumentSession, Workspace
from vicode.editor.session.code import code_sync
from vicode.editor.session.code.code_sync import OutdatedChoiceError
from vicode.editor.session.gestures.canvas_gestures import RenameGesture
from vicode.editor.session.gestures.edits import apply_edit
from vicode.editor.view import ItemRef
from vicode.model.design import Design, Guard, RunCode, Transition
from vicode.model.edits import replace_decision
from vicode.services.generation.design_output import choose_texts
from vicode.sync import set_code

GENERATED = "self._distances: list[float] = []"
ENTER = ("states", "WatchBall", "enter", 0, "code")


@pytest.fixture
def player(workspace: Workspace) -> DocumentSession:
    """The open player with generated code."""
    document = workspace.open_document("Player")
    assert document is not None
    assert workspace.generate(document).is_complete
    code_sync.follow_generated_files(workspace)
    return document


@pytest.fixture
def file(workspace: Workspace, player: DocumentSession) -> Path:
    """The generated file of the player."""
    return workspace.output_folder / "python" / "forward" / "player.py"


def edit_file(file: Path, new: str, old: str = GENERATED) -> None:
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))


def code_of(design: Design, state: str = "WatchBall") -> str:
    found = design.state(state)
    assert found is not None
    (code,) = (action.code for action in found.enter if isinstance(action, RunCode))
    return code.in_language("python") or ""


def edit_design(document: DocumentSession, text: str) -> None:
    document.edit("code", lambda design: set_code(design, ENTER, "python", text))


def test_an_edit_is_taken_in_as_one_step_beside_unsaved_work(
    workspace: Workspace, player: DocumentSession, file: Path
) -> None:
    player.edit("doc", lambda design: replace(design, doc="mine"))
    edit_file(file, "self._seen += 2")
    code_sync.follow_generated_files(workspace)
    assert (code_of(player.design), player.design.doc) == ("self._seen += 2", "mine")
    assert player.history.current.label == "edit of generated code: WatchBall.enter"
    outside = player.shared.outside
    assert outside.notice.text == "Applied from player.py: WatchBall.enter"
    assert outside.marked_items(player.history) == {ItemRef(kind="states", id="WatchBall")}
    assert (
        next(state for state in player.shared.scene(workspace.project)["states"] if state["outside"])["id"]
        == "WatchBall"
    )
    assert player.undo_entry(outside.notice.entry_id) == ""
    assert (code_of(player.design), player.design.doc) == (GENERATED, "mine")
    assert outside.marked_items(player.history) == frozenset()


def test_an_edit_that_was_undone_is_not_taken_in_again(
    workspace: Workspace, player: DocumentSession, file: Path
) -> None:
    edit_file(file, "self._seen += 2")
    code_sync.follow_generated_files(workspace)
    player.undo_entry(player.shared.outside.notice.entry_id)
    edit_file(file, "import logging, math", "import logging")
    code_sync.follow_generated_files(workspace)
    assert code_of(player.design) == GENERATED
    assert "math" in str(player.design.module)
    # It is missing nevertheless, which a simulation must not hide.
    assert [edit.name for edit in player.shared.outside.waiting] == ["WatchBall.enter"]
    assert code_sync.find_lacking(workspace, "Player") == (player,)
    assert not workspace.generate(player).is_complete


def test_an_edit_follows_a_renamed_state_and_later_edits_of_both_sides(
    workspace: Workspace, player: DocumentSession, file: Path
) -> None:
    apply_edit(player, RenameGesture(item=ItemRef(kind="states", id="WatchBall"), name="Shoot"))
    edit_file(file, "a = 1\nb = 2\nc = 3".replace("\n", "\n        "))
    code_sync.follow_generated_files(workspace)
    assert code_of(player.design, "Shoot") == "a = 1\nb = 2\nc = 3"
    path = ("states", "Shoot", *ENTER[2:])
    player.edit("code", lambda design: set_code(design, path, "python", "a = 1\nb = 2\nc = 4"))
    edit_file(file, "a = 9", "a = 1")
    code_sync.follow_generated_files(workspace)
    assert code_of(player.design, "Shoot") == "a = 9\nb = 2\nc = 4"


def test_invalid_python_waits_until_it_is_valid(workspace: Workspace, player: DocumentSession, file: Path) -> None:
    edit_file(file, "self._seen +=")
    edit_file(file, "import logging, math", "import logging")
    code_sync.follow_generated_files(workspace)
    assert code_of(player.design) == GENERATED
    assert "math" in str(player.design.module)
    (finding,) = player.shared.outside.findings
    assert finding in player.findings
    assert "player.py, line" in player.shared.notice.text
    line = 1 + file.read_text().split("\n").index("        self._seen +=")
    assert finding.location is not None
    assert (finding.location.file, finding.location.line) == ("generated/python/forward/player.py", line)
    edit_file(file, "self._seen += 3", "self._seen +=")
    code_sync.follow_generated_files(workspace)
    assert code_of(player.design) == "self._seen += 3"
    assert player.shared.outside.findings == ()


def test_a_conflict_waits_and_is_resolved_as_one_step(
    workspace: Workspace, player: DocumentSession, file: Path
) -> None:
    edit_design(player, "self._seen += 1")
    edit_file(file, "self._seen += 2")
    code_sync.follow_generated_files(workspace)
    assert code_of(player.design) == "self._seen += 1"
    (edit,) = player.shared.outside.conflicts
    assert [each.rule.code for each in player.shared.outside.findings] == ["G504"]
    code_sync.resolve(workspace, player, {edit: "self._seen += 3"})
    assert code_of(player.design) == "self._seen += 3"
    assert player.shared.outside.waiting == ()
    player.undo_entry(player.history.current_id)
    assert code_of(player.design) == "self._seen += 1"


def test_a_conflict_that_changed_since_is_shown_again(
    workspace: Workspace, player: DocumentSession, file: Path
) -> None:
    edit_design(player, "self._seen += 1")
    edit_file(file, "self._seen += 2")
    code_sync.follow_generated_files(workspace)
    (edit,) = player.shared.outside.conflicts
    edit_file(file, "self._seen += 4", "self._seen += 2")
    with pytest.raises(OutdatedChoiceError):
        code_sync.resolve(workspace, player, {edit: edit.region.file_text})
    assert code_of(player.design) == "self._seen += 1"


def test_what_was_decided_outlives_the_editor(workspace: Workspace, player: DocumentSession, file: Path) -> None:
    edit_file(file, "self._seen += 2")
    code_sync.follow_generated_files(workspace)
    edit_design(player, "self._seen += 5")
    workspace.save(player)
    again = Workspace(workspace.folder, key="forward")
    document = again.open_document("Player")
    assert document is not None
    code_sync.follow_generated_files(again)
    assert code_of(document.design) == "self._seen += 5"
    assert document.shared.outside.waiting == ()
    assert again.generate(document).is_complete
    assert "self._seen += 5" in file.read_text()


def test_the_text_of_the_design_is_kept_if_the_user_says_so(
    workspace: Workspace, player: DocumentSession, file: Path
) -> None:
    edit_design(player, "self._seen += 1")
    workspace.save(player)
    edit_file(file, "self._seen += 2")
    code_sync.follow_generated_files(workspace)
    (edit,) = player.shared.outside.conflicts
    code_sync.resolve(workspace, player, {edit: None})
    assert player.shared.outside.waiting == ()
    assert workspace.generate(player).is_complete
    assert "self._seen += 1" in file.read_text()


def test_edits_wait_while_the_design_has_errors(workspace: Workspace, player: DocumentSession, file: Path) -> None:
    initial = player.design.initial
    player.edit("initial", lambda design: replace(design, initial="Nowhere"))
    edit_file(file, "self._seen += 2")
    code_sync.follow_generated_files(workspace)
    assert code_of(player.design) == GENERATED
    player.edit("initial", lambda design: replace(design, initial=initial))
    code_sync.follow_generated_files(workspace)
    assert code_of(player.design) == "self._seen += 2"


def test_only_the_file_of_a_design_is_followed(workspace: Workspace) -> None:
    assert workspace.generated_paths.find(workspace, "Player") == ("python/forward/player.py",)


def test_used_designs_are_opened_for_their_edits(workspace: Workspace, player: DocumentSession) -> None:
    assert code_sync.find_lacking(workspace, "Player") == ()
    assert len(workspace.documents) == 1


def test_generate_offers_the_edits_that_the_design_can_express(
    workspace: Workspace, player: DocumentSession, file: Path
) -> None:
    edit_file(file, "self.perception.ball_age > 77:", "self.perception.ball_age > lost_after:")
    code_sync.follow_generated_files(workspace)
    assert player.shared.outside.lacks_edits
    assert code_sync.find_lacking(workspace, "Player") == (player,)
    prepared = workspace.prepare_output(player)
    (reading,) = prepared.readings
    assert len(reading.words) == 2
    assert "ball_age > 77" in reading.words[0]
    assert reading.leftover == ""
    assert code_sync.apply_to_design(player, reading.base, reading.design, reading.words)
    assert "ball_age > 77" in player.history.current.label
    workspace.save(player)
    assert workspace.generate(player).is_complete
    code_sync.follow_generated_files(workspace)
    assert not player.shared.outside.lacks_edits


def test_edits_of_cpp_are_offered_too(workspace: Workspace) -> None:
    project = workspace.folder / "project.yaml"
    project.write_text(project.read_text().replace("languages: [python]", "languages: [python, cpp]"))
    workspace.sync_from_disk()
    player = workspace.open_document("Player")
    assert player is not None
    assert workspace.generate(player).is_complete
    code_sync.follow_generated_files(workspace)
    source = workspace.output_folder / "cpp" / "forward" / "player.cpp"
    edit_file(source, "perception.ball_age > 77)", "perception.ball_age > lost_after)")
    code_sync.follow_generated_files(workspace)
    assert player.shared.outside.lacks_edits
    (reading,) = workspace.prepare_output(player).readings
    assert (len(reading.words), reading.leftover) == (2, "")
    assert "ball_age > 77" in reading.words[0]
    assert code_sync.apply_to_design(player, reading.base, reading.design, reading.words)
    workspace.save(player)
    assert workspace.generate(player).is_complete


def test_changes_of_the_design_since_are_no_edits_of_the_file(
    workspace: Workspace, player: DocumentSession, file: Path
) -> None:
    edit_file(file, "self.perception.net_bearing) < 555:", "self.perception.net_bearing) < front_limit:")
    path = ("states", "LookForBall", "transitions", 0)
    guarded = Transition(to="FollowBall", guard=Guard(when="perception.ball_distance < 1234"))
    player.edit("guard", lambda design: replace_decision(design, path, guarded))
    edit_design(player, "self._seen = 5")
    workspace.save(player)
    (reading,) = workspace.prepare_output(player).readings
    assert len(reading.words) == 1
    assert "555" in reading.words[0]
    assert reading.leftover == ""


def test_a_file_without_its_first_line_cannot_be_compared(
    workspace: Workspace, player: DocumentSession, file: Path
) -> None:
    file.write_text(file.read_text().partition("\n")[2])
    code_sync.follow_generated_files(workspace)
    assert [finding.rule.code for finding in player.shared.outside.problems] == ["G501"]
    assert code_sync.find_lacking(workspace, "Player") == (player,)
    file.write_text("")
    code_sync.follow_generated_files(workspace)
    assert code_sync.find_lacking(workspace, "Player") == ()


def test_broken_marks_are_a_finding(workspace: Workspace, player: DocumentSession, file: Path) -> None:
    edit_file(file, "x = 1\n", "# </vicode>\n")
    code_sync.follow_generated_files(workspace)
    assert {finding.rule.code for finding in player.shared.outside.findings} == {"G503"}


def test_markers_of_a_merge_are_a_problem(workspace: Workspace, player: DocumentSession, file: Path) -> None:
    before = player.design
    edit_file(
        file, "<<<<<<< HEAD\n    self.a = 1\n=======\n    self.a = 2\n>>>>>>> other\nclass Player", "class Player"
    )
    code_sync.follow_generated_files(workspace)
    (problem,) = player.shared.outside.problems
    assert problem.rule.code == "G505"
    assert code_sync.find_lacking(workspace, "Player") == (player,)
    assert player.design is before
    text = file.read_text()
    assert not workspace.generate(player).is_complete
    assert file.read_text() == text


@pytest.mark.parametrize(("side", "kept"), [("file", "77"), ("design", "88"), ("third", "99")])
def test_a_text_is_chosen_for_lines_that_both_sides_changed(
    workspace: Workspace, player: DocumentSession, file: Path, side: str, kept: str
) -> None:
    edit_file(file, "if self.perception.fallen and 1 < 77:", "if self.perception.fallen:")
    text = player.file.read_text()
    player.file.write_text(text.replace("when: perception.fallen,", "when: perception.fallen and 1 < 88,"))
    workspace.sync_from_disk()
    (reading,) = workspace.prepare_output(player).readings
    assert reading.words == ()
    (conflict,) = reading.rebased.conflicts
    third = conflict.file_text.replace("77", "99")
    chosen = {"file": conflict.file_text, "design": conflict.design_text, "third": third}[side]
    read = choose_texts(reading, {conflict: chosen})
    assert code_sync.apply_to_design(player, read.base, read.design, read.words) or side == "design"
    workspace.save(player)
    assert f"perception.fallen and 1 < {kept}" in player.file.read_text()
