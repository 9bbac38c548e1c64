"""An open project: saving, changes by other programs, code generation."""

from dataclasses import replace
from pathlib import Path

import pytest

from vicode.editor.session import DISK_USER, DiskConflictError, DocumentSession, Library, Workspace, apply_edit
from vicode.editor.session.gestures.canvas_gestures import DeleteGesture, RenameGesture
from vicode.editor.view import ItemRef
from vicode.model.design import Declaration, Guard, Transition
from vicode.model.edits import replace_decision
from vicode.store import read_design, save_design


def opened(workspace: Workspace, component: str) -> DocumentSession:
    document = workspace.open_document(component)
    assert document is not None
    return document


def test_the_initial_design_is_the_root_of_an_agent_or_the_given_file(project: Path) -> None:
    library = Library(project)
    first = library.find_initial_design()
    assert first is not None
    assert (first[0].key, first[1]) == ("forward", "Player")
    by_file = Library(project / "forward" / "face_ball.yaml").find_initial_design("Player")
    assert by_file is not None
    assert by_file[1] == "FaceBall"
    preferred = library.find_initial_design("FaceBall")
    assert preferred is not None
    assert preferred[1] == "FaceBall"
    assert library.find_initial_design("Elsewhere") == first
    assert library.workspace("elsewhere") is None


def test_new_folders_become_projects(project: Path) -> None:
    now_s = 0.0
    library = Library(project, clock=lambda: now_s)
    library.find_new_projects()
    folder = project / "goalie"
    folder.mkdir()
    (folder / "keeper.yaml").write_text("")
    now_s += 10
    library.find_new_projects()
    assert [workspace.key for workspace in library.workspaces] == ["forward"]
    # The content comes later, which does not change the folder.
    (folder / "keeper.yaml").write_text("vicode: 1\ncomponent: Keeper\n")
    library.find_new_projects()
    assert [workspace.key for workspace in library.workspaces] == ["forward"]
    now_s += 10
    library.find_new_projects()
    assert [workspace.key for workspace in library.workspaces] == ["forward", "goalie"]
    assert library.workspaces[1].open_document("Keeper") is not None
    for _again in range(3):
        now_s += 10
        library.find_new_projects()
    assert len(library.workspaces) == 2


def test_an_unedited_save_writes_nothing(workspace: Workspace) -> None:
    document = opened(workspace, "Player")
    before = document.file.stat()
    workspace.save(document)
    assert document.file.stat().st_mtime_ns == before.st_mtime_ns
    assert workspace.open_document("Player") is document
    assert workspace.open_document("Perception") is None


def test_an_edit_changes_its_own_lines(workspace: Workspace) -> None:
    document = opened(workspace, "Player")
    before = document.file.read_text().splitlines()
    apply_edit(document, RenameGesture(item=ItemRef(kind="states", id="WatchBall"), name="Rest"))
    assert not document.is_saved
    workspace.save(document)
    assert document.is_saved
    after = document.file.read_text().splitlines()
    changed = [line.strip() for line in after if line not in before]
    assert changed == ["- {to: Rest, when: not kicker.busy, after: 0.5, doc: kicked}", "Rest:", "id: WatchBall"]
    assert sum(line not in after for line in before) == 2


def with_doc(document: DocumentSession, doc: str) -> None:
    document.edit("doc", lambda design: replace(design, doc=doc))


def write_doc(document: DocumentSession, doc: str) -> str:
    """Another program gives the design another doc; returns the text of the file."""
    read = read_design(document.file.read_text(), document.file.name)
    assert read.design is not None
    text = save_design(replace(read.design, doc=doc), document.file.read_text())
    document.file.write_text(text)
    return text


def test_independent_changes_on_disk_are_merged(workspace: Workspace) -> None:
    document = opened(workspace, "Player")
    with_doc(document, "mine")
    text = document.file.read_text()
    document.file.write_text(text.replace("frequency: 10", "frequency: 20  # faster"))
    workspace.sync_from_disk()
    assert (document.design.doc, document.design.frequency_hz, document.is_saved) == ("mine", 20, False)
    assert document.history.current.label == "merge from disk"
    assert document.history.current.user_id == DISK_USER
    workspace.save(document)
    assert "# faster" in document.file.read_text()
    assert "  mine\n" in document.file.read_text()
    document.undo()
    assert document.design.frequency_hz == 20


def test_conflicts_are_listed_and_resolved_one_by_one(workspace: Workspace) -> None:
    document = opened(workspace, "Player")
    with_doc(document, "mine")
    document.edit("faster", lambda design: replace(design, frequency_hz=50.0))
    text = write_doc(document, "theirs").replace("frequency: 10", "frequency: 20  # faster")
    document.file.write_text(text)
    with pytest.raises(DiskConflictError):
        workspace.save(document)
    assert document.file.read_text() == text
    assert [conflict.path for conflict in document.shared.conflicts] == [("doc",), ("frequency",)]
    workspace.resolve_conflict(document, [("doc",)])
    assert (document.design.doc, document.design.frequency_hz) == ("theirs", 50)
    assert document.shared.disk_conflict is None
    beside = next(step for step in document.history.entries.values() if step.label == "version on disk")
    assert (beside.design.doc, beside.design.frequency_hz) == ("theirs", 20)
    document.undo()
    assert (document.design.doc, document.design.frequency_hz) == ("mine", 50)


