"""Executes the plans of renames: writes the files, synchronizes the open designs, and can be undone."""

from dataclasses import dataclass, replace
from pathlib import Path

from vicode.editor.session import texts
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.document import DocumentSession, FileTransaction
from vicode.editor.session.presence import DISK_USER
from vicode.editor.session.workspace import Workspace
from vicode.model.rename import SymbolRef
from vicode.services import messages
from vicode.services.rename.component import ComponentRenamePlan, plan_component_rename
from vicode.services.rename.files import write_changes
from vicode.services.rename.symbol import SymbolRenamePlan, describe_symbol, plan_symbol_rename


def apply_component_rename(workspace: Workspace, plan: ComponentRenamePlan) -> str:
    """Execute a plan; returns an error message if the files have changed since it was made.

    Raises:
        OSError: A file cannot be written; all files are as before.
    """
    current = plan_component_rename(workspace, plan.old, plan.new)
    if current != plan:
        return current.error or messages.PLAN_OUTDATED
    write_changes(plan.changes, plan.removed)
    workspace.drop_document(plan.old, renamed_to=plan.new)
    files = frozenset(change.file for change in plan.changes)
    workspace.sync_from_disk(
        FileTransaction(files=files, label=texts.rename(f"component {plan.old}", plan.new), user_id=DISK_USER)
    )
    return ""


def apply_symbol_rename(workspace: Workspace, plan: SymbolRenamePlan, user_id: str = "") -> str:
    """Execute a plan; returns an error message if the files have changed since it was made.

    Raises:
        OSError: A file cannot be written; all files are as before.
    """
    current = plan_symbol_rename(workspace, plan.symbol, plan.new)
    if current != plan:
        return current.error or messages.PLAN_OUTDATED
    edit = RenameEdit(workspace=workspace, symbol=plan.symbol, new=plan.new)
    transaction = FileTransaction(files=_files_of(plan), label=edit.label, user_id=user_id, compound=edit)
    _write_all(workspace, plan, transaction)
    return ""


@dataclass(frozen=True, slots=True, kw_only=True)
class RenameEdit:
    """A rename in several files; undo in the history of any of the designs reverts it in all files."""

    workspace: Workspace
    symbol: SymbolRef
    new: str

    @property
    def label(self) -> str:
        return texts.rename(self.symbol.name, self.new)

    def undo(self, user_id: str) -> str:
        plan = plan_symbol_rename(self.workspace, replace(self.symbol, name=self.new), self.symbol.name)
        files, label = _files_of(plan), texts.undo_label(self.label)
        return self._apply(plan, FileTransaction(files=files, label=label, user_id=user_id, undone_edit=self))

    def redo(self, user_id: str) -> str:
        plan = plan_symbol_rename(self.workspace, self.symbol, self.new)
        files, label = _files_of(plan), texts.redo_label(self.label)
        return self._apply(plan, FileTransaction(files=files, label=label, user_id=user_id, compound=self))

    def _apply(self, plan: SymbolRenamePlan, transaction: FileTransaction) -> str:
        if plan.error:
            return plan.error[:1].upper() + plan.error[1:]
        document = self.workspace.open_document(self.symbol.component)
        if plan.design is not None and document is not None:
            # Only this design still refers to the symbol.
            DocumentSession(document.shared, transaction.user_id).apply_transaction(transaction, plan.design)
            return ""
        try:
            _write_all(self.workspace, plan, transaction)
        except (OSError, ValueError) as error:
            return texts.not_done(error_reason(error))
        return ""


def _files_of(plan: SymbolRenamePlan) -> frozenset[Path]:
    return frozenset(change.file for change in plan.changes)


def _write_all(workspace: Workspace, plan: SymbolRenamePlan, transaction: FileTransaction) -> None:
    """Write all files of a plan or none, synchronize the open designs, and notify their users."""
    try:
        write_changes(plan.changes)
    finally:
        workspace.sync_from_disk(transaction)
    user = workspace.users.name_of(transaction.user_id) if transaction.user_id else "Someone"
    notice = texts.user_renamed(user, describe_symbol(plan.symbol), plan.new, len(transaction.files))
    for document in workspace.documents:
        session = DocumentSession(document.shared, transaction.user_id)
        if document.file in transaction.files:
            session.post_notice(notice)
        # The form of every design shows the declarations of the project.
        document.shared.changes.notify(session)
