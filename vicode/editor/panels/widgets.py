"""Buttons, headings and titles of panels."""

from collections.abc import Callable

from nicegui import ui

ClickHandler = Callable[[], object]


def icon_button(icon: str, label: str, act: ClickHandler, *, keys: str = "") -> ui.button:
    """Build an icon button; `label` is its accessible name, and with `keys` its tooltip."""
    # Without Quasar's color, which would override the color of the surrounding element.
    button = ui.button(icon=icon, on_click=act, color=None).props("flat dense round size=sm").classes("icon-button")
    # Not through `props(text)`: a quote in a name would start another prop.
    button.props["aria-label"] = label
    with button:
        ui.tooltip(f"{label} ({keys})" if keys else label)
    return button


def primary_button(label: str, act: ClickHandler, *, icon: str | None = None) -> ui.button:
    """Build the default button of a dialog or panel."""
    # Without Quasar's color, whose white text lacks contrast on the light blue of a dark page.
    return ui.button(label, icon=icon, on_click=act, color=None).props("unelevated no-caps").classes("primary-button")


def add_button(label: str, accessible_name: str, act: ClickHandler | None = None, *, icon: str = "add") -> ui.button:
    """Build a small button below a list; `accessible_name` must contain `label`."""
    button = ui.button(label, icon=icon, on_click=act).props("flat dense no-caps size=sm")
    button.props["aria-label"] = accessible_name
    return button


def heading(text: str, *, hint: str = "") -> None:
    with ui.row().classes("heading"):
        ui.label(text).props("role=heading aria-level=3")
        if hint:
            ui.label(hint).classes("heading-hint")


def panel_title(
    text: str, name: str = "", act: ClickHandler | None = None, *, is_visually_hidden: bool = False
) -> None:
    """Build the title of a panel: a text and a name, which is a link if there is an action."""
    look = "visually-hidden" if is_visually_hidden else "panel-title"
    with ui.row().classes(look).props("role=heading aria-level=2"):
        ui.label(text)
        if act is not None:
            ui.link(name, "#").classes("mono").on("click.prevent", act)
        elif name:
            ui.label(name).classes("mono")
