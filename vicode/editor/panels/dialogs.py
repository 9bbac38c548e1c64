"""Dialogs with a title that is also their name for screen readers."""

from collections.abc import Iterator
from contextlib import contextmanager

from nicegui import ui


@contextmanager
def titled_dialog(title: str, css_class: str = "") -> Iterator[ui.dialog]:
    """A dialog to be filled, with a style class of its own if it has a look of its own; it opens when it is left.

    It stays when what was pressed for it is built anew, as a change by somebody else does.
    """
    with ui.context.client.content, ui.dialog() as dialog, ui.card().classes(f"dialog {css_class}"):
        # Set, not written into a text of props: titles hold names.
        dialog.props["aria-label"] = title
        ui.label(title).classes("dialog-title").props("role=heading aria-level=2")
        yield dialog
    dialog.open()
