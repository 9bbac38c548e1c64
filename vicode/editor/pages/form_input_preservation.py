"""Nothing typed or pressed in a form is lost when the form is built anew, by whomever and at whatever moment.

A form is built anew when another thing is selected, or this one is renamed, or its parts come and go. Until the browser
has heard of it, people type into fields, and press buttons, that the server no longer has: what these say by
themselves reaches nobody.

- Who is still in such a field when the new form comes goes on in the new one, with what was typed since. The inspector
  is told of it, as others may have changed the same text meanwhile (`Inspector.carry_on`).
- Who has left it by then tells what was typed, with the number of the field. The inspector knows the fields of forms
  before, and brings it to the field that took the place (`Inspector.hear_late`).
- A press is told with the number of the button, just before the click itself. Where there is no such button any more,
  the browser presses the one of the same name in the new form.
"""

from pathlib import Path

from nicegui import ui

_SCRIPT = Path(__file__).with_name("form_input_preservation.js")


def preserve_form_input() -> None:
    """Add to the page what watches over its forms."""
    client = ui.context.client

    def hear_press(number: object) -> None:
        if isinstance(number, int) and number not in client.elements:
            ui.run_javascript(f"repeatPress({number})")

    ui.on("button-pressed", lambda event: hear_press(event.args))
    ui.add_body_html(f"<script>\n{_SCRIPT.read_text(encoding='utf-8')}</script>")