def test_conflicts_change_with_further_edits(workspace: Workspace) -> None:
    document = opened(workspace, "Player")
    with_doc(document, "mine")
    document.file.write_text(write_doc(document, "theirs").replace("frequency: 10", "frequency: 20  # faster"))
    workspace.sync_from_disk()
    assert [conflict.path for conflict in document.shared.conflicts] == [("doc",)]
    document.edit("faster", lambda design: replace(design, frequency_hz=50.0))
    assert [conflict.path for conflict in document.shared.conflicts] == [("doc",), ("frequency",)]
    with pytest.raises(DiskConflictError):
        workspace.save(document)
    document.undo()
    document.undo()
    workspace.save(document)
    assert (document.design.doc, document.design.frequency_hz) == ("theirs", 20)
    assert "frequency: 20  # faster" in document.file.read_text()
    assert document.shared.disk_conflict is None


def test_overwriting_keeps_independent_changes(workspace: Workspace) -> None:
    document = opened(workspace, "Player")
    with_doc(document, "mine")
    document.file.write_text(write_doc(document, "theirs").replace("frequency: 10", "frequency: 20  # faster"))
    workspace.save(document, overwrite=True)
    assert "frequency: 20  # faster" in document.file.read_text()
    assert "  mine\n" in document.file.read_text()


def test_an_unreadable_file_is_backed_up_before_overwriting(workspace: Workspace) -> None:
    document = opened(workspace, "Player")
    with_doc(document, "mine")
    document.file.write_text("<<<<<<< HEAD\n")
    with pytest.raises(DiskConflictError):
        workspace.save(document)
    workspace.save(document, overwrite=True)
    assert document.file.with_name("player.yaml.edited").read_text() == "<<<<<<< HEAD\n"
    assert "mine" in document.file.read_text()


def test_a_new_design_is_written_at_once_and_replaces_no_file(workspace: Workspace) -> None:
    document = workspace.create("Cheer")
    assert document.file.name == "cheer.yaml"
    assert "component: Cheer" in document.file.read_text()
    assert "Cheer" in Workspace(workspace.folder, key="again").project.interfaces()
    (workspace.folder / "wave.yaml").write_text("mine\n")
    with pytest.raises(FileExistsError):
        workspace.create("Wave")


def test_dependent_designs_are_checked_again(workspace: Workspace) -> None:
    player, search = opened(workspace, "Player"), opened(workspace, "SearchNet")
    assert player.findings == ()
    outputs = tuple(output for output in search.design.outputs if output.name != "found")
    search.edit("remove output", lambda design: replace(design, outputs=outputs))
    assert [finding.rule.code for finding in player.findings] == ["E303"]
    search.undo()
    assert player.findings == ()


def test_generate_writes_the_saved_design(workspace: Workspace) -> None:
    document = opened(workspace, "Player")
    first = workspace.generate(document)
    assert first.is_complete, first.message
    assert {"player.py", "face_ball.py", "declarations.py"} <= {path.name for path in first.files}
    assert "up to date" in workspace.generate(document).message
    path = ("states", "LookForBall", "transitions", 0)
    guarded = Transition(to="FollowBall", guard=Guard(when="perception.ball_distance < 1234"))
    document.edit("guard", lambda design: replace_decision(design, path, guarded))
    workspace.save(document)
    again = workspace.generate(document)
    assert [path.name for path in again.files] == ["player.py"]
    assert "self.perception.ball_distance < 1234" in again.files[0].read_text()


def test_generate_rejects_errors_and_hand_edits(workspace: Workspace) -> None:
    document = opened(workspace, "Player")
    (written,) = (path for path in workspace.generate(document).files if path.name == "player.py")
    document.edit("broken", lambda design: replace(design, variables=(Declaration(name="kick", type="Kik"),)))
    workspace.save(document)
    refused = workspace.generate(document)
    assert not refused.is_complete
    assert "Nothing generated" in refused.message
    document.undo()
    edited = written.read_text().replace("recent = self._distances[-5:]", "recent = self._distances[-9:]")
    written.write_text(edited)
    document.edit("doc", lambda design: replace(design, doc="new"))
    workspace.save(document)
    assert "edited" in workspace.generate(document).message
    assert written.read_text() == edited


def test_generate_writes_nothing_during_a_disk_conflict(workspace: Workspace) -> None:
    document = opened(workspace, "Player")
    files = {path: path.read_text() for path in workspace.generate(document).files}
    with_doc(document, "mine")
    write_doc(document, "theirs")
    workspace.sync_from_disk()
    assert document.shared.disk_conflict is not None
    for is_forced in (False, True):
        with pytest.raises(DiskConflictError):
            workspace.generate(document, is_forced=is_forced)
    with pytest.raises(DiskConflictError):
        workspace.prepare_output(document)
    assert {path: path.read_text() for path in files} == files


