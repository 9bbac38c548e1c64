"""Finds the encoding of XABSL files that are not UTF-8, a key of project.yaml."""

from pathlib import Path

_PROJECT_FILES = ("project.yaml", "project.yml")


def find_encoding(path: Path, encoding: str = "") -> str:
    """The encoding of XABSL files that are not UTF-8, empty for the default.

    Args:
        path: One of the files, or a folder with them.
        encoding: The specified encoding; if empty, that of the project.yaml next to the file or in a folder above it.

    Raises:
        OSError: A project.yaml cannot be read.
    """
    return encoding or project_encoding(path)


def project_encoding(path: Path) -> str:
    """The `xabsl_encoding` of the project.yaml in the folder of a file or in one above it; empty if there is none."""
    start = path.resolve()
    folders = (start, *start.parents) if start.is_dir() else start.parents
    file = next((file for folder in folders for name in _PROJECT_FILES if (file := folder / name).is_file()), None)
    if file is None:
        return ""
    # Deferred: the store is slow to import.
    from vicode.store import read_project_file

    project = read_project_file(file.read_bytes(), file.as_posix()).project
    return project.xabsl_encoding if project else ""
