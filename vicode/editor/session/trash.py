"""Takes design files away into the system's trash, and makes new ones from old; nothing is lost either way."""

from dataclasses import replace

from vicode.editor.session.workspace import ThrownAway, Workspace
from vicode.model.edits import free_name
from vicode.model.names import is_name, name_like, snake_case
from vicode.store import save_design, write_text


def refuse_throwing_away(workspace: Workspace, component: str) -> str:
    """Why a design cannot be taken away, in words; empty if it can."""
    if workspace.project.design(component) is None:
        return f"there is no design of {component} any more"
    if component in workspace.unsaved:
        return f"{component} has unsaved changes: save or undo them first, so that what is in the trash is whole"
    return ""


def users_of(workspace: Workspace, component: str) -> tuple[str, ...]:
    """The components whose designs use this one."""
    designs = workspace.project.designs
    return tuple(each.component for each in designs if any(use.component == component for use in each.uses))


def throw_away(workspace: Workspace, component: str) -> ThrownAway:
    """Move the file of a design to the trash.

    Raises:
        OSError: There is no trash for that file, or it cannot be moved; it stays where it is.
    """
    from send2trash import send2trash  # type: ignore[import-untyped]  # noqa: PLC0415 - slow, and wanted rarely

    file = workspace.files[component]
    thrown = ThrownAway(component=component, file=file, content=file.read_bytes())
    send2trash(file.resolve())
    workspace.thrown_away[component] = thrown
    workspace.forget(component)
    workspace.follow_disk()
    return thrown


def put_back(workspace: Workspace, thrown: ThrownAway) -> str:
    """Put a design back where it was; returns why not, in words.

    Raises:
        OSError: The file cannot be written.
    """
    if thrown.file.exists():
        return f"there is another {thrown.file.name} now; {thrown.component} is still in the trash"
    write_text(thrown.file, thrown.content.decode("utf-8"))
    workspace.thrown_away.pop(thrown.component, None)
    workspace.follow_disk()
    return ""


def name_for_copy(workspace: Workspace, component: str) -> str:
    """A free name for a copy."""
    return free_name(component, set(workspace.project.interfaces()))


def refuse_name(workspace: Workspace, name: str) -> str:
    """Why a new design cannot be called so, in words; empty if it can."""
    if not is_name(name):
        return f"a component is named in letters, digits and underscores, such as {name_like(name) or 'FollowBall'}"
    if workspace.project.interface(name) is not None:
        return f"there is already a component {name}"
    file = workspace.folder / f"{snake_case(name)}.yaml"
    return f"there is already a file {file.name}" if file.exists() else ""


def duplicate(workspace: Workspace, component: str, name: str) -> None:
    """Make a copy of a design as it is now, under another name and in a file of its own.

    Raises:
        OSError: The file cannot be written, or there is one already.
    """
    design = workspace.project.design(component)
    assert design is not None, "only a design that is there can be copied"
    text = workspace.files[component].read_bytes().decode("utf-8")
    workspace.create(name, save_design(replace(design, component=name), text))
