"""Opens a design in the window: in place if the page can, else by loading its page."""

import json

from nicegui import ui


def open_design(url: str) -> None:
    """Show the design with this URL in the current window; see pages/design_navigation.js."""
    ui.run_javascript(f"(window.openDesign ?? ((url) => location.assign(url)))({json.dumps(url)})")
