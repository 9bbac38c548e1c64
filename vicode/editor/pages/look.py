"""The look of the pages: one style sheet, read once a page, and light or dark as the person or the system wants it."""

from pathlib import Path

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.panels.code_editor import CodeEditors

_SHEET = Path(__file__).parent / "look.css"
_NEXT = {None: True, True: False, False: None}
_WORDS = {None: "Colours follow the system", True: "Dark colours", False: "Light colours"}
_TELL_SYSTEM = """
const query = matchMedia("(prefers-color-scheme: dark)");
const tell = () => emitEvent("system-dark", query.matches);
query.addEventListener("change", tell);
tell();
"""


def add_look() -> None:
    """Give the page its style sheet."""
    ui.colors(primary="#1d4ed8", negative="#b91c1c", positive="#166534", warning="#92400e", info="#1d4ed8")
    ui.add_css(_SHEET.read_text(encoding="utf-8"))


class Theme:
    """Light or dark in one window: what was chosen, else what the system prefers."""

    def __init__(self, code_editors: CodeEditors) -> None:
        """Follow the system."""
        self._mode = ui.dark_mode(None)
        self._code_editors = code_editors
        self._system_is_dark = False
        ui.on("system-dark", self._hear_system)
        ui.timer(0.05, lambda: ui.run_javascript(_TELL_SYSTEM), once=True)

    def toggle(self) -> str:
        """Go on to the next of system, dark and light; returns its name."""
        self._mode.set_value(_NEXT[self._mode.value])
        self._show()
        return _WORDS[self._mode.value]

    def _hear_system(self, event: GenericEventArguments) -> None:
        self._system_is_dark = bool(event.args)
        self._show()

    def _show(self) -> None:
        chosen = self._mode.value
        self._code_editors.set_dark(is_dark=self._system_is_dark if chosen is None else chosen)
