"""Extracts states as a component with a file of its own, and inlines it; each is one step of undo over both files."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from vicode.diagram.kept_positions import keep_positions
from vicode.editor.session import texts
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.document import DocumentSession, FileTransaction
from vicode.editor.session.gestures.edits import EditResult
from vicode.editor.session.project.trash import find_dependents, validate_component_name
from vicode.editor.session.workspace import DiskConflictError, Workspace
from vicode.editor.view import ItemRef
from vicode.model.design import Design
from vicode.model.extract import extract_component
from vicode.model.inline import inline_component, inlined_use
from vicode.model.merge import merge_designs
from vicode.store import replace_text, save_extracted, take_comments


@dataclass(frozen=True, slots=True, kw_only=True)
class ExtractionEdit:
    """An extraction or its reverse: `whole` has all states, `caller` the calling one; `text` is that of the file."""

    workspace: Workspace
    whole: Design
    caller: Design
    component: Design
    text: str
    is_inlining: bool = False
    names: Mapping[str, str] = field(default_factory=dict)
    """The names of inlined states by those in the component."""

    @property
    def label(self) -> str:
        return f"{'inline' if self.is_inlining else 'extract'} component {self.component.component}"

    def undo(self, user_id: str) -> str:
        return texts.not_done(error) if (error := self.apply(user_id, is_undo=True)) else ""

    def redo(self, user_id: str) -> str:
        return texts.not_done(error) if (error := self.apply(user_id)) else ""

    def apply(self, user_id: str, *, is_undo: bool = False) -> str:
        """Change both files; returns an error message or an empty string."""
        document = self.workspace.open_document(self.whole.component)
        assert document is not None
        session = DocumentSession(document.shared, user_id)
        is_adding = self.is_inlining == is_undo
        before, after = (self.whole, self.caller) if is_adding else (self.caller, self.whole)
        merged = merge_designs(before, session.design, after)
        error = self._find_error(is_adding=is_adding)
        if error or merged.conflicts:
            return error or f"{self.whole.component} was changed at the same place"
        transaction = FileTransaction(
            files=frozenset((session.file,)),
            label=texts.undo_label(self.label) if is_undo else self.label,
            user_id=user_id,
            compound=None if is_undo else self,
            undone_edit=self if is_undo else None,
        )
        try:
            if is_adding:
                self.workspace.create(self.component.component, self.text)
            session.apply_transaction(transaction, keep_positions(session.design, merged.design))
            old_text = session.shared.disk_text
            self.workspace.save(session)
            if not is_adding:
                self._take_comments(session, old_text)
                self.workspace.files[self.component.component].unlink()
                self.workspace.drop_document(self.component.component)
                self.workspace.sync_from_disk()
        except DiskConflictError:
            return f"another program has changed {session.file.name}"
        except (OSError, ValueError) as reason:
            return error_reason(reason)
        return ""

    def _take_comments(self, session: DocumentSession, old_text: str) -> None:
        """Write the comments of the component into the file of the caller."""
        document = self.workspace.open_document(self.component.component)
        text = session.shared.disk_text
        if document is not None:
            replace_text(session.file, text, take_comments(document.shared.disk_text, old_text, text, self.names))

    def _find_error(self, *, is_adding: bool) -> str:
        name = self.component.component
        if is_adding:
            return validate_component_name(self.workspace, name)
        users = set(find_dependents(self.workspace, name)) - {self.whole.component}
        if users:
            return f"{', '.join(sorted(users))} {'uses' if len(users) == 1 else 'use'} {name}"
        document = self.workspace.open_document(name)
        is_saved = document is not None and document.is_saved and self.workspace.is_file_unchanged(name)
        if document is None or document.design != self.component or not is_saved:
            return f"{name} has other changes: save or undo them first"
        return ""


def extract_states(workspace: Workspace, document: DocumentSession, states: Collection[str], name: str) -> EditResult:
    """Extract states of a design as the component `name`."""
    design = document.design
    error = validate_component_name(workspace, name)
    if "xabsl" in workspace.project.languages:
        error = error or "XABSL cannot step a component before its caller decides: the behavior would change"
    found = extract_component(design, states, name)
    if error or found.problems:
        return EditResult(error=error or found.problems[0])
    edit = ExtractionEdit(
        workspace=workspace,
        whole=design,
        caller=found.caller,
        component=found.component,
        text=save_extracted(found.component, document.shared.disk_text),
    )
    new = next(each for each in found.caller.states if not {*each.requires[-1:]} <= {use.alias for use in design.uses})
    return EditResult(new_selection=_selection((new.name,)), error=edit.apply(document.user_id), note=found.note)


def inline_state(workspace: Workspace, document: DocumentSession, state: str) -> EditResult:
    """Put the states of the component that a state requires in its place, and delete the file of the component."""
    use = inlined_use(document.design, state)
    used = workspace.open_document(use.component) if use is not None else None
    if use is None or used is None:
        return EditResult(error=f"{state} requires no component with a design")
    agents = [agent.name for agent in workspace.project.agents if agent.root == use.component]
    if agents:
        return EditResult(error=f"{use.component} is the root of the agent {agents[0]}")
    found = inline_component(document.design, state, used.design)
    if found.problem:
        return EditResult(error=found.problem)
    edit = ExtractionEdit(
        workspace=workspace,
        whole=found.caller,
        caller=document.design,
        component=used.design,
        text=used.shared.disk_text,
        is_inlining=True,
        names=found.names,
    )
    return EditResult(new_selection=_selection(found.names.values()), error=edit.apply(document.user_id))


def _selection(states: Collection[str]) -> tuple[ItemRef, ...]:
    return tuple(ItemRef(kind="states", id=name) for name in states)
