"""Changes of project.yaml itself: written at once, as no design is its home; what was written can be taken back."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from vicode.editor.session.workspace import Workspace
from vicode.model.project import Project
from vicode.store import is_read_only, project_file_in, read_project_file, save_project_file, write_text


@dataclass(frozen=True, slots=True, kw_only=True)
class Written:
    """What became of project.yaml; `refused` says in words why nothing did."""

    file: Path | None = None
    old: str = ""
    new: str = ""
    refused: str = ""


def change_project_file(workspace: Workspace, change: Callable[[Project], Project]) -> Written:
    """Write another project.yaml, patching its text; comments and the order of keys stay.

    Raises:
        OSError: The file cannot be read or written.
    """
    file = project_file_in(workspace.folder)
    if file is None:
        return Written(refused="there is no project.yaml")
    if is_read_only(file):
        return Written(refused=f"{file.name} cannot be changed: read-only")
    old = file.read_bytes().decode("utf-8")
    project = read_project_file(old, str(file)).project
    if project is None:
        return Written(refused=f"{file.name} cannot be read")
    try:
        new = save_project_file(change(project), old)
    except ValueError as error:
        return Written(refused=f"no file can hold that: {error}")
    if new != old:
        write_text(file, new)
        workspace.follow_disk()
    return Written(file=file, old=old, new=new)


def take_back(workspace: Workspace, written: Written) -> str:
    """Write what stood in the file before; returns why not, if somebody else wrote it since.

    Raises:
        OSError: The file cannot be read or written.
    """
    if written.file is None or written.file.read_bytes().decode("utf-8") != written.new:
        return "project.yaml was changed since"
    write_text(written.file, written.old)
    workspace.follow_disk()
    return ""
