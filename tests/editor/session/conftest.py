"""An open design without a file, and the `forward` project opened in the editor."""

from pathlib import Path
from typing import Any

import pytest

from vicode.editor.session import DocumentSession, Library, SharedDocument, Workspace
from vicode.model.design import Design


def open_design(design: Design, **options: Any) -> DocumentSession:
    """Open a design that has no file and is not checked."""
    return DocumentSession(
        SharedDocument(file=Path("player.yaml"), disk_text="", saved=design, check=lambda _design: (), **options)
    )


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
