"""What to do when the file changed on disk while its design was open."""

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.rows import primary_button


def ask_about_disk(desk: Desk) -> None:
    """Ask; nothing is lost either way: what is taken over stays one undo away, what is written patches the new text."""
    name = desk.document.file.name
    with ui.dialog() as dialog, ui.card().classes("dialog"):
        ui.label(f"{name} was changed by another program").classes("dialog-title")
        ui.label("Keep yours: your design is written into the file as it is now on disk, comments there stay.")
        ui.label("Take theirs: the file's design is opened; undo brings yours back.")

        def keep() -> None:
            desk.workspace.save(desk.document, over=True)
            desk.say("Saved over the change on disk", "positive")
            dialog.close()

        def take() -> None:
            refused = desk.workspace.reload(desk.document)
            desk.say(refused or "Opened as it is on disk", "negative" if refused else "positive")
            dialog.close()

        with ui.row().classes("dialog-buttons"):
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
            ui.button("Take theirs", on_click=take).props("flat no-caps")
            primary_button("Keep yours", keep)
    dialog.open()
