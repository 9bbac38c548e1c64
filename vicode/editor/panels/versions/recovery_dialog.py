"""The dialog that offers to recover unsaved changes after a crash of the server."""

import time

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.recovery.autosave import AutosaveService, format_diff
from vicode.editor.session.recovery.recovery_store import RecoverableDesign

_TODAY_S = 18 * 3600


def offer_recovery(context: WindowContext, autosave: AutosaveService) -> None:
    """Open the dialog if there are unsaved changes."""
    recoverable_designs = autosave.recoverable(context.workspace)
    if not recoverable_designs:
        return
    with titled_dialog("Recover unsaved changes?", "recovery") as dialog:
        ui.label("The editor stopped before these changes were saved.").classes("small")
        for lost in recoverable_designs:
            _offer(context, autosave, lost, dialog)
        with ui.row().classes("dialog-buttons"):
            ui.button("Later", on_click=dialog.close).props("flat no-caps")


def _offer(context: WindowContext, autosave: AutosaveService, lost: RecoverableDesign, dialog: ui.dialog) -> None:
    with ui.column().classes("recovery-row") as row:

        def done(message: str, kind: str) -> None:
            context.show_toast(message, kind)
            row.delete()
            if not autosave.recoverable(context.workspace):
                dialog.close()

        def recover() -> None:
            try:
                overruled = autosave.recover(context.workspace, lost, context.document.user_id)
            except OSError as error:
                context.show_toast(f"Could not recover: {error_reason(error)}", "negative")
                return
            done(texts.recovered(lost.component, overruled), "positive")

        def discard() -> None:
            autosave.recovery.discard(lost)
            done(f"Discarded the changes to {lost.component}", "info")

        with ui.row().classes("recovery-ask"):
            is_deleted = context.workspace.project.design(lost.component) is None
            ui.label(texts.recovery_question(lost.component, _format_time(lost), is_deleted=is_deleted))
            ui.button("Discard", on_click=discard).props("flat no-caps color=negative")
            primary_button("Recover", recover)
        with ui.expansion("Show differences").props("dense").classes("section"):
            _differences(lost)


def _differences(lost: RecoverableDesign) -> None:
    with ui.element("div").classes("patch"):
        for line in format_diff(lost).splitlines():
            kind = {"+": "added", "-": "removed", "@": "where"}.get(line[:1], "same")
            ui.label(line or " ").classes(f"mono diff-line {kind}")


def _format_time(lost: RecoverableDesign) -> str:
    is_recent = time.time() - lost.at_s < _TODAY_S
    return time.strftime("%H:%M" if is_recent else "%d %b %H:%M", time.localtime(lost.at_s))
