"""The page of a file that cannot be read as a design: its text, what is wrong where, and a way to mend it."""

from pathlib import Path

from nicegui import ui

from vicode.editor.code import CodeAid
from vicode.editor.pages.keys import listen_to_keys
from vicode.editor.pages.look import Theme, add_look
from vicode.editor.panels.code_editor import CodeEditors
from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.design_dialogs import DesignDialogs
from vicode.editor.panels.designs_list import DesignsList
from vicode.editor.panels.messages import say
from vicode.editor.panels.rows import primary_button
from vicode.editor.panels.undo_bar import UndoBar
from vicode.editor.session import Library, Workspace
from vicode.editor.session.broken import ChangedMeanwhileError, Reading, open_text, read_text, write_mended
from vicode.editor.view.address import design_address


class BrokenPage:
    """One window on the text of a file; it is checked while it is typed, and written when it is saved."""

    def __init__(self, library: Library, workspace: Workspace, file: Path, name: str) -> None:
        """Build the page for the browser that asks for it."""
        self.workspace, self.file, self.name = workspace, file, name
        self.opened = ""
        editors = CodeEditors()
        Theme(editors, add_look())
        with ui.element("div").classes("shell broken-shell"):
            head = ui.element("header").classes("head")
            DesignsList(library, (workspace.key, ""), DesignDialogs(say=say, offer_undo=UndoBar().offer))
            with ui.element("main").classes("stage broken-stage"):
                self.title = ui.label(name).classes("dialog-title").props("role=heading aria-level=1")
                self.note = ui.label().classes("small").props("role=status")
                self.editor = editors.make(language="YAML").classes("code-field broken-text")
                self.aid = CodeAid(self.editor, label=f"Text of {name}")
                self.messages = ui.column().classes("field-messages broken-messages")
        with head:
            ui.link("vicode", "/").classes("brand")
            ui.element("div").classes("spacer")
            primary_button("Save", self.save, icon="save")
        save = Command("save", "Save", self.save, Place.DESIGN, keys=("Ctrl+S",), while_typing=True)
        listen_to_keys((save,))
        self._open()
        self.editor.on_value_change(self._check)

    def save(self) -> None:
        """Write the text; once it can be read, the design is opened."""
        text = str(self.editor.value or "")
        try:
            write_mended(self.file, text, self.opened)
            self.workspace.follow_disk()
        except ChangedMeanwhileError:
            say(f"{self.name} was changed by another program: reload the page to see its text", "warning")
            return
        except OSError as error:
            say(f"Not saved: {error.strerror}", "negative")
            return
        self.opened = text
        component = self._check().component
        if component and self.workspace.files.get(component, Path()).resolve() == self.file.resolve():
            ui.navigate.to(design_address(self.workspace.key, component))
        else:
            say("Saved; it cannot be opened as a design yet", "warning")

    def _open(self) -> None:
        try:
            self.opened = open_text(self.file)
        except UnicodeDecodeError as error:
            self.editor.disable()
            self.note.set_text(
                f"This is no UTF-8 text (byte {error.start}): save it as UTF-8 in the program it comes from."
            )
            return
        except OSError as error:
            self.editor.disable()
            self.note.set_text(f"It cannot be read: {error.strerror}")
            return
        self.editor.set_value(self.opened)
        self._check()

    def _check(self) -> Reading:
        text = str(self.editor.value or "")
        reading = read_text(text, self.name)
        self.aid.show_marks(text, reading.marks)
        count = len(reading.findings)
        mistakes = f"{count} mistake{'s' * (count != 1)}" if count else "No mistakes: save it to open the design"
        self.note.set_text(mistakes)
        self.messages.clear()
        with self.messages:
            for mark in reading.marks[:50]:
                button = ui.element("button").classes(f"field-message {mark.severity}").props('type="button"')
                with button:
                    column = mark.start - text.rfind("\n", 0, mark.start)
                    ui.label(f"Line {mark.line}, column {column}: {mark.message}")
                button.on("click", lambda mark=mark: self.aid.go_to(mark.start))
        return reading
