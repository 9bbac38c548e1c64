"""Unsaved work outlives its server: journals of the dead are offered, those of the living are not."""

import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from vicode.editor.session import Library, Workspace
from vicode.editor.session.autosave import AutosaveService, format_diff
from vicode.editor.session.recovery import RecoveryStore, state_folder
from vicode.model.design import Declaration


@pytest.fixture
def keeper(project: Path, tmp_path: Path) -> Iterator[AutosaveService]:
    keeper = AutosaveService(Library(project), RecoveryStore(tmp_path / "state"))
    yield keeper
    keeper.recovery.close()


def edit(keeper: AutosaveService, doc: str) -> Workspace:
    (workspace,) = keeper.library.workspaces
    document = workspace.open_document("Player")
    assert document is not None
    document.edit("doc", lambda design: replace(design, doc=doc))
    return workspace


def journal(keeper: AutosaveService) -> int:
    """Bring the journals up to date; returns how many were touched."""
    due = keeper.pending_snapshots()
    for snapshot in due:
        keeper.recovery.write(snapshot)
    return len(due)


def killed(keeper: AutosaveService, project: Path, tmp_path: Path) -> AutosaveService:
    """The server that is started after this one was killed."""
    keeper.recovery._lock.close()
    return AutosaveService(Library(project), RecoveryStore(tmp_path / "state"))


def test_unsaved_work_is_offered_after_a_kill_and_comes_back_as_one_step(
    keeper: AutosaveService, project: Path, tmp_path: Path
) -> None:
    assert journal(keeper) == 0
    edit(keeper, "first")
    edit(keeper, "mine")
    assert (journal(keeper), journal(keeper)) == (1, 0)
    beside = AutosaveService(Library(project), RecoveryStore(tmp_path / "state"))
    assert beside.recoverable(keeper.library.workspaces[0]) == ()
    beside.recovery.close()

    again = killed(keeper, project, tmp_path)
    (workspace,) = again.library.workspaces
    (lost,) = again.recoverable(workspace)
    assert lost.component == "Player"
    assert "+  mine" in format_diff(lost)
    assert again.recover(workspace, lost, "ana") == 0
    document = workspace.open_document("Player")
    assert document is not None
    assert (document.design.doc, document.is_saved, document.history.current.user_id) == ("mine", False, "ana")
    assert again.recoverable(workspace) == ()
    again.recovery.close()


def test_what_was_saved_or_discarded_is_not_offered(keeper: AutosaveService, project: Path, tmp_path: Path) -> None:
    workspace = edit(keeper, "mine")
    journal(keeper)
    document = workspace.open_document("Player")
    assert document is not None
    workspace.save(document)
    assert journal(keeper) == 1
    edit(keeper, "again")
    journal(keeper)
    again = killed(keeper, project, tmp_path)
    (lost,) = again.recoverable(again.library.workspaces[0])
    again.recovery.discard(lost)
    assert again.recoverable(again.library.workspaces[0]) == ()
    again.recovery.close()
    assert list((tmp_path / "state" / "unsaved").iterdir()) == []


def test_recovered_work_meets_what_the_file_says_now(keeper: AutosaveService, project: Path, tmp_path: Path) -> None:
    edit(keeper, "mine")
    journal(keeper)
    file = project / "forward" / "player.yaml"
    file.write_text(file.read_text().replace("frequency: 10", "frequency: 20"))
    again = killed(keeper, project, tmp_path)
    (workspace,) = again.library.workspaces
    (lost,) = again.recoverable(workspace)
    again.recover(workspace, lost, "ana")
    document = workspace.open_document("Player")
    assert document is not None
    assert (document.design.doc, document.design.frequency_hz) == ("mine", 20)
    again.recovery.close()


def test_what_no_file_can_hold_keeps_the_journal_before_it(
    keeper: AutosaveService, project: Path, tmp_path: Path
) -> None:
    workspace = edit(keeper, "mine")
    journal(keeper)
    document = workspace.open_document("Player")
    assert document is not None
    twice = (Declaration(name="a"), Declaration(name="a"))
    document.edit("twice", lambda design: replace(design, variables=twice))
    assert journal(keeper) == 1
    again = killed(keeper, project, tmp_path)
    (lost,) = again.recoverable(again.library.workspaces[0])
    assert "mine" in lost.text
    again.recovery.close()


