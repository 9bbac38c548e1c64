"""An open design without a file, and the `forward` project opened in the editor."""

from pathlib import Path
from typing import Any

import pytest

from vicode.decoding import MalformedEventError, decode_event
from vicode.editor.session import DocumentSession, EditResult, Library, SharedDocument, Workspace, apply_edit
from vicode.editor.session.gestures.canvas_gestures import EDIT_GESTURES
from vicode.editor.session.gestures.table_edits import TABLE_EDITS
from vicode.model.design import Design


def open_design(design: Design, **options: Any) -> DocumentSession:
    """Open a design that has no file and is not checked."""
    return DocumentSession(
        SharedDocument(file=Path("player.yaml"), disk_text="", saved=design, check=lambda _design: (), **options)
    )


def apply_gesture(document: DocumentSession, payload: dict[str, Any]) -> EditResult:
    """Decode a gesture of the canvas and apply it."""
    return _apply_event(document, payload, EDIT_GESTURES)


def apply_table_edit(document: DocumentSession, payload: dict[str, Any]) -> EditResult:
    """Decode an edit of the table and apply it."""
    return _apply_event(document, payload, TABLE_EDITS)


def _apply_event(document: DocumentSession, payload: dict[str, Any], types: Any) -> EditResult:
    try:
        edit = decode_event(payload, {event.kind: event for event in types})
    except MalformedEventError as error:
        return EditResult(error=str(error))
    return apply_edit(document, edit)


@pytest.fixture
def document(request: pytest.FixtureRequest) -> DocumentSession:
    """The open `DESIGN` of the test module."""
    return open_design(request.module.DESIGN)


@pytest.fixture
def folder(project: Path) -> Path:
    """A writable copy of the project folder."""
    return project / "forward"


@pytest.fixture
def workspace(project: Path) -> Workspace:
    return Library(project).workspaces[0]


def texts_of(folder: Path) -> dict[str, str]:
    """The texts of the YAML files in a folder by name."""
    return {file.name: file.read_text() for file in sorted(folder.glob("*.yaml"))}
