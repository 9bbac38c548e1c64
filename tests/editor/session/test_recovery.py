"""Journals of restarted servers are recovered, those of running servers are not."""

import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from vicode.editor.session import Library, Workspace
from vicode.editor.session.recovery.autosave import AutosaveService, format_diff
from vicode.editor.session.recovery.recovery_store import RecoveryStore
from vicode.model.design import Declaration
from vicode.platform import state_folder


@pytest.fixture
def service(project: Path, tmp_path: Path) -> Iterator[AutosaveService]:
    service = AutosaveService(Library(project), RecoveryStore(tmp_path / "state"))
    yield service
    service.recovery.close()


def edit(service: AutosaveService, doc: str) -> Workspace:
    (workspace,) = service.library.workspaces
    document = workspace.open_document("Player")
    assert document is not None
    document.edit("doc", lambda design: replace(design, doc=doc))
    return workspace


def journal(service: AutosaveService) -> int:
    """Write the pending journals; returns their number."""
    due = service.pending_snapshots()
    for snapshot in due:
        service.recovery.write(snapshot)
    return len(due)


def restarted(service: AutosaveService, project: Path, tmp_path: Path) -> AutosaveService:
    """The service of a new server after this one was killed."""
    service.recovery._lock.release()
    return AutosaveService(Library(project), RecoveryStore(tmp_path / "state"))


def test_unsaved_work_of_a_killed_server_is_recovered_as_one_edit(
    service: AutosaveService, project: Path, tmp_path: Path
) -> None:
    assert journal(service) == 0
    edit(service, "first")
    edit(service, "mine")
    assert (journal(service), journal(service)) == (1, 0)
    beside = AutosaveService(Library(project), RecoveryStore(tmp_path / "state"))
    assert beside.recoverable(service.library.workspaces[0]) == ()
    beside.recovery.close()

    again = restarted(service, project, tmp_path)
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


def test_saved_or_discarded_work_is_not_recoverable(service: AutosaveService, project: Path, tmp_path: Path) -> None:
    workspace = edit(service, "mine")
    journal(service)
    document = workspace.open_document("Player")
    assert document is not None
    workspace.save(document)
    assert journal(service) == 1
    edit(service, "again")
    journal(service)
    again = restarted(service, project, tmp_path)
    (lost,) = again.recoverable(again.library.workspaces[0])
    again.recovery.discard(lost)
    assert again.recoverable(again.library.workspaces[0]) == ()
    again.recovery.close()
    assert list((tmp_path / "state" / "unsaved").iterdir()) == []


def test_recovered_work_is_merged_with_the_file(service: AutosaveService, project: Path, tmp_path: Path) -> None:
    edit(service, "mine")
    journal(service)
    file = project / "forward" / "player.yaml"
    file.write_text(file.read_text().replace("frequency: 10", "frequency: 20"))
    again = restarted(service, project, tmp_path)
    (workspace,) = again.library.workspaces
    (lost,) = again.recoverable(workspace)
    again.recover(workspace, lost, "ana")
    document = workspace.open_document("Player")
    assert document is not None
    assert (document.design.doc, document.design.frequency_hz) == ("mine", 20)
    again.recovery.close()


def test_a_design_that_cannot_be_saved_keeps_its_last_journal(
    service: AutosaveService, project: Path, tmp_path: Path
) -> None:
    workspace = edit(service, "mine")
    journal(service)
    document = workspace.open_document("Player")
    assert document is not None
    twice = (Declaration(name="a"), Declaration(name="a"))
    document.edit("twice", lambda design: replace(design, variables=twice))
    assert journal(service) == 1
    again = restarted(service, project, tmp_path)
    (lost,) = again.recoverable(again.library.workspaces[0])
    assert "mine" in lost.text
    again.recovery.close()


def test_work_on_an_unreadable_file_waits_until_it_is_readable(
    service: AutosaveService, project: Path, tmp_path: Path
) -> None:
    edit(service, "mine")
    journal(service)
    file = project / "forward" / "player.yaml"
    text = file.read_text()
    file.write_text(f"<<<<<<< HEAD\n{text}")
    again = restarted(service, project, tmp_path)
    (workspace,) = again.library.workspaces
    assert again.recoverable(workspace) == ()
    file.write_text(text)
    workspace.sync_from_disk()
    (lost,) = again.recoverable(workspace)
    assert "mine" in lost.text
    again.recovery.close()


def test_recovery_creates_a_missing_file(service: AutosaveService, project: Path, tmp_path: Path) -> None:
    edit(service, "mine")
    journal(service)
    file = project / "forward" / "player.yaml"
    file.unlink()
    again = restarted(service, project, tmp_path)
    (workspace,) = again.library.workspaces
    (lost,) = again.recoverable(workspace)
    assert again.recover(workspace, lost, "ana") == 0
    assert "mine" in file.read_text()
    assert again.recoverable(workspace) == ()
    again.recovery.close()


def test_closing_keeps_the_latest_edits(service: AutosaveService, project: Path, tmp_path: Path) -> None:
    file = project / "forward" / "player.yaml"
    file.chmod(0o444)
    edit(service, "mine")
    service.close()
    again = AutosaveService(Library(project), RecoveryStore(tmp_path / "state"))
    (workspace,) = again.library.workspaces
    (lost,) = again.recoverable(workspace)
    assert "mine" in lost.text
    again.recovery.discard(lost)
    file.chmod(0o644)
    edit(again, "saved")
    again.close()
    assert "saved" in file.read_text()
    assert list((tmp_path / "state" / "unsaved").iterdir()) == []


def test_a_failed_journal_is_written_again(service: AutosaveService, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    edit(service, "mine")
    with monkeypatch.context() as full:
        full.setattr(os, "fsync", refuse)
        with pytest.raises(OSError, match="No space"):
            journal(service)
    assert (journal(service), journal(service)) == (1, 0)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"project": 1}', "\x00"])
def test_damaged_journals_are_ignored(service: AutosaveService, project: Path, tmp_path: Path, text: str) -> None:
    folder = tmp_path / "state" / "unsaved" / "dead"
    folder.mkdir()
    (folder / "x.json").write_text(text)
    assert service.recoverable(service.library.workspaces[0]) == ()


def test_autosave_waits_until_a_design_is_idle(service: AutosaveService, project: Path) -> None:
    workspace = edit(service, "mine")
    document = workspace.open_document("Player")
    assert document is not None
    now = document.history.current.at_s
    service.clock = lambda: now + 0.5
    service.save_idle_documents()
    assert not document.is_saved
    service.clock = lambda: now + 5
    service.save_idle_documents()
    assert document.is_saved
    assert "mine" in document.file.read_text()


def test_a_failed_autosave_is_reported_once(service: AutosaveService, project: Path) -> None:
    workspace = edit(service, "mine")
    document = workspace.open_document("Player")
    assert document is not None
    notices: list[str] = []
    document.shared.changes.subscribe(lambda by: notices.append(by.shared.notice.text))
    document.file.chmod(0o444)
    service.clock = lambda: document.history.current.at_s + 5
    service.save_idle_documents()
    service.save_idle_documents()
    assert notices == ["player.yaml cannot be saved: the file is read-only"]
    document.file.chmod(0o644)
    service.save_idle_documents()
    assert document.is_saved


def test_the_environment_selects_the_state_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("VICODE_STATE", str(tmp_path))
    assert state_folder() == tmp_path
    monkeypatch.delenv("VICODE_STATE")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    assert state_folder() == tmp_path / "vicode"
    monkeypatch.delenv("XDG_STATE_HOME")
    assert state_folder() == Path.home() / ".local" / "state" / "vicode"
