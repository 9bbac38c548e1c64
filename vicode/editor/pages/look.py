"""The look of the pages: one style sheet, read once a page."""

from pathlib import Path

from nicegui import ui

_SHEET = Path(__file__).parent / "look.css"


def add_look() -> None:
    """Give the page its style sheet."""
    ui.add_css(_SHEET.read_text(encoding="utf-8"))
