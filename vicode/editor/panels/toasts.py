"""Short messages at the foot of a page."""

from typing import Any, cast

from nicegui import ui

_SHORT_MS, _LONG_MS = 3500, 8000


def show_toast(text: str, kind: str) -> None:
    """Show a message for a while; `kind` is positive, negative, info or warning. Presses go to what lies under it."""
    timeout = _LONG_MS if kind == "negative" else _SHORT_MS
    ui.notify(text, type=cast("Any", kind), position="bottom", timeout=timeout, classes="is-toast")


def show_internal_error() -> None:
    """Say that vicode itself failed at what was asked; the server prints the rest."""
    show_toast("vicode failed at this: it may not have been done. Where it was started, it says more.", "negative")
