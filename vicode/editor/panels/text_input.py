"""A text field that never overwrites typed text, independent of the connection's latency."""

from collections.abc import Callable
from typing import Any

from nicegui import ui
from nicegui.events import GenericEventArguments


class TextInput(ui.input, component="text_input.js"):
    """A text field that server and browser both change.

    Each text that the server sends has a sequence number. Input contains the number of the text it is based on; the
    browser ignores texts that the server sent before it received the input. The initial text has the number of the
    construction.

    Args:
        label: the label.
        placeholder: shown while the text is empty.
        multiline: whether the text may have several lines; the field grows with them.
        monospace: whether the text is code or a name; disables browser corrections.
    """

    def __init__(self, label: str, *, placeholder: str = "", multiline: bool = False, monospace: bool = False) -> None:
        self.server_seq = 0
        """Sequence number of the last sent text."""
        self.on_browser_text: Callable[[int, str], None] = lambda _number, _text: None
        """Called with the number of the base text and the typed text, before the value changes."""
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
        """Return the typed text; ignore invalid messages."""
        match e.args:
            case {"text": str() | None as text, "base_seq": int(base_seq), "client_seq": int(client_seq)}:
                self._acked_seq = client_seq
                self.on_browser_text(base_seq, text or "")
                return text
            case _:
                shown: str | None = self.value
                return shown

    def _handle_value_change(self, value: Any) -> None:
        """Send a text that the server set; of nested changes only the last one."""
        is_from_here, is_outer = self._send_update_on_value_change, not self._is_setting_value
        before = self.server_seq
        if is_from_here or not is_outer:
            self.server_seq += 1
        # Sent below instead: the browser would show NiceGUI's update even if it is outdated.
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
