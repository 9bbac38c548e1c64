"""Edits of generated code that wait for a user: for each region the text of the file, of the design, or a third."""

from collections.abc import Callable, Sequence
from pathlib import PurePath

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.code.text_choice import OfferedTexts, TextChoice
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DocumentSession
from vicode.editor.session.code import code_sync
from vicode.editor.session.code.code_sync import OutdatedChoiceError
from vicode.editor.session.code.outside_edits import OutsideEdit


class CodeChoices:
    """A list of edits with their choices; `on_change` is called after each choice."""

    def __init__(
        self, context: WindowContext, documents: Sequence[DocumentSession], on_change: Callable[[], object]
    ) -> None:
        self._context, self._on_change = context, on_change
        self._rows = [
            (document, edit, TextChoice(context, _offered_texts(edit), self._on_choice))
            for document in documents
            for edit in document.shared.outside.waiting
        ]

    @property
    def is_complete(self) -> bool:
        return all(choice.is_chosen for _document, _edit, choice in self._rows)

    def apply(self) -> bool:
        """Apply the choices, as one edit of each design; return whether they still applied."""
        documents = {document.design.component: document for document, _edit, _choice in self._rows}
        try:
            for name, document in documents.items():
                rows = [row[1:] for row in self._rows if row[0].design.component == name]
                user = self._context.document.user_id
                code_sync.resolve(
                    self._context.workspace,
                    DocumentSession(document.shared, user),
                    {edit: choice.text for edit, choice in rows if choice.is_chosen},
                )
        except OutdatedChoiceError:
            self._context.show_toast(texts.CONFLICT_CHANGED, "info")
            return False
        return True

    def _on_choice(self) -> None:
        self._on_change()


def ask_to_resolve_code(
    context: WindowContext, documents: Sequence[DocumentSession] = (), title: str = "Generated code was edited"
) -> None:
    """Open the dialog with the edits missing from designs, by default from the open one."""
    documents = documents or (context.document,)
    if not any(document.shared.outside.waiting for document in documents):
        return
    with titled_dialog(title, "conflict") as dialog:
        ui.label(
            "Choose a text for each. The other one stays in the undo history or in the file until Generate."
        ).classes("small")
        with ui.column().classes("conflict-list"):
            choices = CodeChoices(context, documents, lambda: apply_button.set_enabled(choices.is_complete))

        def apply() -> None:
            dialog.close()
            if choices.apply():
                context.show_toast("Applied", "positive")
            else:
                ask_to_resolve_code(context, documents, title)

        with ui.row().classes("dialog-buttons"):
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
            apply_button = primary_button("Apply", apply)
            apply_button.disable()
    dialog.on("hide", dialog.delete)


def _offered_texts(edit: OutsideEdit) -> OfferedTexts:
    region = edit.region
    return OfferedTexts(
        name=edit.name,
        place=f"{PurePath(edit.file.path).name}, line {region.line}",
        reason=reason_of(edit),
        base=region.base if region.is_conflict else None,
        in_file=region.file_text,
        in_design=region.design_text,
        merged=region.merged,
        is_file_disabled=not edit.path or not _is_valid(edit),
        is_editable=bool(edit.path),
    )


def _is_valid(edit: OutsideEdit) -> bool:
    """Whether the text of the file may be in a design."""
    return edit.finding is None or edit.region.is_conflict


def reason_of(edit: OutsideEdit) -> str:
    """Why an edit waits for a user."""
    if not edit.path:
        return "This code was removed from the design. Copy what you need; the edit is dropped with the next Generate."
    if edit.region.is_conflict:
        return "Both sides changed the same lines."
    if edit.finding is None:
        return "The edit was applied and undone."
    problem = edit.finding.message.partition(": ")[2]
    return f"{problem[:1].upper()}{problem[1:]}."
