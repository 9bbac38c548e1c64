"""Asks which component is to be used: type a part of its name, Enter takes the first that fits."""

from collections.abc import Callable, Sequence

from nicegui import ui

from vicode.editor.panels.dialogs import titled_dialog
from vicode.model.project import Interface


def ask_for_component(interfaces: Sequence[Interface], on_chosen: Callable[[str], None]) -> None:
    """Show the components of a project; `on_chosen` is called with the name of the chosen one."""
    with titled_dialog("Use a component", "use-dialog") as dialog:
        wanted = (
            ui.input("Component", placeholder="a part of its name")
            .props("outlined dense stack-label autofocus")
            .classes("full")
        )
        rows = ui.element("div").classes("choices")

    def fitting() -> list[Interface]:
        part = wanted.value.strip().casefold()
        return [each for each in interfaces if part in each.component.casefold()]

    def choose(component: str) -> None:
        dialog.close()
        on_chosen(component)

    def show() -> None:
        rows.clear()
        with rows:
            for each in fitting():
                _row(each, choose)
            if not fitting():
                ui.label("No component of this project is called so.").classes("empty")

    def choose_first() -> None:
        if found := fitting():
            choose(found[0].component)

    wanted.on_value_change(show)
    wanted.on("keydown.enter", choose_first)
    dialog.on("hide", dialog.delete)
    show()


def _row(interface: Interface, choose: Callable[[str], None]) -> None:
    row = ui.element("button").props('type="button"').classes("choice")
    row.on("click", lambda: choose(interface.component))
    with row:
        ui.label(interface.component).classes("mono")
        ui.label(interface.doc.partition(". ")[0]).classes("small choice-doc")
