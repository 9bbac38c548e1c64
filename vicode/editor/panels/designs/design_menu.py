"""The menu of a design: opened by a button, or by a right click on its card."""

from nicegui import ui

from vicode.editor.panels.designs.design_dialogs import DesignDialogs
from vicode.editor.panels.widgets import icon_button
from vicode.editor.session import Workspace


def add_design_menu(workspace: Workspace, component: str, dialogs: DesignDialogs, area: ui.element) -> None:
    """Add the button; a right click within `area` opens the same menu.

    The menu is built when it is first opened, as a folder may have many designs.
    """
    menus: list[ui.menu] = []

    def show() -> None:
        if not menus:
            with button:
                menus.append(_menu(workspace, component, dialogs))
        menus[0].open()

    button = icon_button("more_vert", f"More for {component}", show).classes("more-button")
    button.props("aria-haspopup=menu")
    area.on("contextmenu.prevent", show)


def _menu(workspace: Workspace, component: str, dialogs: DesignDialogs) -> ui.menu:
    # Without this, Quasar toggles the menu at each click on the button, too.
    with ui.menu().props("no-parent-event") as menu:
        for label, open_dialog in dialogs.menu_entries().items():
            ui.menu_item(label, lambda open_dialog=open_dialog: open_dialog(workspace, component)).props(
                "role=menuitem"
            )
    return menu
