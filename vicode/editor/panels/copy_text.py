"""Copies a text to the clipboard of the browser."""

import json

from vicode.editor.panels.window_context import WindowContext

# Also works on pages without HTTPS, which lack the clipboard API.
_WRITE = "return Quasar.copyToClipboard(%s).then(() => true, () => false)"
# The browser may ask the user for permission.
_TIMEOUT_S = 60


def copy_text(context: WindowContext, text: str, confirmation: str) -> None:
    """Copy a text in the background, and show whether it worked."""

    async def write() -> None:
        try:
            is_done = await context.client.run_javascript(_WRITE % json.dumps(text), timeout=_TIMEOUT_S)
        except TimeoutError:
            is_done = False
        if is_done:
            context.show_toast(confirmation, "positive")
        else:
            context.show_toast("Clipboard access denied. Select the text and copy it, or download the file.", "warning")

    context.run_in_background(write(), "copy")
