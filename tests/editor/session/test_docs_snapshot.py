"""The documentation of a project that is being edited."""

from dataclasses import replace
from pathlib import Path

from vicode.docsite import build_site
from vicode.editor.session import Workspace
from vicode.editor.session.project.docs_snapshot import load_docs_subject, take_snapshot
from vicode.store import save_design


def rename_doc(workspace: Workspace, doc: str) -> None:
    document = workspace.open_document("Turn")
    assert document is not None
    document.edit("doc", lambda design: replace(design, doc=doc))


def test_unsaved_and_saved_designs_have_the_same_site(workspace: Workspace) -> None:
    rename_doc(workspace, "Turns around.")
    unsaved = take_snapshot(workspace)
    drafted = build_site(load_docs_subject(unsaved))
    document = workspace.open_document("Turn")
    assert document is not None
    workspace.save(document)
    workspace.sync_from_disk()
    saved = take_snapshot(workspace)
    assert saved != unsaved
    assert not saved.unsaved_designs
    assert build_site(load_docs_subject(saved)) == drafted
    assert any("Turns around." in file.text for file in drafted)


def test_findings_are_those_of_the_unsaved_design(workspace: Workspace) -> None:
    assert not load_docs_subject(take_snapshot(workspace)).findings
    document = workspace.open_document("Turn")
    assert document is not None
    document.edit("initial", lambda design: replace(design, initial="Nowhere"))
    subject = load_docs_subject(take_snapshot(workspace))
    assert {finding.component for finding in subject.findings} == {"Turn"}
    assert "Turn" in subject.components_with_errors["python"]


def test_a_broken_file_affects_only_its_users(workspace: Workspace, folder: Path) -> None:
    (folder / "turn.yaml").write_text("vicode: 1\ncomponent: [")
    subject = load_docs_subject(take_snapshot(workspace))
    assert subject.project.design("Turn") is None
    # Body uses it; nothing else is concerned.
    assert subject.components_with_errors["python"] == {"(broken)", "Body"}


def test_a_design_that_cannot_be_saved_is_documented(workspace: Workspace) -> None:
    document = workspace.open_document("Player")
    assert document is not None
    document.edit("twice", lambda design: replace(design, states=(*design.states, design.states[0])))
    snapshot = take_snapshot(workspace)
    try:
        save_design(document.design, document.shared.disk_text)
    except ValueError:
        subject = load_docs_subject(snapshot)
        assert subject.project.design("Player") == document.design
    else:
        raise AssertionError("a file can hold it")


def test_parse_findings_of_an_unsaved_design_are_not_repeated(workspace: Workspace, folder: Path) -> None:
    file = folder / "turn.yaml"
    file.write_text(f"{file.read_text().rstrip()}\nstrange: 1\n")
    workspace.sync_from_disk()
    rename_doc(workspace, "Turns\n\naround.\n")
    snapshot = take_snapshot(workspace)
    assert "Turn" in snapshot.unsaved_designs
    assert [finding.component for finding in load_docs_subject(snapshot).findings] == ["Turn"]
