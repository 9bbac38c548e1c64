"""Edits of generated code that wait for a user: for each region the text of the file, of the design, or a third."""

from collections.abc import Callable, Sequence
from pathlib import PurePath

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.side_choice import ChoiceSide, side_choice
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DocumentSession, code_sync
from vicode.editor.session.code_sync import OutdatedChoiceError
from vicode.editor.session.outside_edits import OutsideEdit

_FILE, _DESIGN, _TEXT = "file", "design", "text"


class CodeChoices:
    """A list of edits with their choices; `on_change` is called after each choice."""

    def __init__(
        self, context: WindowContext, documents: Sequence[DocumentSession], on_change: Callable[[], object]
    ) -> None:
        self._context, self._on_change = context, on_change
        self._rows = [
            (document, _EditChoice(context, edit, self._on_choice))
            for document in documents
            for edit in document.shared.outside.waiting
        ]

    @property
    def is_complete(self) -> bool:
        return all(row.is_chosen for _document, row in self._rows)

    def apply(self) -> bool:
        """Apply the choices, as one edit of each design; return whether they still applied."""
        documents = {document.design.component: document for document, _row in self._rows}
        try:
            for name, document in documents.items():
                rows = [row for other, row in self._rows if other.design.component == name]
                user = self._context.document.user_id
                code_sync.resolve(
                    self._context.workspace,
                    DocumentSession(document.shared, user),
                    {row.edit: row.text for row in rows if row.is_chosen},
                )
        except OutdatedChoiceError:
            self._context.show_toast(texts.CONFLICT_CHANGED, "info")
            return False
        return True

    def _on_choice(self) -> None:
        self._on_change()


class _EditChoice:
    """The choice for one edit."""

    def __init__(self, context: WindowContext, edit: OutsideEdit, on_change: Callable[[], object]) -> None:
        self.edit, self._on_change = edit, on_change
        self._chosen = ""
        region = edit.region
        place = f"{PurePath(edit.file.path).name}, line {region.line}"
        with ui.row().classes("conflict-head"):
            ui.label(edit.name).classes("conflict-place mono")
            ui.label(place).classes("small")
        ui.label(reason_of(edit)).classes("small")
        sides = {
            _FILE: ChoiceSide(
                title=texts.IN_FILE, text=region.file_text, is_disabled=not edit.path or not _is_valid(edit)
            ),
            _DESIGN: ChoiceSide(title=texts.IN_DESIGN, text=region.design_text),
        }
        self._show = side_choice(sides, self._choose)
        self._editor: ui.codemirror | None = None
        if edit.path:
            with ui.column().classes("conflict-merged"):
                self._button = ui.button("Edit merged text", icon="edit", on_click=self._edit, color=None)
                self._button.props("flat dense no-caps size=sm")
                self._editor = context.code_editors.create()
                self._editor.classes("code-field").props(f'aria-label="Merged text of {edit.name}"')
                self._editor.set_value(region.merged or region.file_text)
                self._editor.set_visibility(False)

    @property
    def is_chosen(self) -> bool:
        return bool(self._chosen)

    @property
    def text(self) -> str | None:
        """The chosen text, None for that of the design."""
        if self._chosen == _DESIGN:
            return None
        if self._chosen == _TEXT and self._editor is not None:
            return str(self._editor.value or "")
        return self.edit.region.file_text if self.edit.region.merged is None else self.edit.region.merged

    def _choose(self, side: str) -> None:
        self._chosen = side
        if self._editor is not None:
            self._editor.set_visibility(side == _TEXT)
        self._on_change()

    def _edit(self) -> None:
        self._show("")
        self._choose(_TEXT)


def ask_to_resolve_code(
    context: WindowContext, documents: Sequence[DocumentSession] = (), title: str = texts.EDITED_OUTSIDE
) -> None:
    """Open the dialog with the edits missing from designs, by default from the open one."""
    documents = documents or (context.document,)
    if not any(document.shared.outside.waiting for document in documents):
        return
    with titled_dialog(title, "conflict") as dialog:
        ui.label(texts.CHOOSE_TEXTS).classes("small")
        with ui.column().classes("conflict-list"):
            choices = CodeChoices(context, documents, lambda: apply_button.set_enabled(choices.is_complete))

        def apply() -> None:
            dialog.close()
            if choices.apply():
                context.show_toast(texts.RESOLVED, "positive")
            else:
                ask_to_resolve_code(context, documents, title)

        with ui.row().classes("dialog-buttons"):
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
            apply_button = primary_button("Apply", apply)
            apply_button.disable()
    dialog.on("hide", dialog.delete)


def _is_valid(edit: OutsideEdit) -> bool:
    """Whether the text of the file may be in a design."""
    return edit.finding is None or edit.region.is_conflict


def reason_of(edit: OutsideEdit) -> str:
    """Why an edit waits for a user."""
    if not edit.path:
        return texts.CODE_GONE
    if edit.region.is_conflict:
        return texts.SAME_LINES_CHANGED
    if edit.finding is None:
        return texts.EDIT_WAS_UNDONE
    problem = edit.finding.message.partition(": ")[2]
    return f"{problem[:1].upper()}{problem[1:]}."
