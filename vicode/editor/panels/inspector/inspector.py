"""The inspector: a form for the selected item, or for the design if nothing is selected."""

from nicegui import ui

from vicode.editor.panels.inspector.item_forms import ItemForms
from vicode.editor.panels.inspector.link_panel import link_panel
from vicode.editor.panels.inspector.multi_selection_panel import multi_selection_panel
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.view import ItemRef

_FOCUS_CANVAS = '() => document.querySelector(".canvas")?.shadowRoot?.querySelector(".stage")?.focus()'


class Inspector:
    """The forms, which the browser draws, and the panels of several items and of links."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context
        self._shown: tuple[ItemRef, ...] = ()
        self._forms = ItemForms(context)
        self._panel = ui.element("div").classes("inspector")
        self._panel.on("keydown.escape", js_handler=_FOCUS_CANVAS)

    def refresh(self) -> None:
        self._forms.refresh()
        selected = self.context.selected
        if selected != self._shown:
            self._shown = selected
            self._panel.clear()
            with self._panel:
                self._build(selected)

    def _build(self, selected: tuple[ItemRef, ...]) -> None:
        match selected:
            case (_, _, *_):
                multi_selection_panel(self.context)
            case (ItemRef(kind="links", id=key),):
                link_panel(self.context, key)
            case _:
                pass
