"""A field for text in which nobody's typing is written over, however slow the line is."""

from collections.abc import Callable
from typing import Any

from nicegui import ui
from nicegui.events import GenericEventArguments


class TextInput(ui.input, component="text_input.js"):
    """A text in a line, or in as many as it needs, that server and browser both change.

    Every text that the server sends has a number. What is typed is told with the number of the text it was typed on:
    those sent since, until the server has heard it, were not and will not be shown. A browser that shows no such number
    yet shows the one it was built with.

    Args:
        label: its name.
        placeholder: shown where the text is empty.
        multiline: whether it may have several lines; it is as high as they are.
        monospace: whether it is code or a name, which no browser should mend.
    """

    def __init__(self, label: str, *, placeholder: str = "", multiline: bool = False, monospace: bool = False) -> None:
        self.server_seq = 0
        """Of the text that was sent last."""
        self.on_browser_text: Callable[[int, str], None] = lambda _number, _text: None
        """Called with the number of the text that was typed on and what was typed, before the value changes."""
        self._acked_seq = 0
        self._is_setting_value = False
        super().__init__(label, placeholder=placeholder)
        self.props("outlined dense stack-label")
        if multiline:
            self.props("type=textarea autogrow")
        if monospace:
            self.classes("mono").props("autocapitalize=off spellcheck=false autocomplete=off")
        self._props.update({"serverSeq": 0, "ackedSeq": 0})

    def _event_args_to_value(self, e: GenericEventArguments) -> str | None:
        """The text that was typed; what is no such message is ignored."""
        match e.args:
            case {"text": str() | None as text, "base_seq": int(base_seq), "client_seq": int(client_seq)}:
                self._acked_seq = client_seq
                self.on_browser_text(base_seq, text or "")
                return text
            case _:
                shown: str | None = self.value
                return shown

    def _handle_value_change(self, value: Any) -> None:
        """Send a text of the server's own; of several at once the last one."""
        is_from_here, is_outer = self._send_update_on_value_change, not self._is_setting_value
        before = self.server_seq
        if is_from_here or not is_outer:
            self.server_seq += 1
        # All is sent below: what NiceGUI sends would be shown whatever was typed.
        self._send_update_on_value_change, self._is_setting_value = False, True
        try:
            super()._handle_value_change(value)
        finally:
            if is_outer:
                self._send_update_on_value_change, self._is_setting_value = is_from_here, False
        with self._props.suspend_updates():
            self._props.update({"serverSeq": self.server_seq, "ackedSeq": self._acked_seq})
        if is_outer and self.server_seq != before:
            self.run_method("show", self.value, self.server_seq, self._acked_seq)
