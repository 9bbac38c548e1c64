"""Renames a component with everything in its project that names it; planned first, then written file by file."""

from collections.abc import Collection
from dataclasses import dataclass, replace
from pathlib import Path

from vicode.editor.session.document import FileTransaction
from vicode.editor.session.presence import DISK_USER
from vicode.editor.session.rename_symbol_xabsl import rename_in_xabsl
from vicode.editor.session.workspace import Workspace
from vicode.model.design import Design
from vicode.model.names import is_valid_name, name_from_text, snake_case
from vicode.model.project import Project
from vicode.store import find_project_file, is_read_only, read_project_file, save_design, save_project_file, write_text


@dataclass(frozen=True, slots=True, kw_only=True)
class FileChange:
    """A file that is written, `old` its text now (None: it is new), `new` its text then; `summary` say what changes."""

    file: Path
    old: str | None
    new: str
    summary: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentRenamePlan:
    """A plan. `error` says in words why it cannot be done; else `changes` in the order in which they are written.

    The new file comes first and the old one goes last: whoever is killed in the middle leaves a project in which
    every name still means something, and can rename again.
    """

    old: str
    new: str
    changes: tuple[FileChange, ...] = ()
    removed: Path | None = None
    error: str = ""


def plan_component_rename(workspace: Workspace, old: str, new: str) -> ComponentRenamePlan:
    """What renaming a component would change; nothing is touched."""
    project = workspace.project
    refused = _validate_name(workspace, old, new)
    renamed = {} if refused else _renamed(project, old, new)
    touched = [name for name, design in renamed.items() if project.design(name) != design]
    refused = refused or validate_writable(workspace, touched)
    file = workspace.files.get(old)
    design = project.design(old)
    if refused or file is None or design is None:
        return ComponentRenamePlan(old=old, new=new, error=refused or f"there is no design of {old}")
    target = file.with_name(f"{snake_case(new)}{file.suffix}")
    is_moved = target.resolve() != file.resolve()
    if is_moved and target.exists():
        return ComponentRenamePlan(old=old, new=new, error=f"there is already a file {target.name}")
    own = _own_change(renamed[old], file, target if is_moved else file, (old, new))
    users = [_user_change(renamed[name], workspace.files[name], new) for name in touched if name != old]
    of_project = _project_change(workspace.folder, (old, new))
    changes = (own, *users, *([of_project] if of_project else []))
    return ComponentRenamePlan(old=old, new=new, changes=changes, removed=file if is_moved else None)


def apply_component_rename(workspace: Workspace, plan: ComponentRenamePlan) -> str:
    """Carry a plan out; returns why not, in words, if the files are no longer what it was made for.

    Raises:
        OSError: A file cannot be written; what was written before stays, and the old design too.
    """
    again = plan_component_rename(workspace, plan.old, plan.new)
    if again != plan:
        return again.error or "a file has changed meanwhile: look at the list once more"
    for change in plan.changes:
        write_text(change.file, change.new)
    if plan.removed is not None:
        plan.removed.unlink()
    workspace.drop_document(plan.old, renamed_to=plan.new)
    files = frozenset(change.file for change in plan.changes)
    workspace.sync_from_disk(
        FileTransaction(files=files, label=f"rename component {plan.old} to {plan.new}", user_id=DISK_USER)
    )
    return ""


def _validate_name(workspace: Workspace, old: str, new: str) -> str:
    """Why a renaming cannot be done, in words; empty if it can."""
    if not is_valid_name(new):
        return f"a component is named in letters, digits and underscores, such as {name_from_text(new) or 'FollowBall'}"
    if new == old:
        return "that is its name already"
    return f"there is already a component {new}" if workspace.project.interface(new) is not None else ""


def _renamed(project: Project, old: str, new: str) -> dict[str, Design]:
    """The designs as they would be, by the names that they have; hand-written XABSL follows where it is certain."""

    def renamed(design: Design) -> Design:
        uses = (replace(use, component=new) if use.component == old else use for use in design.uses)
        component = new if design.component == old else design.component
        return replace(design, component=component, uses=tuple(uses))

    after = rename_in_xabsl(project, replace(project, designs=tuple(map(renamed, project.designs))))
    return {before.component: now for before, now in zip(project.designs, after.designs, strict=True)}


def validate_writable(workspace: Workspace, components: Collection[str]) -> str:
    """Why the files of some designs cannot be written just now, in words; empty if they can."""
    unsaved = sorted(set(components) & set(workspace.unsaved_components))
    if unsaved:
        return f"{', '.join(unsaved)} {'has' if len(unsaved) == 1 else 'have'} unsaved changes: save or undo them first"
    names = sorted(components)
    locked = [workspace.files[name].name for name in names if is_read_only(workspace.files[name])]
    if locked:
        return f"{', '.join(locked)} cannot be changed: read-only"
    stale = [name for name in names if not workspace.is_file_unchanged(name)]
    return f"{workspace.files[stale[0]].name} was just changed by another program: look again" if stale else ""


def _own_change(design: Design, file: Path, target: Path, names: tuple[str, str]) -> FileChange:
    text = _read(file)
    new = save_design(design, text)
    words = f"component {names[0]} → {names[1]}"
    if target == file:
        return FileChange(file=file, old=text, new=new, summary=words)
    return FileChange(file=target, old=None, new=new, summary=f"{words}; {file.name} becomes {target.name}")


def _user_change(design: Design, file: Path, new: str) -> FileChange:
    aliases = [use.alias for use in design.uses if use.component == new]
    text = _read(file)
    words = f"{design.component} uses {new} as {', '.join(aliases)}" if aliases else f"{design.component} says {new}"
    return FileChange(file=file, old=text, new=save_design(design, text), summary=words)


def _project_change(folder: Path, names: tuple[str, str]) -> FileChange | None:
    file = find_project_file(folder)
    if file is None:
        return None
    old, new = names
    text = _read(file)
    project: Project | None = read_project_file(text, str(file)).project
    agents = [agent.name for agent in project.agents if agent.root == old] if project else []
    if project is None or not agents:
        return None
    renamed = tuple(replace(agent, root=new) if agent.root == old else agent for agent in project.agents)
    changed = save_project_file(replace(project, agents=renamed), text)
    return FileChange(file=file, old=text, new=changed, summary=f"agent {', '.join(agents)} begins with {new}")


def _read(file: Path) -> str:
    return file.read_bytes().decode("utf-8")
