"""The page of a file that is not a valid design: a text editor with the errors."""

from pathlib import Path

from nicegui import ui

from vicode.editor.code import CodeAssist
from vicode.editor.pages.delivery import open_inbox
from vicode.editor.pages.navigation import HOME
from vicode.editor.pages.shortcuts import register_shortcuts
from vicode.editor.pages.theme import Theme, apply_theme
from vicode.editor.panels.code.code_editor import CodeEditorFactory
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.designs.design_dialogs import DesignDialogs
from vicode.editor.panels.designs.designs_list import DesignsList
from vicode.editor.panels.texts import pluralize
from vicode.editor.panels.toasts import show_toast
from vicode.editor.panels.undo_bar import UndoBar
from vicode.editor.panels.versions.merge_conflicts import MergeConflictList
from vicode.editor.panels.widgets import primary_button
from vicode.editor.session import Library, Workspace
from vicode.editor.session.recovery.broken_file import (
    FileModifiedError,
    ParsedText,
    parse_text,
    read_file_text,
    write_fixed_text,
)
from vicode.editor.view.page_urls import design_url


class BrokenPage:
    """One window on the text of a file, checked as the user types."""

    def __init__(self, library: Library, workspace: Workspace, file: Path, name: str) -> None:
        self.workspace, self.file, self.name = workspace, file, name
        self.disk_text = ""
        editors = CodeEditorFactory()
        Theme(editors, apply_theme())
        with ui.element("div").classes("shell broken-shell"):
            head = ui.element("header").classes("head")
            DesignsList(library, DesignDialogs(show_toast=show_toast, offer_undo=UndoBar().show))
            with ui.element("main").classes("design-view broken-view"):
                self.title = ui.label(name).classes("dialog-title").props("role=heading aria-level=1")
                self.note = ui.label().classes("small").props("role=status")
                self.conflicts = MergeConflictList(lambda: str(self.editor.value or ""), self._replace_text)
                self.editor = editors.create(language="YAML").classes("code-field broken-text")
                self.code_assist = CodeAssist(self.editor, label=f"Text of {name}")
                self.messages = ui.column().classes("field-messages broken-messages")
        with head:
            ui.link("vicode", "/").classes("brand")
            ui.element("div").classes("spacer")
            primary_button("Save", self.save, icon="save")
        save = Command("save", "Save", self.save, MenuGroup.DESIGN, keys=("Ctrl+S",), while_typing=True)
        register_shortcuts((save,), open_inbox())
        self._open()
        self.editor.on_value_change(self._check)

    def save(self) -> None:
        """Write the text; open the design if it is valid."""
        text = str(self.editor.value or "")
        try:
            write_fixed_text(self.file, text, self.disk_text)
            self.workspace.sync_from_disk()
        except FileModifiedError:
            show_toast(f"{self.name} was changed by another program. Reload the page.", "warning")
            return
        except OSError as error:
            show_toast(f"Could not save: {error.strerror}", "negative")
            return
        self.disk_text = text
        parsed = self._check()
        component = parsed.component
        if parsed.is_sound_project:
            ui.navigate.to(HOME)
        elif component and self.workspace.files.get(component, Path()).resolve() == self.file.resolve():
            ui.navigate.to(design_url(self.workspace.key, component))
        else:
            show_toast("Saved, but the file cannot be opened as a design yet", "warning")

    def _open(self) -> None:
        try:
            self.disk_text = read_file_text(self.file)
        except UnicodeDecodeError as error:
            self.editor.disable()
            self.note.set_text(f"Not valid UTF-8 (byte {error.start}). Convert the file to UTF-8.")
            return
        except OSError as error:
            self.editor.disable()
            self.note.set_text(f"Cannot read the file: {error.strerror}")
            return
        self.editor.set_value(self.disk_text)
        self._check()

    def _replace_text(self, text: str) -> None:
        self.editor.set_value(text)
        self._check()

    def _check(self) -> ParsedText:
        text = str(self.editor.value or "")
        self.conflicts.refresh()
        parsed = parse_text(text, self.name)
        self.code_assist.show_marks(text, parsed.marks)
        count = len(parsed.findings)
        self.note.set_text(pluralize(count, "error") if count else "No errors. Save to open the design.")
        self.messages.clear()
        with self.messages:
            for mark in parsed.marks[:50]:
                button = ui.element("button").classes(f"field-message {mark.severity}").props('type="button"')
                with button:
                    column = mark.start - text.rfind("\n", 0, mark.start)
                    ui.label(f"Line {mark.line}, column {column}: {mark.message}")
                button.on("click", lambda mark=mark: self.code_assist.go_to(mark.start))
        return parsed
