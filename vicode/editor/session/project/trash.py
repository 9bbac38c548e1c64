"""Moves design files to the system trash, restores them, and duplicates designs."""

from dataclasses import replace

from vicode.editor.session.workspace import TrashedDesign, Workspace
from vicode.model.edits import unique_name
from vicode.model.names import is_valid_name, snake_case
from vicode.services import messages
from vicode.store import is_file_taken, replace_text, save_design


def validate_move_to_trash(workspace: Workspace, component: str) -> str:
    """An error message if a design cannot be moved to the trash, else an empty string."""
    if workspace.project.design(component) is None:
        return messages.no_design(component)
    return messages.unsaved_changes([component]) if component in workspace.unsaved_components else ""


def find_dependents(workspace: Workspace, component: str) -> tuple[str, ...]:
    """The components whose designs use a component."""
    designs = workspace.project.designs
    return tuple(design.component for design in designs if any(use.component == component for use in design.uses))


def move_to_trash(workspace: Workspace, component: str) -> TrashedDesign:
    """Move the file of a design to the trash.

    Raises:
        OSError: There is no trash for the file, or the file cannot be moved.
    """
    from send2trash import send2trash  # type: ignore[import-untyped]  # noqa: PLC0415 - slow to import, rarely used

    file = workspace.files[component]
    trashed = TrashedDesign(component=component, file=file, content=file.read_bytes())
    send2trash(file.resolve())
    workspace.trashed_designs[component] = trashed
    workspace.drop_document(component)
    workspace.sync_from_disk()
    return trashed


def restore_from_trash(workspace: Workspace, trashed: TrashedDesign) -> str:
    """Restore a design; returns an error message or an empty string.

    Raises:
        OSError: The file cannot be written.
    """
    if trashed.file.exists():
        return f"{trashed.file.name} already exists: {trashed.component} stays in the trash"
    replace_text(trashed.file, None, trashed.content.decode("utf-8"))
    workspace.trashed_designs.pop(trashed.component, None)
    workspace.sync_from_disk()
    return ""


def copy_name(workspace: Workspace, component: str) -> str:
    return unique_name(component, set(workspace.project.interfaces()))


def validate_component_name(workspace: Workspace, name: str) -> str:
    """An error message if a new design cannot have this name, else an empty string."""
    if not is_valid_name(name):
        return messages.invalid_component_name(name)
    if workspace.project.interface(name) is not None:
        return messages.name_exists("component", name)
    file = workspace.folder / f"{snake_case(name)}.yaml"
    return messages.file_exists(file.name) if is_file_taken(file) else ""


def duplicate_design(workspace: Workspace, component: str, name: str) -> None:
    """Copy the current design under another name to a separate file.

    Raises:
        OSError: The file cannot be written, or already exists.
    """
    design = workspace.project.design(component)
    assert design is not None, "only an existing design can be copied"
    text = workspace.files[component].read_bytes().decode("utf-8")
    workspace.create(name, save_design(replace(design, component=name), text))
