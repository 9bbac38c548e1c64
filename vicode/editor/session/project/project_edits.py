"""Edits of project.yaml: written at once, and recorded in the undo history of the design in which they were made."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from vicode.editor.session import texts
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.document import DocumentSession, FileTransaction
from vicode.editor.session.presence import DISK_USER
from vicode.editor.session.project.interface_edits import shared_names
from vicode.editor.session.project.project_paths import ProjectNodePath
from vicode.editor.session.workspace import Workspace
from vicode.model.design import Declaration, Design
from vicode.model.edits import unique_name
from vicode.model.merge import merge_designs, merge_lines
from vicode.model.project import Agent, Enumeration, Interface, Project
from vicode.services import messages
from vicode.services.rename.symbol import describe_new_errors, find_errors
from vicode.store import (
    ProjectReadResult,
    find_project_file,
    is_read_only,
    read_project_file,
    replace_text,
    save_project_file,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectEditResult:
    """The result of an edit of project.yaml; `error` is the message if it failed.

    `edit` is None if nothing changed. `broken_designs` are the components that the edit gave new errors.
    """

    edit: "ProjectEdit | None" = None
    error: str = ""
    broken_designs: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectEdit:
    """An edit of project.yaml that undo and redo merge with later changes of the file.

    `summary` is a short description. `old` is None if there was no file.
    """

    workspace: Workspace
    summary: str
    old: str | None
    new: str

    @property
    def label(self) -> str:
        return f"project.yaml: {self.summary}"

    def undo(self, _user_id: str) -> str:
        return self._merge_and_write(self.new, self.old or "")

    def redo(self, _user_id: str) -> str:
        return self._merge_and_write(self.old or "", self.new)

    def _merge_and_write(self, base: str, wanted: str) -> str:
        file = find_project_file(self.workspace.folder)
        try:
            now = file.read_bytes().decode("utf-8") if file else ""
            text = merge_lines(base, now, wanted)
            if text is None or (text and read_project_file(text, "project.yaml").project is None):
                return texts.not_done("these lines of project.yaml have changed in the meantime")
            _write_or_remove(
                self.workspace, file, None if self.old is None and not text else text, now if file else None
            )
        except (OSError, ValueError) as error:
            return texts.not_done(error_reason(error))
        return ""


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignAndProjectEdit:
    """An edit of a design and of project.yaml, which are undone and redone together."""

    file_edit: ProjectEdit
    label: str
    old: Design
    new: Design

    def undo(self, user_id: str) -> str:
        label = texts.undo_label(self.label)
        transaction = FileTransaction(files=frozenset(), label=label, user_id=user_id, undone_edit=self)
        return self._apply(transaction, self.new, self.old, self.file_edit.undo)

    def redo(self, user_id: str) -> str:
        label = texts.redo_label(self.label)
        transaction = FileTransaction(files=frozenset(), label=label, user_id=user_id, compound=self)
        return self._apply(transaction, self.old, self.new, self.file_edit.redo)

    def _apply(
        self, transaction: FileTransaction, base: Design, wanted: Design, change_file: Callable[[str], str]
    ) -> str:
        document = self.file_edit.workspace.open_document(self.new.component)
        merged = merge_designs(base, document.design, wanted) if document else None
        if document is None or merged is None or merged.conflicts:
            return texts.not_done("these parts of the design have changed in the meantime")
        error = change_file(transaction.user_id)
        if not error:
            DocumentSession(document.shared, transaction.user_id).apply_transaction(transaction, merged.design)
        return error


def edit_design_and_project(
    document: DocumentSession,
    workspace: Workspace,
    label: str,
    change_design: Callable[[Design], Design],
    change_project: Callable[[Project], Project],
) -> str:
    """Change project.yaml and then a design, as one entry of its history; returns an error message or "".

    Raises:
        OSError: project.yaml cannot be read or written.
    """
    result = edit_project_file(workspace, change_project, summary=label)
    old, new = document.design, change_design(document.design)
    if result.error:
        return result.error
    if result.edit is None:
        document.edit(label, change_design)
        return ""
    edit = DesignAndProjectEdit(file_edit=result.edit, label=label, old=old, new=new)
    transaction = FileTransaction(files=frozenset(), label=label, user_id=document.user_id, compound=edit)
    document.apply_transaction(transaction, new)
    return ""


def edit_project_file(
    workspace: Workspace,
    change: Callable[[Project], Project],
    node: ProjectNodePath | None = None,
    *,
    summary: str = "changed",
    allow_errors: bool = False,
) -> ProjectEditResult:
    """Change project.yaml by patching its text; a missing file is created.

    Args:
        workspace: The project.
        change: Maps the project to the changed one.
        node: The edited node; the edit fails if another program has renamed it.
        summary: A short description for the undo history.
        allow_errors: Also accept an edit that adds errors to project.yaml itself.

    Raises:
        OSError: The file cannot be read or written.
    """
    file = find_project_file(workspace.folder)
    if file is not None and is_read_only(file):
        return ProjectEditResult(error=messages.read_only([file.name]))
    known = workspace.project
    content = file.read_bytes() if file else b""
    read = read_project_file(content, file.name) if file else None
    project = known if read is None else read.project
    if project is None:
        return ProjectEditResult(error=texts.project_file_unreadable(_first_error(read)))
    old = content.decode("utf-8") if file else None
    project = replace(project, designs=known.designs)
    if node is not None and node.names(project) != node.names(known):
        return ProjectEditResult(error=messages.changed_on_disk("project.yaml"))
    changed = change(project)
    error = "" if allow_errors else describe_new_errors(project, changed, ())
    if error:
        return ProjectEditResult(error=error)
    try:
        new = save_project_file(changed, old or "")
    except ValueError as reason:
        return ProjectEditResult(error=messages.not_representable(reason))
    if new == old:
        return ProjectEditResult()
    _write_or_remove(workspace, file, new, old)
    edit = ProjectEdit(workspace=workspace, summary=summary, old=old, new=new)
    return ProjectEditResult(edit=edit, broken_designs=_newly_broken(project, changed))


def add_enumeration(project: Project) -> Project:
    added = Enumeration(name=unique_name("Kind", shared_names(project)), elements=(("first", ""),))
    return replace(project, enumerations=(*project.enumerations, added))


def add_element(enumeration: Enumeration) -> Enumeration:

    name = unique_name("element", set(enumeration.element_names))
    return replace(enumeration, elements=(*enumeration.elements, (name, "")))


def add_constant(project: Project) -> Project:
    added = Declaration(name=unique_name("constant", shared_names(project)), initial="0")
    return replace(project, constants=(*project.constants, added))


def add_component(project: Project) -> Project:
    """Add a component that has neither a design nor an implementation."""
    added = Interface(component=unique_name("Component", shared_names(project)))
    return replace(project, components=(*project.components, added))


def add_agent(project: Project, root: str) -> Project:
    added = Agent(name=unique_name("agent", {agent.name for agent in project.agents}), root=root)
    return replace(project, agents=(*project.agents, added))


def add_declaration(component: Interface, section: str) -> Interface:
    known: tuple[Declaration, ...] = getattr(component, section)
    names = {declaration.name for declaration in (*component.readable, *component.parameters)}
    added = Declaration(name=unique_name(section.removesuffix("s"), names), type="float")
    changes: dict[str, Any] = {section: (*known, added)}
    return replace(component, **changes)


def add_argument(output: Declaration) -> Declaration:
    """Add an argument to an output, which becomes a function."""
    known = output.arguments or ()
    added = Declaration(name=unique_name("argument", {each.name for each in known}), type="float")
    return replace(output, arguments=(*known, added))


def _first_error(read: ProjectReadResult | None) -> str:
    first = next(iter(read.findings), None) if read is not None else None
    return f"{first.message}{first.fix and f'; {first.fix}'}" if first is not None else ""


def _newly_broken(before: Project, after: Project) -> tuple[str, ...]:
    """The components, or project.yaml, with more errors than before."""
    old, new = (
        Counter(error.subject.component for error in find_errors(project) if error.subject)
        for project in (before, after)
    )
    names = ("", *(design.component for design in after.designs))
    return tuple(name or "project.yaml" for name in names if new[name] > old[name])


def _write_or_remove(workspace: Workspace, file: Path | None, text: str | None, old: str | None) -> None:
    """Replace `old` in project.yaml, or remove the file if `text` is None, and notify all windows of the project."""
    if text is not None:
        replace_text(file or workspace.folder / "project.yaml", old, text)
    elif file is not None:
        file.unlink()
    workspace.sync_from_disk()
    for document in workspace.documents:
        document.shared.changes.notify(DocumentSession(document.shared, DISK_USER))
