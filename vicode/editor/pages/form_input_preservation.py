"""Preserves clicks and the focus while the server replaces parts of a form.

Until the browser has received the form of a newly selected item, the user clicks buttons that the server has already
deleted; their events are ignored. Each click is announced with the id of the button before the click itself. If the
server no longer has the button, the browser clicks the button with the same name in the new form. Text fields of
removed forms still receive their input (`vicode.editor.panels.form.RemovedTexts`).
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
