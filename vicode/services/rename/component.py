"""Renames a component with all references in its project: first a plan, then the files are written."""

from dataclasses import dataclass, replace
from pathlib import Path

from vicode.model.design import Design
from vicode.model.names import is_valid_name, snake_case
from vicode.model.project import Project
from vicode.services import messages
from vicode.services.rename.project_files import ProjectFiles, validate_writable
from vicode.services.rename.xabsl import rename_in_xabsl
from vicode.store import (
    find_project_file,
    is_file_taken,
    read_project_file,
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


def plan_component_rename(project_files: ProjectFiles, old: str, new: str) -> ComponentRenamePlan:
    """Plan the rename of a component; no file is written."""
    project = project_files.project
    error = _validate_name(project_files, old, new)
    renamed = {} if error else _renamed(project, old, new)
    touched = [name for name, design in renamed.items() if project.design(name) != design]
    error = error or validate_writable(project_files, touched)
    file = project_files.files.get(old)
    design = project.design(old)
    if error or file is None or design is None:
        return ComponentRenamePlan(old=old, new=new, error=error or messages.no_design(old))
    target = file.with_name(f"{snake_case(new)}{file.suffix}")
    is_moved = target.resolve() != file.resolve()
    if is_moved and target.name.casefold() != file.name.casefold() and is_file_taken(target):
        return ComponentRenamePlan(old=old, new=new, error=messages.file_exists(target.name))
    try:
        own = _own_change(renamed[old], file, target if is_moved else file, (old, new))
        users = [_user_change(renamed[name], project_files.files[name], new) for name in touched if name != old]
        project_change = _project_change(project_files.folder, (old, new))
    except ValueError as reason:
        return ComponentRenamePlan(old=old, new=new, error=messages.not_representable(reason))
    changes = (own, *users, *([project_change] if project_change else []))
    return ComponentRenamePlan(old=old, new=new, changes=changes, removed=file if is_moved else None)


def _validate_name(project_files: ProjectFiles, old: str, new: str) -> str:
    if not is_valid_name(new):
        return messages.invalid_component_name(new)
    if new == old:
        return "the name is unchanged"
    return messages.name_exists("component", new) if project_files.project.interface(new) is not None else ""


def _renamed(project: Project, old: str, new: str) -> dict[str, Design]:
    """The renamed designs by their current names; hand-written XABSL follows where its meaning is certain."""

    def renamed(design: Design) -> Design:
        uses = (replace(use, component=new) if use.component == old else use for use in design.uses)
        component = new if design.component == old else design.component
        return replace(design, component=component, uses=tuple(uses))

    after = rename_in_xabsl(project, replace(project, designs=tuple(map(renamed, project.designs))))
    return {before.component: now for before, now in zip(project.designs, after.designs, strict=True)}


def _own_change(design: Design, file: Path, target: Path, names: tuple[str, str]) -> FileChange:
    text = _read(file)
    new = save_design(design, text)
    summary = messages.component_summary(*names)
    if target == file:
        return FileChange(file=file, old=text, new=new, summary=summary)
    summary = f"{summary}; {messages.file_summary(file.name, target.name)}"
    return FileChange(file=target, old=None, new=new, summary=summary)


def _user_change(design: Design, file: Path, new: str) -> FileChange:
    aliases = [use.alias for use in design.uses if use.component == new]
    text = _read(file)
    summary = messages.user_summary(design.component, new, aliases)
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
    return FileChange(file=file, old=text, new=changed, summary=f"agent {', '.join(agents)} starts with {new}")


def _read(file: Path) -> str:
    return file.read_bytes().decode("utf-8")
