"""Dialogs whose title is also their accessible name."""

from collections.abc import Iterator
from contextlib import contextmanager

from nicegui import ui


@contextmanager
def titled_dialog(title: str, css_class: str = "") -> Iterator[ui.dialog]:
    """Create a dialog; the body of the context manager builds its content, then it opens.

    The dialog is a child of the page: it stays open when the panel of the button that opened it is rebuilt.
    """
    with ui.context.client.content, ui.dialog() as dialog, ui.card().classes(f"dialog {css_class}"):
        # Not through `props(text)`, as titles contain names with arbitrary characters.
        dialog.props["aria-label"] = title
        ui.label(title).classes("dialog-title").props("role=heading aria-level=2")
        yield dialog
    dialog.open()