def test_work_on_a_file_that_cannot_be_read_waits_until_it_can(
    keeper: AutosaveService, project: Path, tmp_path: Path
) -> None:
    edit(keeper, "mine")
    journal(keeper)
    file = project / "forward" / "player.yaml"
    text = file.read_text()
    file.write_text(f"<<<<<<< HEAD\n{text}")
    again = killed(keeper, project, tmp_path)
    (workspace,) = again.library.workspaces
    assert again.recoverable(workspace) == ()
    file.write_text(text)
    workspace.sync_from_disk()
    (lost,) = again.recoverable(workspace)
    assert "mine" in lost.text
    again.recovery.close()


def test_work_on_a_file_that_is_gone_makes_it_again(keeper: AutosaveService, project: Path, tmp_path: Path) -> None:
    edit(keeper, "mine")
    journal(keeper)
    file = project / "forward" / "player.yaml"
    file.unlink()
    again = killed(keeper, project, tmp_path)
    (workspace,) = again.library.workspaces
    (lost,) = again.recoverable(workspace)
    assert again.recover(workspace, lost, "ana") == 0
    assert "mine" in file.read_text()
    assert again.recoverable(workspace) == ()
    again.recovery.close()


def test_ending_in_order_keeps_the_last_moment(keeper: AutosaveService, project: Path, tmp_path: Path) -> None:
    edit(keeper, "mine")
    keeper.close()
    again = AutosaveService(Library(project), RecoveryStore(tmp_path / "state"))
    (workspace,) = again.library.workspaces
    (lost,) = again.recoverable(workspace)
    assert "mine" in lost.text
    again.recovery.discard(lost)
    again.set_autosave(edit(again, "saved"), is_on=True)
    again.close()
    assert "saved" in (project / "forward" / "player.yaml").read_text()
    assert list((tmp_path / "state" / "unsaved").iterdir()) == []


def test_a_journal_that_could_not_be_written_is_tried_again(
    keeper: AutosaveService, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(_descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    edit(keeper, "mine")
    with monkeypatch.context() as full:
        full.setattr(os, "fsync", refuse)
        with pytest.raises(OSError, match="No space"):
            journal(keeper)
    assert (journal(keeper), journal(keeper)) == (1, 0)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"project": 1}', "\x00"])
def test_a_file_that_is_no_journal_is_passed_over(
    keeper: AutosaveService, project: Path, tmp_path: Path, text: str
) -> None:
    folder = tmp_path / "state" / "unsaved" / "dead"
    folder.mkdir()
    (folder / "x.json").write_text(text)
    assert keeper.recoverable(keeper.library.workspaces[0]) == ()


def test_projects_that_save_by_themselves_wait_for_a_rest(keeper: AutosaveService, project: Path) -> None:
    workspace = edit(keeper, "mine")
    document = workspace.open_document("Player")
    assert document is not None
    now = document.history.current.at_s
    keeper.clock = lambda: now + 5
    keeper.save_idle_documents()
    assert not document.is_saved
    workspace.autosave = True
    keeper.clock = lambda: now + 0.5
    keeper.save_idle_documents()
    assert not document.is_saved
    keeper.clock = lambda: now + 5
    keeper.save_idle_documents()
    assert document.is_saved
    assert "mine" in document.file.read_text()


def test_saving_by_itself_goes_on_after_a_restart(keeper: AutosaveService, project: Path, tmp_path: Path) -> None:
    (workspace,) = keeper.library.workspaces
    keeper.set_autosave(workspace, is_on=True)
    again = killed(keeper, project, tmp_path)
    (workspace,) = again.library.workspaces
    assert workspace.autosave
    again.set_autosave(workspace, is_on=False)
    last = killed(again, project, tmp_path)
    assert not last.library.workspaces[0].autosave
    last.close()


def test_what_cannot_be_saved_by_itself_is_told_once(keeper: AutosaveService, project: Path) -> None:
    workspace = edit(keeper, "mine")
    document = workspace.open_document("Player")
    assert document is not None
    keeper.set_autosave(workspace, is_on=True)
    told: list[str] = []
    document.subscribe(lambda by: told.append(by.shared.notice.text))
    document.file.chmod(0o444)
    keeper.clock = lambda: document.history.current.at_s + 5
    keeper.save_idle_documents()
    keeper.save_idle_documents()
    assert told == ["player.yaml cannot be saved: the file is read-only"]
    document.file.chmod(0o644)
    keeper.save_idle_documents()
    assert document.is_saved


def test_the_state_folder_can_be_chosen(tmp_path: Path) -> None:
    assert state_folder({"VICODE_STATE": str(tmp_path)}) == tmp_path
    assert state_folder({"XDG_STATE_HOME": str(tmp_path)}) == tmp_path / "vicode"
    assert state_folder({}) == Path.home() / ".local" / "state" / "vicode"
