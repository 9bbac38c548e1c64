"""The form of a note."""

from nicegui import ui

from vicode.editor.panels.fields import Attribute, FieldKind, attribute_field
from vicode.editor.panels.form import Form
from vicode.editor.panels.widgets import panel_title
from vicode.model.diagram_edits import remove_notes

_TEXT = Attribute(label="Text", name="text", kind=FieldKind.LONG_TEXT)


def note_panel(form: Form, name: str) -> None:
    context = form.context

    def remove() -> None:
        context.edit("remove note", lambda design: remove_notes(design, [name]))
        context.select()

    panel_title("Note")
    with ui.element("div").classes("note-text full"):
        attribute_field(form, form.item("notes", name), _TEXT)
    ui.button("Remove", icon="delete", on_click=remove).props("flat dense no-caps color=negative").classes("remove")
