"""Preserves input and clicks in a form while the server rebuilds the form.

A form is rebuilt when another item is selected, or when the item is renamed or its parts change. Until the browser has
received the new form, the user types into fields and clicks buttons that the server has already deleted; their events
are ignored.

- A focused field transfers its text, cursor and focus to the corresponding field of the new form
  (`Inspector.transfer_input`), as other users may have changed the same text.
- A field that lost the focus before the new form arrived sends its text with its element id. The inspector applies it
  to the corresponding field (`Inspector.apply_delayed_input`).
- A click is announced with the id of the button before the click itself. If the server no longer has the button, the
  browser clicks the button with the same name in the new form.
"""

from pathlib import Path

from nicegui import ui

_SCRIPT = Path(__file__).with_name("form_input_preservation.js")


def preserve_form_input() -> None:
    client = ui.context.client

    def on_press(number: object) -> None:
        if isinstance(number, int) and number not in client.elements:
            ui.run_javascript(f"repeatPress({number})")

    ui.on("button-pressed", lambda event: on_press(event.args))
    ui.add_body_html(f"<script>\n{_SCRIPT.read_text(encoding='utf-8')}</script>")
