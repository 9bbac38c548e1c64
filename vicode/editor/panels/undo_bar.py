"""A bar at the foot of the page that says what was done, with a button that takes it back."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.widgets import icon_button


class UndoBar:
    """Shows the newest offer until it is taken, dismissed, or another one comes."""

    def __init__(self) -> None:
        """Build it hidden."""
        self._undo_action: Callable[[], object] = lambda: None
        with ui.element("div").classes("undo-bar").props('role="status"') as self._bar:
            self._words = ui.label()
            # Without a colour of Quasar's, which is too dark to be read on the bar of a light page.
            ui.button("Undo", on_click=self._undo, color=None).props("flat no-caps dense")
            icon_button("close", "Dismiss", self._hide)
        self._hide()

    def show(self, text: str, undo: Callable[[], object]) -> None:
        """Say what was done; `undo` takes it back."""
        self._undo_action = undo
        self._words.set_text(text)
        self._bar.set_visibility(True)

    def _undo(self) -> None:
        self._hide()
        self._undo_action()

    def _hide(self) -> None:
        self._bar.set_visibility(False)
