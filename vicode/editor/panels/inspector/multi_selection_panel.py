"""The panel for several selected items: commands for all of them."""

from collections import Counter
from functools import partial

from nicegui import ui

from vicode.editor.panels.inspector.color_choice import color_choice
from vicode.editor.panels.widgets import heading, icon_button, panel_title
from vicode.editor.panels.window_context import WindowContext

_NOUNS = {
    "states": ("state", "states"),
    "transitions": ("transition", "transitions"),
    "components": ("component", "components"),
    "links": ("link", "links"),
    "common": ("common part", "common parts"),
    "frames": ("frame", "frames"),
    "notes": ("note", "notes"),
}
_ALIGN = (
    ("align-left", "align_horizontal_left", "Align left edges (Alt+A)"),
    ("align-center", "align_horizontal_center", "Align centers (Alt+H)"),
    ("align-right", "align_horizontal_right", "Align right edges (Alt+D)"),
    ("align-top", "align_vertical_top", "Align top edges (Alt+W)"),
    ("align-middle", "align_vertical_center", "Align middles (Alt+V)"),
    ("align-bottom", "align_vertical_bottom", "Align bottom edges (Alt+S)"),
)
_DISTRIBUTE = (
    ("distribute-across", "horizontal_distribute", "Distribute horizontally (Alt+Shift+H)"),
    ("distribute-down", "vertical_distribute", "Distribute vertically (Alt+Shift+V)"),
)
_EDIT = (
    ("duplicate", "content_copy", "Duplicate (Ctrl+D)"),
    ("disable", "block", "Disable or enable (D)"),
    ("zoom-selection", "zoom_in_map", "Zoom to selection (2)"),
    ("delete", "delete", "Delete (Delete)"),
)


def multi_selection_panel(context: WindowContext) -> None:
    counts: Counter[str] = Counter(item.kind for item in context.selected)
    parts = [f"{counts[kind]} {nouns[counts[kind] > 1]}" for kind, nouns in _NOUNS.items() if counts[kind]]
    panel_title(", ".join(parts) + " selected")
    node_count = sum(counts[kind] for kind in ("states", "components", "common", "notes"))
    if node_count > 1:
        heading("Align")
        _row(context, _ALIGN)
    if node_count > 2:
        heading("Distribute")
        _row(context, _DISTRIBUTE)
    heading("Edit")
    _row(context, _EDIT)
    if counts["states"] or counts["frames"]:
        color_choice(context, lambda: context.selected)


def _row(context: WindowContext, buttons: tuple[tuple[str, str, str], ...]) -> None:
    with ui.row().classes("multi-selection-row"):
        for command, icon, label in buttons:
            icon_button(icon, label, partial(context.page.run_canvas_command, command))
