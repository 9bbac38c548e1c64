"""Unsaved work outlives its server: journals of the dead are offered, those of the living are not."""

import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from vicode.editor.session import Library, Workspace
from vicode.editor.session.keeper import Keeper, difference_of
from vicode.editor.session.recovery import Recovery, state_folder
from vicode.model.design import Declaration


@pytest.fixture
def keeper(project: Path, tmp_path: Path) -> Iterator[Keeper]:
    keeper = Keeper(Library(project), Recovery(tmp_path / "state"))
    yield keeper
    keeper.recovery.close()


def edit(keeper: Keeper, doc: str) -> Workspace:
    (workspace,) = keeper.library.workspaces
    document = workspace.document("Player")
    assert document is not None
    document.edit("doc", lambda design: replace(design, doc=doc))
    return workspace


def journal(keeper: Keeper) -> int:
    """Bring the journals up to date; returns how many were touched."""
    due = keeper.due()
    for snapshot in due:
        keeper.recovery.write(snapshot)
    return len(due)


def killed(keeper: Keeper, project: Path, tmp_path: Path) -> Keeper:
    """The server that is started after this one was killed."""
    keeper.recovery._lock.close()
    return Keeper(Library(project), Recovery(tmp_path / "state"))


def test_unsaved_work_is_offered_after_a_kill_and_comes_back_as_one_step(
    keeper: Keeper, project: Path, tmp_path: Path
) -> None:
    assert journal(keeper) == 0
    edit(keeper, "first")
    edit(keeper, "mine")
    assert (journal(keeper), journal(keeper)) == (1, 0)
    beside = Keeper(Library(project), Recovery(tmp_path / "state"))
    assert beside.lost(keeper.library.workspaces[0]) == ()
    beside.recovery.close()

    again = killed(keeper, project, tmp_path)
    (workspace,) = again.library.workspaces
    (lost,) = again.lost(workspace)
    assert lost.component == "Player"
    assert "+  mine" in difference_of(lost)
    assert again.recover(workspace, lost, "ana") == 0
    document = workspace.document("Player")
    assert document is not None
    assert (document.design.doc, document.is_saved, document.history.present.person) == ("mine", False, "ana")
    assert again.lost(workspace) == ()
    again.recovery.close()


def test_what_was_saved_or_discarded_is_not_offered(keeper: Keeper, project: Path, tmp_path: Path) -> None:
    workspace = edit(keeper, "mine")
    journal(keeper)
    document = workspace.document("Player")
    assert document is not None
    workspace.save(document)
    assert journal(keeper) == 1
    edit(keeper, "again")
    journal(keeper)
    again = killed(keeper, project, tmp_path)
    (lost,) = again.lost(again.library.workspaces[0])
    again.recovery.forget(lost)
    assert again.lost(again.library.workspaces[0]) == ()
    again.recovery.close()
    assert list((tmp_path / "state" / "unsaved").iterdir()) == []


def test_recovered_work_meets_what_the_file_says_now(keeper: Keeper, project: Path, tmp_path: Path) -> None:
    edit(keeper, "mine")
    journal(keeper)
    file = project / "forward" / "player.yaml"
    file.write_text(file.read_text().replace("frequency: 10", "frequency: 20"))
    again = killed(keeper, project, tmp_path)
    (workspace,) = again.library.workspaces
    (lost,) = again.lost(workspace)
    again.recover(workspace, lost, "ana")
    document = workspace.document("Player")
    assert document is not None
    assert (document.design.doc, document.design.frequency_hz) == ("mine", 20)
    again.recovery.close()


def test_what_no_file_can_hold_keeps_the_journal_before_it(keeper: Keeper, project: Path, tmp_path: Path) -> None:
    workspace = edit(keeper, "mine")
    journal(keeper)
    document = workspace.document("Player")
    assert document is not None
    twice = (Declaration(name="a"), Declaration(name="a"))
    document.edit("twice", lambda design: replace(design, variables=twice))
    assert journal(keeper) == 1
    again = killed(keeper, project, tmp_path)
    (lost,) = again.lost(again.library.workspaces[0])
    assert "mine" in lost.text
    again.recovery.close()


