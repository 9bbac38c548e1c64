"""The forward player's project in a folder of its own, opened as the editor opens it."""

import shutil
from pathlib import Path

import pytest

from vicode.editor.session import Library, Workspace

DESIGNS = Path(__file__).parents[3] / "designs"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The project's folder, free to be changed."""
    shutil.copytree(DESIGNS / "forward", tmp_path / "forward", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path / "forward"


@pytest.fixture
def workspace(folder: Path) -> Workspace:
    """What the editor holds of it."""
    return Library(folder.parent).workspaces[0]


def texts_of(folder: Path) -> dict[str, str]:
    """What its YAML files say."""
    return {file.name: file.read_text() for file in sorted(folder.glob("*.yaml"))}
