"""Small buttons that stand in rows."""

from collections.abc import Callable

from nicegui import ui

ClickHandler = Callable[[], object]


def icon_button(icon: str, label: str, act: ClickHandler, *, keys: str = "") -> ui.button:
    """A button with only an icon; `label` is its name for screen readers, and with its keys its tip."""
    # Without a colour of Quasar's, which would overrule that of the place it stands in.
    button = ui.button(icon=icon, on_click=act, color=None).props("flat dense round size=sm").classes("icon-button")
    # Set, not written into a text of props: labels hold names, and a quote in a name would begin another prop.
    button.props["aria-label"] = label
    with button:
        ui.tooltip(f"{label} ({keys})" if keys else label)
    return button


def primary_button(label: str, act: ClickHandler, *, icon: str | None = None) -> ui.button:
    """The one button of its place that most people want."""
    # Without a colour of Quasar's, whose white text would be too pale on the light blue of a dark page.
    return ui.button(label, icon=icon, on_click=act, color=None).props("unelevated no-caps").classes("primary-button")


def reorder_buttons(
    row_label: str, *, up: ClickHandler | None, down: ClickHandler | None, remove: ClickHandler
) -> None:
    """Buttons to move a row and to remove it; None: at that end already. `row_label` says for the ear which row it is."""
    with ui.row().classes("row-buttons"):
        for icon, label, act in (("arrow_upward", "Earlier", up), ("arrow_downward", "Later", down)):
            button = icon_button(icon, label, act or (lambda: None))
            button.props["aria-label"] = f"{label}: {row_label}"
            if act is None:
                button.disable()
        icon_button("close", "Remove", remove).props["aria-label"] = f"Remove: {row_label}"


def add_button(label: str, accessible_name: str, act: ClickHandler | None = None, *, icon: str = "add") -> ui.button:
    """A small button below what it adds to; `accessible_name` says for the ear what it adds, and holds the label."""
    button = ui.button(label, icon=icon, on_click=act).props("flat dense no-caps size=sm")
    button.props["aria-label"] = accessible_name
    return button


def heading(text: str, *, hint: str = "") -> None:
    """A heading inside a panel."""
    with ui.row().classes("heading"):
        ui.label(text).props("role=heading aria-level=3")
        if hint:
            ui.label(hint).classes("heading-hint")


def panel_title(
    text: str, name: str = "", act: ClickHandler | None = None, *, is_visually_hidden: bool = False
) -> None:
    """What a panel is about: words and a name, which leads somewhere if there is something to do."""
    look = "visually-hidden" if is_visually_hidden else "panel-title"
    with ui.row().classes(look).props("role=heading aria-level=2"):
        ui.label(text)
        if act is not None:
            ui.link(name, "#").classes("mono").on("click.prevent", act)
        elif name:
            ui.label(name).classes("mono")
