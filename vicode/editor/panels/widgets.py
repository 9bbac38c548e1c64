"""Buttons, headings and titles of panels."""

from collections.abc import Callable

from nicegui import ui
from nicegui.elements.mixins.disableable_element import DisableableElement

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


def heading(text: str) -> None:
    with ui.row().classes("heading"):
        ui.label(text).props("role=heading aria-level=3")


def panel_title(text: str, name: str = "") -> None:
    """Build the title of a panel: a text and a name."""
    with ui.row().classes("panel-title").props("role=heading aria-level=2"):
        ui.label(text)
        if name:
            ui.label(name).classes("mono")


def set_enabled(element: DisableableElement, *, flag: bool) -> None:
    """Enable or disable a button, without an update if nothing changed."""
    if element.enabled != flag:
        element.set_enabled(flag)
