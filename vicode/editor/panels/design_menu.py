"""What can be done with a design as a whole, as a menu: by its button, or by a right click on what stands for it."""

from nicegui import ui

from vicode.editor.panels.design_dialogs import DesignDialogs
from vicode.editor.panels.rows import icon_button
from vicode.editor.session import Workspace


def add_design_menu(workspace: Workspace, component: str, dialogs: DesignDialogs) -> None:
    """Add the button with its menu, and the same menu for right clicks on the current slot."""
    with icon_button("more_vert", f"More for {component}", lambda: None).classes("more-button"), ui.menu():
        _items(workspace, component, dialogs)
    with ui.context_menu():
        _items(workspace, component, dialogs)


def _items(workspace: Workspace, component: str, dialogs: DesignDialogs) -> None:
    asked = (
        ("Rename everywhere…", dialogs.ask_name),
        ("Duplicate…", dialogs.ask_copy),
        ("Move to trash…", dialogs.ask_removal),
    )
    for label, ask in asked:
        ui.menu_item(label, lambda ask=ask: ask(workspace, component)).props('role="menuitem"')
