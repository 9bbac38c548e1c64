"""Renames a component with all references in its project: first a plan, then the files are written."""

from collections.abc import Collection
from dataclasses import dataclass, replace
from pathlib import Path

from vicode.editor.session import texts
from vicode.editor.session.document import FileTransaction
from vicode.editor.session.presence import DISK_USER
from vicode.editor.session.rename_symbol_xabsl import rename_in_xabsl
from vicode.editor.session.workspace import Workspace
from vicode.model.design import Design
from vicode.model.names import is_valid_name, snake_case
from vicode.model.project import Project
from vicode.store import (
    find_project_file,
    is_read_only,
    read_project_file,
    replace_text,
    save_design,
    save_project_file,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class FileChange:
    """A file to write: its current text (None: it is new), its new text, and a summary for the user."""

    file: Path
    old: str | None
    new: str
    summary: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentRenamePlan:
    """The changes of a rename in the order of writing, or the error message.

    The new file is written first and the old one removed last, so that an interrupted rename leaves no dangling
    reference and can be repeated.
    """

    old: str
    new: str
    changes: tuple[FileChange, ...] = ()
    removed: Path | None = None
    error: str = ""


def plan_component_rename(workspace: Workspace, old: str, new: str) -> ComponentRenamePlan:
    """Plan the rename of a component; no file is written."""
    project = workspace.project
    error = _validate_name(workspace, old, new)
    renamed = {} if error else _renamed(project, old, new)
    touched = [name for name, design in renamed.items() if project.design(name) != design]
    error = error or validate_writable(workspace, touched)
    file = workspace.files.get(old)
    design = project.design(old)
    if error or file is None or design is None:
        return ComponentRenamePlan(old=old, new=new, error=error or texts.no_design(old))
    target = file.with_name(f"{snake_case(new)}{file.suffix}")
    is_moved = target.resolve() != file.resolve()
    if is_moved and target.exists():
        return ComponentRenamePlan(old=old, new=new, error=texts.file_exists(target.name))
    try:
        own = _own_change(renamed[old], file, target if is_moved else file, (old, new))
        users = [_user_change(renamed[name], workspace.files[name], new) for name in touched if name != old]
        project_change = _project_change(workspace.folder, (old, new))
    except ValueError as reason:
        return ComponentRenamePlan(old=old, new=new, error=texts.not_representable(reason))
    changes = (own, *users, *([project_change] if project_change else []))
    return ComponentRenamePlan(old=old, new=new, changes=changes, removed=file if is_moved else None)


def apply_component_rename(workspace: Workspace, plan: ComponentRenamePlan) -> str:
    """Execute a plan; returns an error message if the files have changed since it was made.

    Raises:
        OSError: A file cannot be written; files written before keep their new text, and the old design is kept.
    """
    current = plan_component_rename(workspace, plan.old, plan.new)
    if current != plan:
        return current.error or texts.PLAN_OUTDATED
    for change in plan.changes:
        replace_text(change.file, change.old, change.new)
    if plan.removed is not None:
        plan.removed.unlink()
    workspace.drop_document(plan.old, renamed_to=plan.new)
    files = frozenset(change.file for change in plan.changes)
    workspace.sync_from_disk(
        FileTransaction(files=files, label=texts.rename(f"component {plan.old}", plan.new), user_id=DISK_USER)
    )
    return ""


def _validate_name(workspace: Workspace, old: str, new: str) -> str:
    if not is_valid_name(new):
        return texts.invalid_component_name(new)
    if new == old:
        return texts.NAME_UNCHANGED
    return texts.name_exists("component", new) if workspace.project.interface(new) is not None else ""


def _renamed(project: Project, old: str, new: str) -> dict[str, Design]:
    """The renamed designs by their current names; hand-written XABSL follows where its meaning is certain."""

    def renamed(design: Design) -> Design:
        uses = (replace(use, component=new) if use.component == old else use for use in design.uses)
        component = new if design.component == old else design.component
        return replace(design, component=component, uses=tuple(uses))

    after = rename_in_xabsl(project, replace(project, designs=tuple(map(renamed, project.designs))))
    return {before.component: now for before, now in zip(project.designs, after.designs, strict=True)}


def validate_writable(workspace: Workspace, components: Collection[str]) -> str:
    """An error message if the files of designs cannot be written, else an empty string."""
    unsaved = sorted(set(components) & set(workspace.unsaved_components))
    if unsaved:
        return texts.unsaved_changes(unsaved)
    names = sorted(components)
    locked = [workspace.files[name].name for name in names if is_read_only(workspace.files[name])]
    if locked:
        return texts.read_only(locked)
    stale = [name for name in names if not workspace.is_file_unchanged(name)]
    return texts.changed_on_disk(workspace.files[stale[0]].name) if stale else ""


def _own_change(design: Design, file: Path, target: Path, names: tuple[str, str]) -> FileChange:
    text = _read(file)
    new = save_design(design, text)
    summary = texts.component_summary(*names)
    if target == file:
        return FileChange(file=file, old=text, new=new, summary=summary)
    summary = f"{summary}; {texts.file_summary(file.name, target.name)}"
    return FileChange(file=target, old=None, new=new, summary=summary)


def _user_change(design: Design, file: Path, new: str) -> FileChange:
    aliases = [use.alias for use in design.uses if use.component == new]
    text = _read(file)
    summary = texts.user_summary(design.component, new, aliases)
    return FileChange(file=file, old=text, new=save_design(design, text), summary=summary)


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
    return FileChange(file=file, old=text, new=changed, summary=texts.agent_summary(agents, new))


def _read(file: Path) -> str:
    return file.read_bytes().decode("utf-8")
