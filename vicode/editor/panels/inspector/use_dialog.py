"""The dialog to add a component: filtered by name; Enter adds the first match."""

from collections.abc import Callable, Sequence

from nicegui import ui

from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.texts import NO_SUCH_COMPONENT
from vicode.model.project import Interface


def ask_for_component(interfaces: Sequence[Interface], on_chosen: Callable[[str], None]) -> None:
    """Open the dialog; `on_chosen` is called with the name of the selected component."""
    with titled_dialog("Add component", "use-dialog") as dialog:
        name = (
            ui.input("Component", placeholder="Filter by name")
            .props("outlined dense stack-label autofocus")
            .classes("full")
        )
        rows = ui.element("div").classes("choices")

    def matching() -> list[Interface]:
        part = name.value.strip().casefold()
        return [each for each in interfaces if part in each.component.casefold()]

    def choose(component: str) -> None:
        dialog.close()
        on_chosen(component)

    def show() -> None:
        rows.clear()
        with rows:
            for each in matching():
                _row(each, choose)
            if not matching():
                ui.label(NO_SUCH_COMPONENT).classes("empty")

    def choose_first() -> None:
        if found := matching():
            choose(found[0].component)

    name.on_value_change(show)
    name.on("keydown.enter", choose_first)
    dialog.on("hide", dialog.delete)
    show()


def _row(interface: Interface, choose: Callable[[str], None]) -> None:
    row = ui.element("button").props('type="button"').classes("choice")
    row.on("click", lambda: choose(interface.component))
    with row:
        ui.label(interface.component).classes("mono")
        ui.label(interface.doc.partition(". ")[0]).classes("small choice-doc")
