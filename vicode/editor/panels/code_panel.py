"""The code generated from the open design, as it is typed; nothing is written to disk here.

What is selected in the drawing is brought forward in the code, and a click in the code selects in the drawing.
"""

from nicegui import run, ui
from nicegui.elements.codemirror.constants import SUPPORTED_LANGUAGES

from vicode.editor.code import CodeAid
from vicode.editor.panels.desk import Desk
from vicode.editor.session import preview
from vicode.editor.session.preview import Preview, PreviewFile
from vicode.editor.view import Selected

_SHOWN_LANGUAGE: dict[str, SUPPORTED_LANGUAGES] = {"python": "Python", "cpp": "C++", "xabsl": "C"}
"""How code is coloured; of what the editor knows C is next to XABSL."""


class CodePanel:
    """A read-only view of every file that is generated for the design."""

    def __init__(self, desk: Desk) -> None:
        """Build it; `refresh` fills it."""
        self.desk = desk
        self.shown_rev = -1
        self.is_busy = False
        self.preview = Preview()
        self.marked: object = None
        with ui.column().classes("code-panel"):
            self.choice = ui.select([], on_change=self._show_file).props(
                'outlined dense options-dense aria-label="Generated file"'
            )
            self.choice.classes("code-choice mono")
            self.note = ui.label().classes("code-note").props('role="status"')
            self.editor = desk.code_editors.make().classes("preview")
            self.editor.disable()
            self.aid = CodeAid(self.editor, label="Generated code", on_line=self._select_at)

    def refresh(self) -> None:
        """Generate anew if the design has changed since, and bring what is selected forward."""
        if not self.is_busy and self.shown_rev != self.desk.document.rev:
            self.is_busy = True
            self.desk.begin(self._follow(), "preview")
        self._bring_forward()

    @property
    def file(self) -> PreviewFile | None:
        """The file that is shown."""
        return next((file for file in self.preview.files if file.path == self.choice.value), None)

    async def _follow(self) -> None:
        """Generate beside the event loop until the newest design is shown."""
        try:
            while self.shown_rev != self.desk.document.rev:
                self.shown_rev = self.desk.document.rev
                # What is asked for is taken here, not in the thread, where it could change meanwhile.
                workspace, design = self.desk.workspace, self.desk.design
                around = (workspace.sources, workspace.output_folder)
                shown = await run.io_bound(preview.preview_of, workspace.project, design, *around)
                # Nothing comes back while the server is shutting down.
                if shown is None or self.editor.is_deleted:
                    return
                self.preview = shown
                self._show()
        finally:
            self.is_busy = False

    def _show(self) -> None:
        paths = [file.path for file in self.preview.files]
        if paths != self.choice.options:
            self.choice.set_options(paths, value=self.choice.value if self.choice.value in paths else None)
        self.choice.set_visibility(bool(paths))
        if self.choice.value is None and paths:
            self.choice.set_value(paths[0])
        self._show_file()

    def _show_file(self) -> None:
        file = self.file
        edited = ", ".join(file.edited) if file else ""
        self.note.set_text(f"Edited by hand on disk: {edited}" if edited else self.preview.note)
        self.note.set_visibility(bool(self.note.text))
        if file is not None and file.language in _SHOWN_LANGUAGE:
            self.editor.set_language(_SHOWN_LANGUAGE[file.language])
        self.editor.set_value(file.text if file else "")
        self.aid.show_regions((line, "is-edited") for line in (file.edited_lines() if file else ()))
        self.marked = None
        self._bring_forward()

    def _bring_forward(self) -> None:
        file, thing = self.file, self.desk.only
        marked = (thing, file)
        if marked == self.marked:
            return
        self.marked = marked
        first, last = file.lines_of(thing) if file and thing else (0, 0)
        self.aid.show_lines(first, last, reveal=True)

    def _select_at(self, line: int) -> None:
        thing = self.file.thing_at(line) if self.file else None
        if thing is None or thing == self.desk.only or thing.of == "design":
            return
        # Who reads here is not to be moved away from the line.
        self.marked = (thing, self.file)
        first, last = self.file.lines_of(thing) if self.file else (0, 0)
        self.aid.show_lines(first, last, reveal=False)
        self.desk.select(thing)
        self.desk.reveal(Selected(of=thing.of, id=thing.id))
