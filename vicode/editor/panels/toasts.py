"""Short messages at the bottom of a page."""

from typing import Any, cast

from nicegui import ui

_SHORT_MS, _LONG_MS = 3500, 8000


def show_toast(text: str, kind: str) -> None:
    """Show a message for some seconds; `kind` is positive, negative, info or warning. Clicks pass through it."""
    timeout = _LONG_MS if kind == "negative" else _SHORT_MS
    ui.notify(text, type=cast("Any", kind), position="bottom", timeout=timeout, classes="is-toast")


def show_internal_error() -> None:
    """Report an exception of the editor; the server logs it."""
    show_toast("Internal error; the change may not be saved. See the server log.", "negative")
