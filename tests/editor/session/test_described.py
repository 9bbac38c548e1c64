"""What the documentation is about while a project is edited."""

import shutil
from dataclasses import replace
from pathlib import Path

from vicode.docsite import build_site
from vicode.editor.session import Workspace
from vicode.editor.session.described import snapshot_of, subject_at
from vicode.store import save_design

ROOT = Path(__file__).parents[3]


def open_forward(folder: Path) -> Workspace:
    shutil.copytree(ROOT / "designs/forward", folder / "forward")
    return Workspace(folder=folder / "forward", key="forward")


def rename_doc(workspace: Workspace, doc: str) -> None:
    document = workspace.document("Turn")
    assert document is not None
    document.edit("doc", lambda design: replace(design, doc=doc))


def test_the_site_of_unsaved_work_is_that_of_the_saved(tmp_path: Path) -> None:
    workspace = open_forward(tmp_path)
    rename_doc(workspace, "Turns around.")
    unsaved = snapshot_of(workspace)
    drafted = build_site(subject_at(unsaved))
    document = workspace.document("Turn")
    assert document is not None
    workspace.save(document)
    workspace.follow_disk()
    saved = snapshot_of(workspace)
    assert saved != unsaved
    assert not saved.drafts
    assert build_site(subject_at(saved)) == drafted
    assert any("Turns around." in file.text for file in drafted)


def test_findings_are_those_of_the_draft(tmp_path: Path) -> None:
    workspace = open_forward(tmp_path)
    assert not subject_at(snapshot_of(workspace)).findings
    document = workspace.document("Turn")
    assert document is not None
    document.edit("initial", lambda design: replace(design, initial="Nowhere"))
    subject = subject_at(snapshot_of(workspace))
    assert {each.component for each in subject.findings} == {"Turn"}
    assert "Turn" in subject.faulty["python"]


def test_a_broken_file_spoils_only_itself(tmp_path: Path) -> None:
    workspace = open_forward(tmp_path)
    (tmp_path / "forward/turn.yaml").write_text("vicode: 1\ncomponent: [")
    subject = subject_at(snapshot_of(workspace))
    assert subject.project.design("Turn") is None
    # Body uses it; nothing else is concerned.
    assert subject.faulty["python"] == {"(broken)", "Body"}


def test_a_draft_that_no_file_can_hold_is_described_all_the_same(tmp_path: Path) -> None:
    workspace = open_forward(tmp_path)
    document = workspace.document("Player")
    assert document is not None
    document.edit("twice", lambda design: replace(design, states=(*design.states, design.states[0])))
    snapshot = snapshot_of(workspace)
    try:
        save_design(document.design, document.sheet.disk_text)
    except ValueError:
        subject = subject_at(snapshot)
        assert subject.project.design("Player") == document.design
    else:
        raise AssertionError("a file can hold it")


def test_a_finding_of_the_file_is_told_once_beside_a_draft(tmp_path: Path) -> None:
    workspace = open_forward(tmp_path)
    file = tmp_path / "forward/turn.yaml"
    file.write_text(f"{file.read_text().rstrip()}\nstrange: 1\n")
    workspace.follow_disk()
    rename_doc(workspace, "Turns\n\naround.\n")
    snapshot = snapshot_of(workspace)
    assert "Turn" in snapshot.drafts
    assert [each.component for each in subject_at(snapshot).findings] == ["Turn"]
