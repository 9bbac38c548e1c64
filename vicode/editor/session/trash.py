"""Takes design files away into the system's trash, and makes new ones from old; nothing is lost either way."""

from dataclasses import replace

from vicode.editor.session.workspace import TrashedDesign, Workspace
from vicode.model.edits import unique_name
from vicode.model.names import is_valid_name, name_from_text, snake_case
from vicode.store import save_design, write_text


def validate_move_to_trash(workspace: Workspace, component: str) -> str:
    """Why a design cannot be taken away, in words; empty if it can."""
    if workspace.project.design(component) is None:
        return f"there is no design of {component} any more"
    if component in workspace.unsaved_components:
        return f"{component} has unsaved changes: save or undo them first, so that what is in the trash is whole"
    return ""


def find_dependents(workspace: Workspace, component: str) -> tuple[str, ...]:
    """The components whose designs use this one."""
    designs = workspace.project.designs
    return tuple(each.component for each in designs if any(use.component == component for use in each.uses))


def move_to_trash(workspace: Workspace, component: str) -> TrashedDesign:
    """Move the file of a design to the trash.

    Raises:
        OSError: There is no trash for that file, or it cannot be moved; it stays where it is.
    """
    from send2trash import send2trash  # type: ignore[import-untyped]  # noqa: PLC0415 - slow, and wanted rarely

    file = workspace.files[component]
    thrown = TrashedDesign(component=component, file=file, content=file.read_bytes())
    send2trash(file.resolve())
    workspace.trashed_designs[component] = thrown
    workspace.drop_document(component)
    workspace.sync_from_disk()
    return thrown


def restore_from_trash(workspace: Workspace, thrown: TrashedDesign) -> str:
    """Put a design back where it was; returns why not, in words.

    Raises:
        OSError: The file cannot be written.
    """
    if thrown.file.exists():
        return f"there is another {thrown.file.name} now; {thrown.component} is still in the trash"
    write_text(thrown.file, thrown.content.decode("utf-8"))
    workspace.trashed_designs.pop(thrown.component, None)
    workspace.sync_from_disk()
    return ""


def copy_name(workspace: Workspace, component: str) -> str:
    """A free name for a copy."""
    return unique_name(component, set(workspace.project.interfaces()))


def validate_component_name(workspace: Workspace, name: str) -> str:
    """Why a new design cannot be called so, in words; empty if it can."""
    if not is_valid_name(name):
        return (
            f"a component is named in letters, digits and underscores, such as {name_from_text(name) or 'FollowBall'}"
        )
    if workspace.project.interface(name) is not None:
        return f"there is already a component {name}"
    file = workspace.folder / f"{snake_case(name)}.yaml"
    return f"there is already a file {file.name}" if file.exists() else ""


def duplicate_design(workspace: Workspace, component: str, name: str) -> None:
    """Make a copy of a design as it is now, under another name and in a file of its own.

    Raises:
        OSError: The file cannot be written, or there is one already.
    """
    design = workspace.project.design(component)
    assert design is not None, "only a design that is there can be copied"
    text = workspace.files[component].read_bytes().decode("utf-8")
    workspace.create(name, save_design(replace(design, component=name), text))
