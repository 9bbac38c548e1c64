"""Offers the unsaved work that a server which was killed left behind."""

import time

from nicegui import ui

from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.autosave import AutosaveService, format_diff
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.recovery import RecoverableDesign

_TODAY_S = 18 * 3600


def offer_recovery(context: WindowContext, keeper: AutosaveService) -> None:
    """Ask what to do with each design's lost work; nothing is asked when there is none."""
    found = keeper.recoverable(context.workspace)
    if not found:
        return
    with titled_dialog("Unsaved changes were left behind", "recovery") as dialog:
        ui.label("The editor ended before they were saved.").classes("small")
        for lost in found:
            _offer(context, keeper, lost, dialog)
        with ui.row().classes("dialog-buttons"):
            ui.button("Later", on_click=dialog.close).props("flat no-caps")


def _offer(context: WindowContext, keeper: AutosaveService, lost: RecoverableDesign, dialog: ui.dialog) -> None:
    with ui.column().classes("recovery-row") as row:

        def done(said: str, kind: str) -> None:
            context.show_toast(said, kind)
            row.delete()
            if not keeper.recoverable(context.workspace):
                dialog.close()

        def recover() -> None:
            try:
                overruled = keeper.recover(context.workspace, lost, context.document.user_id)
            except OSError as error:
                context.show_toast(f"Not recovered: {error_reason(error)}", "negative")
                return
            more = f"; in {overruled} places the file says otherwise, one undo away" if overruled else ""
            done(f"Recovered the changes of {lost.component}{more}", "positive")

        def discard() -> None:
            keeper.recovery.discard(lost)
            done(f"Discarded the changes of {lost.component}", "info")

        with ui.row().classes("recovery-ask"):
            is_gone = context.workspace.project.design(lost.component) is None
            again = " Its file is gone: it is made again." if is_gone else ""
            ui.label(f"Recover the unsaved changes of {lost.component} from {_time_of(lost)}?{again}")
            ui.button("Discard", on_click=discard).props("flat no-caps color=negative")
            primary_button("Recover", recover)
        with ui.expansion("See the differences").props("dense").classes("section"):
            _differences(lost)


def _differences(lost: RecoverableDesign) -> None:
    with ui.element("div").classes("patch"):
        for line in format_diff(lost).splitlines():
            kind = {"+": "added", "-": "removed", "@": "where"}.get(line[:1], "same")
            ui.label(line or " ").classes(f"mono diff-line {kind}")


def _time_of(lost: RecoverableDesign) -> str:
    is_recent = time.time() - lost.at_s < _TODAY_S
    return time.strftime("%H:%M" if is_recent else "%d %b %H:%M", time.localtime(lost.at_s))
