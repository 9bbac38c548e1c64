"""The code generated from the open design, updated while the user edits; writes no files.

The code of the selected item is highlighted; a click in the code selects the item.
"""

from nicegui import run, ui

from vicode.editor.code import CodeAssist
from vicode.editor.panels.code.missing_edits import MissingEdits
from vicode.editor.panels.widgets import ClickHandler, icon_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.code import code_preview
from vicode.editor.session.code.code_preview import CodePreview, PreviewFile
from vicode.languages import LANGUAGES


class CodePanel:
    """A read-only view of the files generated for the design; `compare` compares its languages."""

    def __init__(self, context: WindowContext, compare: ClickHandler) -> None:
        self.context = context
        self.shown_rev = -1
        self.is_busy = False
        self.preview = CodePreview()
        self.highlighted: object = None
        with ui.column().classes("code-panel"):
            with ui.row().classes("code-bar"):
                self.file_select = ui.select([], on_change=self._show_file).props(
                    'outlined dense options-dense aria-label="Generated file"'
                )
                self.file_select.classes("code-choice mono")
                icon_button("compare_arrows", "Compare languages", compare)
            self.edits = MissingEdits(context)
            self.note = ui.label().classes("code-note").props('role="status"')
            self.editor = context.code_editors.create().classes("preview")
            self.editor.disable()
            self.code_assist = CodeAssist(self.editor, label="Generated code", on_line_selected=self._select_at)

    def refresh(self) -> None:
        """Generate the code if the design has changed, and highlight the selection."""
        if not self.is_busy and self.shown_rev != self.context.document.rev:
            self.is_busy = True
            self.context.run_in_background(self._generate(), "preview")
        if self.edits.refresh():
            self._mark_edits()
        self._highlight_selection()

    @property
    def file(self) -> PreviewFile | None:
        return next((file for file in self.preview.files if file.path == self.file_select.value), None)

    async def _generate(self) -> None:
        """Generate in a thread until the newest design is shown."""
        try:
            while self.shown_rev != self.context.document.rev:
                self.shown_rev = self.context.document.rev
                # Read the inputs here: they could change while the thread runs.
                workspace, design = self.context.workspace, self.context.design
                sources = workspace.source_paths
                preview = await run.io_bound(code_preview.preview_code, workspace.project, design, sources)
                # The result is None while the server shuts down.
                if preview is None or self.editor.is_deleted:
                    return
                self.preview = preview
                self._show()
        finally:
            self.is_busy = False

    def _show(self) -> None:
        paths = [file.path for file in self.preview.files]
        if paths != self.file_select.options:
            self.file_select.set_options(
                paths, value=self.file_select.value if self.file_select.value in paths else None
            )
        self.file_select.set_visibility(bool(paths))
        if self.file_select.value is None and paths:
            self.file_select.set_value(paths[0])
        self._show_file()

    def _show_file(self) -> None:
        file = self.file
        self.note.set_text(self.preview.note)
        self.note.set_visibility(bool(self.note.text))
        if file is not None and file.language in LANGUAGES:
            self.editor.set_language(LANGUAGES[file.language].editor_mode)
        self.editor.set_value(file.text if file else "")
        self._mark_edits()
        self.highlighted = None
        self._highlight_selection()

    def _mark_edits(self) -> None:
        waiting = self.context.document.shared.outside.waiting
        lines = self.file.region_lines({edit.region.target for edit in waiting}) if self.file else ()
        self.code_assist.set_line_styles((line, "is-edited") for line in lines)

    def _highlight_selection(self) -> None:
        file, item = self.file, self.context.single_selection
        highlighted = (item, file)
        if highlighted == self.highlighted:
            return
        self.highlighted = highlighted
        first, last = file.item_lines(item) if file and item else (0, 0)
        self.code_assist.highlight_lines(first, last, reveal=True)

    def _select_at(self, line: int) -> None:
        item = self.file.item_at(line) if self.file else None
        if item is None or item == self.context.single_selection or item.kind == "design":
            return
        # Do not scroll the code while the user reads it.
        self.highlighted = (item, self.file)
        first, last = self.file.item_lines(item) if self.file else (0, 0)
        self.code_assist.highlight_lines(first, last, reveal=False)
        self.context.show(item)
