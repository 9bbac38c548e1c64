"""The bar at the top: where one is, what is unsaved, undo and redo, save and generate."""

from collections.abc import Callable
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.fields import enable
from vicode.editor.panels.rows import icon_button, primary_button

Act = Callable[[], object]


@dataclass(frozen=True, slots=True, kw_only=True)
class Commands:
    """What the buttons do."""

    save: Act
    generate: Act
    lay_out: Act
    toggle_links: Act
    toggle_theme: Act


class Header:
    """Builds the bar; `refresh` keeps its labels true."""

    def __init__(self, desk: Desk, commands: Commands) -> None:
        """Build it."""
        self.desk = desk
        with ui.element("header").classes("head"):
            ui.label("vicode").classes("brand")
            with ui.row().classes("crumbs").props('role="heading" aria-level="1"'):
                ui.label(desk.workspace.project.name).classes("crumb")
                ui.label("/").classes("crumb-sep").props('aria-hidden="true"')
                ui.label(desk.design.component).classes("crumb here")
            self.saved = ui.label().classes("saved").props('role="status"')
            ui.element("div").classes("spacer")
            self.undo = icon_button("undo", "Undo", desk.document.undo)
            self.redo = icon_button("redo", "Redo", desk.document.redo)
            icon_button("auto_awesome_mosaic", "Lay out what is selected, or everything", commands.lay_out)
            icon_button("hub", "Show or hide links to components", commands.toggle_links)
            icon_button("contrast", "Light, dark, or as the system", commands.toggle_theme)
            ui.button("Save", icon="save", on_click=commands.save).props("flat no-caps dense").classes("head-button")
            primary_button("Generate", commands.generate, icon="bolt")

    def refresh(self) -> None:
        """Show whether it is saved and what undo and redo would do."""
        document = self.desk.document
        text = "Saved" if document.is_saved else "Unsaved changes"
        if self.saved.text != text:
            self.saved.set_text(text)
            self.saved.classes(remove="is-unsaved") if document.is_saved else self.saved.classes("is-unsaved")
        for button, label, word in (
            (self.undo, document.history.undo_label, "Undo"),
            (self.redo, document.history.redo_label, "Redo"),
        ):
            enable(button, flag=bool(label))
            button.props(f'aria-label="{word}"')
