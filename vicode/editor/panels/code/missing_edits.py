"""The list of edits in generated files that are missing from the open design, above the generated code."""

from pathlib import PurePath

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.code.code_choices import ask_to_resolve_code, reason_of
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.versions.diff_view import diff_view
from vicode.editor.panels.widgets import ClickHandler
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.code import code_sync
from vicode.editor.session.code.outside_edits import OutsideEdit
from vicode.sync import FileEdits


class MissingEdits:
    """One row per edited region, and one per file that was edited outside regions."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._shown: object = None
        self._list = (
            ui.column().classes("missing-edits").props('role="list" aria-label="Edits missing from the design"')
        )
        self._list.set_visibility(False)

    def refresh(self) -> bool:
        """Show the edits; return whether they changed."""
        outside = self._context.document.shared.outside
        shown = (outside.waiting, outside.edited_outside)
        if shown == self._shown:
            return False
        self._shown = shown
        self._list.clear()
        self._list.set_visibility(bool(outside.waiting or outside.edited_outside))
        with self._list:
            for edit in outside.waiting:
                self._add_region(edit)
            for file in outside.edited_outside:
                self._add_file(file)
        return True

    def _add_region(self, edit: OutsideEdit) -> None:
        region = edit.region
        with ui.element("div").classes("missing-edit").props('role="listitem"'):
            ui.label(edit.name).classes("mono")
            ui.label(f"{PurePath(edit.file.path).name}, line {region.line}. {reason_of(edit)}").classes("small")
            with ui.row().classes("row-buttons"):
                _button("Apply", f"Apply {edit.name}", lambda: self._apply(edit))
                _button(
                    "Show difference",
                    f"Show difference of {edit.name}",
                    lambda: _show_difference(edit.name, region.file_text, region.design_text),
                )

    def _add_file(self, file: FileEdits) -> None:
        name = PurePath(file.path).name
        with ui.element("div").classes("missing-edit").props('role="listitem"'):
            ui.label(name).classes("mono")
            ui.label("Edited outside regions. Generate lists the edits that the design can express.").classes("small")
            with ui.row().classes("row-buttons"):
                _button(
                    "Show difference",
                    f"Show difference of {name}",
                    lambda: _show_difference(name, file.old, file.new or ""),
                )

    def _apply(self, edit: OutsideEdit) -> None:
        """Apply an edit that a user had undone; ask about another one."""
        if edit.finding is not None or edit.region.merged is None:
            ask_to_resolve_code(self._context)
            return
        try:
            code_sync.resolve(self._context.workspace, self._context.document, {edit: edit.region.merged})
        except code_sync.OutdatedChoiceError:
            self._context.show_toast(texts.CONFLICT_CHANGED, "info")


def _button(label: str, accessible_name: str, act: ClickHandler) -> None:
    button = ui.button(label, on_click=act, color=None).props("flat dense no-caps size=sm")
    button.props["aria-label"] = accessible_name


def _show_difference(name: str, old: str, new: str) -> None:
    with titled_dialog(name, "generate-dialog") as dialog:
        with ui.element("div").classes("generate-diff"):
            diff_view(old, new)
        with ui.row().classes("dialog-buttons"):
            ui.button("Close", on_click=dialog.close).props("flat no-caps")
    dialog.on("hide", dialog.delete)
