"""Changes of project.yaml itself: written at once, as no design is its home; what was written can be taken back."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from vicode.editor.session.declared_names import errors_of, refuse_outcome
from vicode.editor.session.document import Document
from vicode.editor.session.people import DISK
from vicode.editor.session.project_spots import Spot
from vicode.editor.session.workspace import Workspace
from vicode.model.design import Declaration
from vicode.model.edits import free_name
from vicode.model.project import INTERNAL, WORLD, Agent, Enumeration, Interface, Project
from vicode.store import ReadProject, is_read_only, project_file_in, read_project_file, save_project_file, write_text


@dataclass(frozen=True, slots=True, kw_only=True)
class Written:
    """What became of project.yaml; `refused` says in words why nothing did.

    `old` is None where there was no file. `broken` are the designs that have errors by it.
    """

    file: Path | None = None
    old: str | None = ""
    new: str = ""
    refused: str = ""
    broken: tuple[str, ...] = ()


def change_project_file(
    workspace: Workspace, change: Callable[[Project], Project], spot: Spot | None = None, *, is_agreed: bool = False
) -> Written:
    """Write another project.yaml, patching its text; comments and the order of keys stay. Without a file one is made.

    With a `spot` what stands there must still be called as it is shown. What brings errors to the file itself is
    refused unless somebody agreed to it.

    Raises:
        OSError: The file cannot be read or written.
    """
    file = project_file_in(workspace.folder)
    if file is not None and is_read_only(file):
        return Written(refused=f"{file.name} cannot be changed: read-only")
    known = workspace.project
    content = file.read_bytes() if file else b""
    read = read_project_file(content, file.name) if file else None
    project = known if read is None else read.project
    if project is None:
        return Written(refused=f"project.yaml cannot be read{_first_reason(read)}")
    old = content.decode("utf-8") if file else None
    project = replace(project, designs=known.designs)
    if spot is not None and spot.names(project) != spot.names(known):
        return Written(refused="project.yaml was just changed by another program: look again")
    changed = change(project)
    refused = "" if is_agreed else refuse_outcome(project, changed, ())
    if refused:
        return Written(refused=refused)
    try:
        new = save_project_file(changed, old or "")
    except ValueError as error:
        return Written(refused=f"no file can hold that: {error}")
    file = file or workspace.folder / "project.yaml"
    if new != old:
        write_text(file, new)
        _follow(workspace)
    return Written(file=file, old=old, new=new, broken=_broken_by(project, changed))


def take_back(workspace: Workspace, written: Written) -> str:
    """Write what stood in the file before; returns why not, if somebody else wrote it since.

    Raises:
        OSError: The file cannot be read or written.
    """
    file = written.file
    if file is None or not file.is_file() or file.read_bytes() != written.new.encode():
        return "project.yaml was changed since"
    if written.old is None:
        file.unlink()
    else:
        write_text(file, written.old)
    _follow(workspace)
    return ""


def add_enumeration(project: Project) -> Project:
    """One more enumeration, of one element."""
    made = Enumeration(name=free_name("Kind", _shared_names(project)), elements=(("first", ""),))
    return replace(project, enumerations=(*project.enumerations, made))


def add_element(enumeration: Enumeration) -> Enumeration:
    """One more element."""
    name = free_name("element", set(enumeration.element_names))
    return replace(enumeration, elements=(*enumeration.elements, (name, "")))


def add_constant(project: Project) -> Project:
    """One more constant."""
    made = Declaration(name=free_name("constant", _shared_names(project)), initial="0")
    return replace(project, constants=(*project.constants, made))


def add_component(project: Project) -> Project:
    """One more component without a design: of the world, or a memory where there is none."""
    name = free_name("Component", _shared_names(project))
    made = Interface(component=name, implementation=WORLD if project.world else INTERNAL)
    return replace(project, components=(*project.components, made))


def add_agent(project: Project, root: str) -> Project:
    """One more agent."""
    made = Agent(name=free_name("agent", {each.name for each in project.agents}), root=root)
    return replace(project, agents=(*project.agents, made))


def add_declaration(component: Interface, section: str) -> Interface:
    """One more parameter, output or variable of a component."""
    known: tuple[Declaration, ...] = getattr(component, section)
    beside = (*component.readable, *component.parameters)
    made = Declaration(name=free_name(section.removesuffix("s"), {each.name for each in beside}), type="float")
    changes: dict[str, Any] = {section: (*known, made)}
    return replace(component, **changes)


def _first_reason(read: ReadProject | None) -> str:
    found = next(iter(read.findings), None) if read is not None else None
    return f": {found.message}{found.mend and f'; {found.mend}'}" if found is not None else ""


def _shared_names(project: Project) -> set[str]:
    enumerations, constants = ({each.name for each in things} for things in (project.enumerations, project.constants))
    return enumerations | constants | set(project.interfaces())


def _broken_by(before: Project, after: Project) -> tuple[str, ...]:
    """What has more errors than before: designs, and the file itself."""
    old, new = (Counter(each.thing.component for each in errors_of(every) if each.thing) for every in (before, after))
    names = ("", *(each.component for each in after.designs))
    return tuple(name or "project.yaml" for name in names if new[name] > old[name])


def _follow(workspace: Workspace) -> None:
    """Take over what was written; all windows of the project show it."""
    workspace.follow_disk()
    for document in workspace.documents:
        document.sheet.tell(Document(document.sheet, DISK))
