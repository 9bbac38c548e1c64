"""The panel of a link to a used component."""

from nicegui import ui

from vicode.editor.panels.widgets import panel_title
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.view import ItemRef
from vicode.model.edits import remove_link


def link_panel(context: WindowContext, key: str) -> None:
    kind, state, alias = key.split("/")
    panel_title(f"{state} {kind}", alias)
    ui.button("Go to state", on_click=lambda: context.select(ItemRef(kind="states", id=state))).props(
        "flat dense no-caps"
    )

    def remove() -> None:
        context.edit(
            f"unlink {alias} from {state}",
            lambda design: remove_link(design, state, alias, modulates=kind == "modulates"),
        )
        context.select()

    ui.button("Remove", icon="delete", on_click=remove).props("flat dense no-caps color=negative")