def test_work_on_a_file_that_cannot_be_read_waits_until_it_can(keeper: Keeper, project: Path, tmp_path: Path) -> None:
    edit(keeper, "mine")
    journal(keeper)
    file = project / "forward" / "player.yaml"
    text = file.read_text()
    file.write_text(f"<<<<<<< HEAD\n{text}")
    again = killed(keeper, project, tmp_path)
    (workspace,) = again.library.workspaces
    assert again.lost(workspace) == ()
    file.write_text(text)
    workspace.follow_disk()
    (lost,) = again.lost(workspace)
    assert "mine" in lost.text
    again.recovery.close()


def test_work_on_a_file_that_is_gone_makes_it_again(keeper: Keeper, project: Path, tmp_path: Path) -> None:
    edit(keeper, "mine")
    journal(keeper)
    file = project / "forward" / "player.yaml"
    file.unlink()
    again = killed(keeper, project, tmp_path)
    (workspace,) = again.library.workspaces
    (lost,) = again.lost(workspace)
    assert again.recover(workspace, lost, "ana") == 0
    assert "mine" in file.read_text()
    assert again.lost(workspace) == ()
    again.recovery.close()


def test_ending_in_order_keeps_the_last_moment(keeper: Keeper, project: Path, tmp_path: Path) -> None:
    edit(keeper, "mine")
    keeper.close()
    again = Keeper(Library(project), Recovery(tmp_path / "state"))
    (workspace,) = again.library.workspaces
    (lost,) = again.lost(workspace)
    assert "mine" in lost.text
    again.recovery.forget(lost)
    again.set_autosave(edit(again, "saved"), is_on=True)
    again.close()
    assert "saved" in (project / "forward" / "player.yaml").read_text()
    assert list((tmp_path / "state" / "unsaved").iterdir()) == []


def test_a_journal_that_could_not_be_written_is_tried_again(keeper: Keeper, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    edit(keeper, "mine")
    with monkeypatch.context() as full:
        full.setattr(os, "fsync", refuse)
        with pytest.raises(OSError, match="No space"):
            journal(keeper)
    assert (journal(keeper), journal(keeper)) == (1, 0)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"project": 1}', "\x00"])
def test_a_file_that_is_no_journal_is_passed_over(keeper: Keeper, project: Path, tmp_path: Path, text: str) -> None:
    folder = tmp_path / "state" / "unsaved" / "dead"
    folder.mkdir()
    (folder / "x.json").write_text(text)
    assert keeper.lost(keeper.library.workspaces[0]) == ()


def test_projects_that_save_by_themselves_wait_for_a_rest(keeper: Keeper, project: Path) -> None:
    workspace = edit(keeper, "mine")
    document = workspace.document("Player")
    assert document is not None
    now = document.history.present.at_s
    keeper.clock = lambda: now + 5
    keeper.save_rested()
    assert not document.is_saved
    workspace.autosave = True
    keeper.clock = lambda: now + 0.5
    keeper.save_rested()
    assert not document.is_saved
    keeper.clock = lambda: now + 5
    keeper.save_rested()
    assert document.is_saved
    assert "mine" in document.file.read_text()


def test_saving_by_itself_goes_on_after_a_restart(keeper: Keeper, project: Path, tmp_path: Path) -> None:
    (workspace,) = keeper.library.workspaces
    keeper.set_autosave(workspace, is_on=True)
    again = killed(keeper, project, tmp_path)
    (workspace,) = again.library.workspaces
    assert workspace.autosave
    again.set_autosave(workspace, is_on=False)
    last = killed(again, project, tmp_path)
    assert not last.library.workspaces[0].autosave
    last.close()


def test_what_cannot_be_saved_by_itself_is_told_once(keeper: Keeper, project: Path) -> None:
    workspace = edit(keeper, "mine")
    document = workspace.document("Player")
    assert document is not None
    keeper.set_autosave(workspace, is_on=True)
    told: list[str] = []
    document.watch(lambda by: told.append(by.sheet.news.text))
    document.file.chmod(0o444)
    keeper.clock = lambda: document.history.present.at_s + 5
    keeper.save_rested()
    keeper.save_rested()
    assert told == ["player.yaml cannot be saved: the file is read-only"]
    document.file.chmod(0o644)
    keeper.save_rested()
    assert document.is_saved


def test_the_state_folder_can_be_chosen(tmp_path: Path) -> None:
    assert state_folder({"VICODE_STATE": str(tmp_path)}) == tmp_path
    assert state_folder({"XDG_STATE_HOME": str(tmp_path)}) == tmp_path / "vicode"
    assert state_folder({}) == Path.home() / ".local" / "state" / "vicode"
