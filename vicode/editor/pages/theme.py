"""The look of the pages: one style sheet, read once a page, and light or dark as the person or the system wants it."""

import json
from pathlib import Path

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.panels.code_editor import CodeEditorFactory

_SHEET = Path(__file__).parent / "theme.css"
_ABOUT = "vicode: state machines of robots, drawn, checked, simulated and turned into code"
_COOKIE = "vicode_colours"
_MODES = {"dark": True, "light": False}
_NEXT = {None: True, True: False, False: None}
_WORDS = {None: "Colours follow the system", True: "Dark colours", False: "Light colours"}
_REPORT_SYSTEM_MODE = """
const query = matchMedia("(prefers-color-scheme: dark)");
const tell = () => emitEvent("system-dark", query.matches);
query.addEventListener("change", tell);
tell();
"""
# What a browser paints before any style sheet or script has come: nobody who chose dark is dazzled by white.
_LIGHT = "html { background: #f8fafc; color-scheme: light; }"
_DARK = "html { background: #11161e; color-scheme: dark; }"
_FIRST_PAINT = {
    None: f"{_LIGHT} @media (prefers-color-scheme: dark) {{ {_DARK} }}",
    True: _DARK,
    False: _LIGHT,
}


def apply_theme() -> ui.dark_mode:
    """Give the page its style sheet and its colours; returns what switches between light and dark."""
    request = ui.context.client.request
    chosen = _MODES.get(request.cookies.get(_COOKIE, ""))
    ui.add_head_html(f'<style>{_FIRST_PAINT[chosen]}</style><meta name="description" content="{_ABOUT}">')
    ui.colors(primary="#1d4ed8", negative="#b91c1c", positive="#166534", warning="#92400e", info="#1d4ed8")
    ui.add_css(_SHEET.read_text(encoding="utf-8"))
    _replace_main_tag()
    return ui.dark_mode(chosen)


def _replace_main_tag() -> None:
    """Make a plain box of the `main` that NiceGUI lays around a page, as ours have a `main` of their own."""
    slot = ui.context.client.content.parent_slot
    assert slot is not None
    slot.parent.tag = "div"


class Theme:
    """Light or dark in one window: what was chosen, else what the system prefers."""

    def __init__(self, code_editors: CodeEditorFactory, mode: ui.dark_mode) -> None:
        """Follow the choice this browser remembers, else the system."""
        self._mode = mode
        self._code_editors = code_editors
        self._system_is_dark = False
        ui.on("system-dark", self._on_system_mode)
        ui.timer(0.05, lambda: ui.run_javascript(_REPORT_SYSTEM_MODE), once=True)
        self._show()

    def toggle(self) -> str:
        """Go on to the next of system, dark and light; returns its name."""
        self._mode.set_value(_NEXT[self._mode.value])
        name = next((name for name, mode in _MODES.items() if mode is self._mode.value), "system")
        cookie = f"{_COOKIE}={name}; path=/; max-age=31536000; samesite=strict"
        ui.run_javascript(f"document.cookie = {json.dumps(cookie)}")
        self._show()
        return _WORDS[self._mode.value]

    def _on_system_mode(self, event: GenericEventArguments) -> None:
        self._system_is_dark = bool(event.args)
        self._show()

    def _show(self) -> None:
        chosen = self._mode.value
        self._code_editors.set_dark(is_dark=self._system_is_dark if chosen is None else chosen)
