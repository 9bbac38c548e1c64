"""The code generated from the open design, as it is typed; nothing is written to disk here."""

from nicegui import background_tasks, run, ui

from vicode.editor.code import CodeAid
from vicode.editor.panels.desk import Desk
from vicode.editor.session import preview


class CodePanel:
    """A read-only view of the generated Python."""

    def __init__(self, desk: Desk) -> None:
        """Build it; `refresh` fills it."""
        self.desk = desk
        self.shown_rev = -1
        self.is_busy = False
        with ui.column().classes("code-panel"):
            self.note = ui.label().classes("code-note mono")
            self.editor = desk.code_editors.make().classes("preview")
            self.editor.disable()
            CodeAid(self.editor, label="Generated code")

    def refresh(self) -> None:
        """Generate anew if the design has changed since."""
        if not self.is_busy and self.shown_rev != self.desk.document.rev:
            self.is_busy = True
            background_tasks.create(self._follow(), name="preview")

    def _preview(self) -> preview.Preview:
        workspace = self.desk.workspace
        return preview.preview_of(workspace.project, self.desk.design, workspace.sources)

    async def _follow(self) -> None:
        """Generate beside the event loop until the newest design is shown."""
        try:
            while self.shown_rev != self.desk.document.rev:
                self.shown_rev = self.desk.document.rev
                shown = await run.io_bound(self._preview)
                # Nothing comes back while the server is shutting down.
                if shown is None or self.editor.is_deleted:
                    return
                self.note.set_text(shown.note)
                self.editor.set_value(shown.text)
        finally:
            self.is_busy = False
