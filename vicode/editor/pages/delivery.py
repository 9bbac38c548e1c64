"""Opens the inbox of a page, see `vicode.editor.session.gestures.delivery`."""

from pathlib import Path

from nicegui import ui

from vicode.editor.session.gestures.delivery import Inbox

_SCRIPT = Path(__file__).with_name("delivery.js")


def open_inbox() -> Inbox:
    """The inbox of the current page, which gets `window.deliver`."""
    client = ui.context.client
    ui.add_body_html(f"<script>\n{_SCRIPT.read_text(encoding='utf-8')}</script>")

    def confirm(number: int) -> None:
        if not client.is_deleted:
            client.run_javascript(f"confirmDelivery({number})")

    return Inbox(confirm)
