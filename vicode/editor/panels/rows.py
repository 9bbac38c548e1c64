"""Small buttons that stand in rows."""

from collections.abc import Callable

from nicegui import ui

Act = Callable[[], object]


def icon_button(icon: str, label: str, act: Act, *, keys: str = "") -> ui.button:
    """A button with only an icon; `label` is its name for screen readers, and with its keys its tip."""
    # Without a colour of Quasar's, which would overrule that of the place it stands in.
    button = ui.button(icon=icon, on_click=act, color=None).props("flat dense round size=sm").classes("icon-button")
    # Set, not written into a text of props: labels hold names, and a quote in a name would begin another prop.
    button.props["aria-label"] = label
    with button:
        ui.tooltip(f"{label} ({keys})" if keys else label)
    return button


def primary_button(label: str, act: Act, *, icon: str | None = None) -> ui.button:
    """The one button of its place that most people want."""
    # Without a colour of Quasar's, whose white text would be too pale on the light blue of a dark page.
    return ui.button(label, icon=icon, on_click=act, color=None).props("unelevated no-caps").classes("primary-button")


def row_of_buttons(*, up: Act | None, down: Act | None, remove: Act) -> None:
    """Buttons to move a row and to remove it; None: at that end already."""
    with ui.row().classes("row-buttons"):
        for icon, label, act in (("arrow_upward", "Earlier", up), ("arrow_downward", "Later", down)):
            button = icon_button(icon, label, act or (lambda: None))
            if act is None:
                button.disable()
        icon_button("close", "Remove", remove)


def heading(text: str, *, hint: str = "") -> None:
    """A heading inside a panel."""
    with ui.row().classes("heading"):
        ui.label(text).props("role=heading aria-level=2")
        if hint:
            ui.label(hint).classes("heading-hint")
