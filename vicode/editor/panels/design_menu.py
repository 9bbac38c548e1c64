"""What can be done with a design as a whole, as a menu: by its button, or by a right click on what stands for it."""

from nicegui import ui

from vicode.editor.panels.design_dialogs import DesignDialogs
from vicode.editor.panels.widgets import icon_button
from vicode.editor.session import Workspace


def add_design_menu(workspace: Workspace, component: str, dialogs: DesignDialogs, around: ui.element) -> None:
    """Add the button; a right click within `around` opens the same menu.

    The menu is made when it is first wanted: a folder has many designs, and few of them are renamed.
    """
    menus: list[ui.menu] = []

    def show() -> None:
        if not menus:
            with button:
                menus.append(_menu(workspace, component, dialogs))
        menus[0].open()

    button = icon_button("more_vert", f"More for {component}", show).classes("more-button")
    button.props("aria-haspopup=menu")
    around.on("contextmenu.prevent", show)


def _menu(workspace: Workspace, component: str, dialogs: DesignDialogs) -> ui.menu:
    asked = (
        ("Rename everywhere…", dialogs.ask_rename),
        ("Duplicate…", dialogs.ask_duplicate),
        ("Move to trash…", dialogs.ask_move_to_trash),
    )
    # Quasar would open it at each click on the button as well, and shut what was just opened.
    with ui.menu().props("no-parent-event") as menu:
        for label, ask in asked:
            ui.menu_item(label, lambda ask=ask: ask(workspace, component)).props("role=menuitem")
    return menu
