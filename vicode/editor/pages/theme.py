"""The theme of the pages: style sheet, and light or dark colors."""

import json
from pathlib import Path

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.panels.code.code_editor import CodeEditorFactory

_STYLE_SHEET = Path(__file__).parent / "theme.css"
_DESCRIPTION = "vicode: editor, checker, simulator and code generator for state machines of robots"
_COOKIE = "vicode_colors"
_MODES = {"dark": True, "light": False}
_NEXT = {None: True, True: False, False: None}
_NAMES = {None: "Theme: system", True: "Theme: dark", False: "Theme: light"}
_REPORT_SYSTEM_MODE = """
const query = matchMedia("(prefers-color-scheme: dark)");
const tell = () => emitEvent("system-dark", query.matches);
query.addEventListener("change", tell);
tell();
"""
# Background before style sheets and scripts have loaded, to avoid a white flash in dark mode.
_LIGHT = "html { background: #f8fafc; color-scheme: light; }"
_DARK = "html { background: #11161e; color-scheme: dark; }"
_FIRST_PAINT = {
    None: f"{_LIGHT} @media (prefers-color-scheme: dark) {{ {_DARK} }}",
    True: _DARK,
    False: _LIGHT,
}


def apply_theme() -> ui.dark_mode:
    """Add style sheet and colors to the page; return the element that switches between light and dark."""
    request = ui.context.client.request
    chosen = _MODES.get(request.cookies.get(_COOKIE, ""))
    ui.add_head_html(f'<style>{_FIRST_PAINT[chosen]}</style><meta name="description" content="{_DESCRIPTION}">')
    ui.colors(primary="#1d4ed8", negative="#b91c1c", positive="#166534", warning="#92400e", info="#1d4ed8")
    ui.add_css(_STYLE_SHEET.read_text(encoding="utf-8"))
    _replace_main_tag()
    return ui.dark_mode(chosen)


def _replace_main_tag() -> None:
    """Replace NiceGUI's `main` element around a page by a `div`, as our pages contain their own `main`."""
    slot = ui.context.client.content.parent_slot
    assert slot is not None
    slot.parent.tag = "div"


class Theme:
    """The theme of one window: the user's choice, else that of the system."""

    def __init__(self, code_editors: CodeEditorFactory, mode: ui.dark_mode) -> None:
        self._mode = mode
        self._code_editors = code_editors
        self._system_is_dark = False
        ui.on("system-dark", self._on_system_mode)
        ui.timer(0.05, lambda: ui.run_javascript(_REPORT_SYSTEM_MODE), once=True)
        self._show()

    def toggle(self) -> str:
        """Switch to the next theme (system, dark, light) and return its name."""
        self._mode.set_value(_NEXT[self._mode.value])
        name = next((name for name, mode in _MODES.items() if mode is self._mode.value), "system")
        cookie = f"{_COOKIE}={name}; path=/; max-age=31536000; samesite=strict"
        ui.run_javascript(f"document.cookie = {json.dumps(cookie)}")
        self._show()
        return _NAMES[self._mode.value]

    def _on_system_mode(self, event: GenericEventArguments) -> None:
        self._system_is_dark = bool(event.args)
        self._show()

    def _show(self) -> None:
        chosen = self._mode.value
        self._code_editors.set_dark(is_dark=self._system_is_dark if chosen is None else chosen)