def test_forced_generation_backs_up_hand_edits(workspace: Workspace) -> None:
    document = opened(workspace, "Player")
    (written,) = (path for path in workspace.generate(document).files if path.name == "player.py")
    generated = written.read_text()
    edited = generated.replace("recent = self._distances[-5:]", "recent = self._distances[-9:]")
    written.write_text(edited)
    assert not workspace.generate(document).is_complete
    assert written.read_text() == edited
    assert workspace.generate(document, is_forced=True).is_complete
    assert written.read_text() == generated
    assert written.with_name("player.py.edited").read_text() == edited


def test_unknown_keys_are_findings_and_prevent_generation(project: Path) -> None:
    file = project / "forward" / "turn.yaml"
    file.write_text(file.read_text() + "    on_enter: wave\n")
    workspace = Workspace(project / "forward", key="forward")
    document = opened(workspace, "Turn")
    assert [finding.rule.code for finding in document.findings] == ["Y102"]
    assert "Nothing generated" in workspace.generate(document).message
    file.write_text(file.read_text().replace("    on_enter: wave\n", ""))
    workspace.sync_from_disk()
    assert document.findings == ()
    assert workspace.generate(document).is_complete


def test_added_changed_and_removed_files_are_synchronized(workspace: Workspace) -> None:
    player, turn = opened(workspace, "Player"), opened(workspace, "Turn")
    turn.edit("doc", lambda design: replace(design, doc="mine"))
    for document in (player, turn):
        text = document.file.read_text().replace("frequency: 10", "frequency: 12")
        document.file.write_text(text + "# theirs\n")
    (workspace.folder / "wave.yaml").write_text("vicode: 1\ncomponent: Wave\nstates: {Up: {}}\n")
    (workspace.folder / "search_net.yaml").unlink()
    workspace.sync_from_disk()
    assert (player.design.frequency_hz, player.is_saved) == (12, True)
    assert (turn.design.doc, turn.design.frequency_hz, turn.is_saved) == ("mine", 12, False)
    assert opened(workspace, "Wave").design.states
    assert workspace.open_document("SearchNet") is None
    assert {finding.rule.code for finding in player.findings} == {"P202"}
    (workspace.folder / "search_net.yaml").write_text("component: SearchNet\nstates: [\n")
    workspace.sync_from_disk()
    messages = [(finding.message, finding.fix) for finding in player.findings]
    assert messages == [("the design of 'SearchNet' cannot be read", "fix search_net.yaml first")]
    workspace.save(turn)
    assert turn.file.read_text().endswith("# theirs\n")


def test_a_design_with_a_missing_file_is_kept(workspace: Workspace) -> None:
    document = opened(workspace, "Turn")
    document.file.unlink()
    workspace.sync_from_disk()
    assert workspace.open_document("Turn") is document
    with pytest.raises(DiskConflictError):
        workspace.save(document)
    workspace.save(document, overwrite=True)
    assert "component: Turn" in document.file.read_text()


def test_a_missing_file_is_created_again_with_its_comments(workspace: Workspace) -> None:
    document = opened(workspace, "Turn")
    document.file.write_text(f"# by hand\n{document.file.read_text()}")
    workspace.sync_from_disk()
    with_doc(document, "mine")
    document.file.unlink()
    workspace.sync_from_disk()
    # As the dialog does it.
    workspace.resolve_conflict(document)
    workspace.save(document)
    assert document.file.read_text().startswith("# by hand\n")
    assert "mine" in document.file.read_text()
    assert document.is_saved


def test_a_binary_file_is_backed_up(workspace: Workspace) -> None:
    document = opened(workspace, "Player")
    with_doc(document, "mine")
    document.file.write_bytes(b"doc: f\xfcnf\n")
    workspace.sync_from_disk()
    workspace.resolve_conflict(document)
    assert document.file.with_name("player.yaml.edited").read_bytes() == b"doc: f\xfcnf\n"
    assert "mine" in document.file.read_text()


def test_generate_uses_the_saved_versions_of_other_designs(workspace: Workspace) -> None:
    player, face_ball = opened(workspace, "Player"), opened(workspace, "FaceBall")
    face_ball.edit("doc", lambda design: replace(design, doc="not yet"))
    for path in workspace.generate(player).files:
        assert "not yet" not in path.read_text()


def test_an_edit_that_would_lose_unknown_keys_is_refused(folder: Path) -> None:
    file = folder / "player.yaml"
    file.write_text(file.read_text() + "  Spare:\n    transitons: [{to: Kick}]\n")
    document = opened(Library(folder).workspaces[0], "Player")
    before = document.design
    document.edit("delete", lambda design: replace(design, states=design.states[:-1]))
    assert document.design == before
    assert "'transitons: [{to: Kick}]', was not understood" in document.shared.notice.text
    # The canvas, which shows the edit already, is told.
    result = apply_edit(document, DeleteGesture(items=(ItemRef(kind="states", id="Spare"),)))
    assert "was not understood" in result.error
    document.edit("doc", lambda design: replace(design, doc="changed"))
    assert document.design.doc == "changed"
