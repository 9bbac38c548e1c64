"""Changes of project.yaml itself: written at once, and steps of the history of the design where they were made."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.presence import DISK_USER
from vicode.editor.session.project_paths import ProjectNodePath
from vicode.editor.session.rename_symbol import describe_new_errors, find_errors
from vicode.editor.session.workspace import Workspace
from vicode.model.design import Declaration
from vicode.model.edits import unique_name
from vicode.model.merge import merge_lines
from vicode.model.project import INTERNAL, WORLD, Agent, Enumeration, Interface, Project
from vicode.store import (
    ProjectReadResult,
    find_project_file,
    is_read_only,
    read_project_file,
    save_project_file,
    write_text,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectEditResult:
    """What became of project.yaml; `error` says in words why nothing did.

    `edit` is None where it is the same as before. `broken_designs` are the designs that have errors by it.
    """

    edit: "ProjectEdit | None" = None
    error: str = ""
    broken_designs: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectEdit:
    """A change of project.yaml, which histories take back and do again; what others wrote into it meanwhile stays.

    `summary` says in a few words what was changed. `old` is None where there was no file.
    """

    workspace: Workspace
    summary: str
    old: str | None
    new: str

    @property
    def label(self) -> str:
        """What the histories call it."""
        return f"project.yaml: {self.summary}"

    def undo(self, _person: str) -> str:
        """Write what stood there before; returns why not, if the same lines were changed since."""
        return self._merge_and_write(self.new, self.old or "")

    def redo(self, _person: str) -> str:
        """Write the change once more; returns why not."""
        return self._merge_and_write(self.old or "", self.new)

    def _merge_and_write(self, base: str, wanted: str) -> str:
        file = find_project_file(self.workspace.folder)
        try:
            now = file.read_bytes().decode("utf-8") if file else ""
            text = merge_lines(base, now, wanted)
            if text is None or (text and read_project_file(text, "project.yaml").project is None):
                return "Not done: project.yaml was changed since, in the same lines"
            _put(self.workspace, file, None if self.old is None and not text else text)
        except (OSError, ValueError) as error:
            return f"Not done: {error_reason(error)}"
        return ""


def edit_project_file(
    workspace: Workspace,
    change: Callable[[Project], Project],
    node: ProjectNodePath | None = None,
    *,
    summary: str = "changed",
    allow_errors: bool = False,
) -> ProjectEditResult:
    """Write another project.yaml, patching its text; comments and the order of keys stay. Without a file one is made.

    `summary` says in a few words what changes. With a `node` what stands there must still be called as it is shown. What
    brings errors to the file itself is refused unless somebody agreed to it.

    Raises:
        OSError: The file cannot be read or written.
    """
    file = find_project_file(workspace.folder)
    if file is not None and is_read_only(file):
        return ProjectEditResult(error=f"{file.name} cannot be changed: read-only")
    known = workspace.project
    content = file.read_bytes() if file else b""
    read = read_project_file(content, file.name) if file else None
    project = known if read is None else read.project
    if project is None:
        return ProjectEditResult(error=f"project.yaml cannot be read{_first_reason(read)}")
    old = content.decode("utf-8") if file else None
    project = replace(project, designs=known.designs)
    if node is not None and node.names(project) != node.names(known):
        return ProjectEditResult(error="project.yaml was just changed by another program: look again")
    changed = change(project)
    refused = "" if allow_errors else describe_new_errors(project, changed, ())
    if refused:
        return ProjectEditResult(error=refused)
    try:
        new = save_project_file(changed, old or "")
    except ValueError as error:
        return ProjectEditResult(error=f"no file can hold that: {error}")
    if new == old:
        return ProjectEditResult()
    _put(workspace, file, new)
    edit = ProjectEdit(workspace=workspace, summary=summary, old=old, new=new)
    return ProjectEditResult(edit=edit, broken_designs=_newly_broken(project, changed))


def add_enumeration(project: Project) -> Project:
    """One more enumeration, of one element."""
    made = Enumeration(name=unique_name("Kind", _shared_names(project)), elements=(("first", ""),))
    return replace(project, enumerations=(*project.enumerations, made))


def add_element(enumeration: Enumeration) -> Enumeration:
    """One more element."""
    name = unique_name("element", set(enumeration.element_names))
    return replace(enumeration, elements=(*enumeration.elements, (name, "")))


def add_constant(project: Project) -> Project:
    """One more constant."""
    made = Declaration(name=unique_name("constant", _shared_names(project)), initial="0")
    return replace(project, constants=(*project.constants, made))


def add_component(project: Project) -> Project:
    """One more component without a design: of the world, or a memory where there is none."""
    name = unique_name("Component", _shared_names(project))
    made = Interface(component=name, implementation=WORLD if project.world else INTERNAL)
    return replace(project, components=(*project.components, made))


def add_agent(project: Project, root: str) -> Project:
    """One more agent."""
    made = Agent(name=unique_name("agent", {each.name for each in project.agents}), root=root)
    return replace(project, agents=(*project.agents, made))


def add_declaration(component: Interface, section: str) -> Interface:
    """One more parameter, output or variable of a component."""
    known: tuple[Declaration, ...] = getattr(component, section)
    beside = (*component.readable, *component.parameters)
    made = Declaration(name=unique_name(section.removesuffix("s"), {each.name for each in beside}), type="float")
    changes: dict[str, Any] = {section: (*known, made)}
    return replace(component, **changes)


def _first_reason(read: ProjectReadResult | None) -> str:
    found = next(iter(read.findings), None) if read is not None else None
    return f": {found.message}{found.fix and f'; {found.fix}'}" if found is not None else ""


def _shared_names(project: Project) -> set[str]:
    enumerations, constants = ({each.name for each in things} for things in (project.enumerations, project.constants))
    return enumerations | constants | set(project.interfaces())


def _newly_broken(before: Project, after: Project) -> tuple[str, ...]:
    """What has more errors than before: designs, and the file itself."""
    old, new = (
        Counter(each.subject.component for each in find_errors(every) if each.subject) for every in (before, after)
    )
    names = ("", *(each.component for each in after.designs))
    return tuple(name or "project.yaml" for name in names if new[name] > old[name])


def _put(workspace: Workspace, file: Path | None, text: str | None) -> None:
    """Write the file, or take it away; all windows of the project show it."""
    if text is not None:
        write_text(file or workspace.folder / "project.yaml", text)
    elif file is not None:
        file.unlink()
    workspace.sync_from_disk()
    for document in workspace.documents:
        document.shared.notify_listeners(DocumentSession(document.shared, DISK_USER))
