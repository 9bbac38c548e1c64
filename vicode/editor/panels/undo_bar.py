"""A bar at the bottom of the page with a message and an undo button."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.widgets import icon_button


class UndoBar:
    """Shows the last message until it is undone, dismissed or replaced, or for some seconds (see theme.css)."""

    def __init__(self) -> None:
        self._undo_action: Callable[[], object] = lambda: None
        self._number = 0
        with ui.element("div").classes("undo-bar").props('role="status"') as self._bar:
            self._label = ui.label()
            # Quasar's color is too dark on the bar of a light page.
            ui.button("Undo", on_click=self._undo, color=None).props("flat no-caps dense")
            icon_button("close", "Dismiss", self._hide)
        self._hide()

    def show(self, text: str, undo: Callable[[], object], *, is_brief: bool = False) -> None:
        """Show a message; a brief one is for an edit that the undo history contains, too."""
        self._undo_action = undo
        self._number += 1
        # Another name starts the animation that hides the bar anew.
        self._bar.classes(remove="is-brief-0 is-brief-1", add=f"is-brief-{self._number % 2}" if is_brief else "")
        self._label.set_text(text)
        self._bar.set_visibility(True)

    def _undo(self) -> None:
        self._hide()
        self._undo_action()

    def _hide(self) -> None:
        self._bar.set_visibility(False)
