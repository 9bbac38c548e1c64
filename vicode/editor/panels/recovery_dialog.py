"""Offers the unsaved work that a server which was killed left behind."""

import time

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.rows import primary_button
from vicode.editor.session.keeper import Keeper, difference_of
from vicode.editor.session.recovery import Lost
from vicode.editor.session.wording import reason_of

_TODAY_S = 18 * 3600


def offer_recovery(desk: Desk, keeper: Keeper) -> None:
    """Ask what to do with each design's lost work; nothing is asked when there is none."""
    found = keeper.lost(desk.workspace)
    if not found:
        return
    with titled_dialog("Unsaved changes were left behind", "recovery") as dialog:
        ui.label("The editor ended before they were saved.").classes("small")
        for lost in found:
            _offer(desk, keeper, lost, dialog)
        with ui.row().classes("dialog-buttons"):
            ui.button("Later", on_click=dialog.close).props("flat no-caps")


def _offer(desk: Desk, keeper: Keeper, lost: Lost, dialog: ui.dialog) -> None:
    with ui.column().classes("recovery-row") as row:

        def done(said: str, kind: str) -> None:
            desk.say(said, kind)
            row.delete()
            if not keeper.lost(desk.workspace):
                dialog.close()

        def recover() -> None:
            try:
                overruled = keeper.recover(desk.workspace, lost, desk.document.person)
            except OSError as error:
                desk.say(f"Not recovered: {reason_of(error)}", "negative")
                return
            more = f"; in {overruled} places the file says otherwise, one undo away" if overruled else ""
            done(f"Recovered the changes of {lost.component}{more}", "positive")

        def discard() -> None:
            keeper.recovery.forget(lost)
            done(f"Discarded the changes of {lost.component}", "info")

        with ui.row().classes("recovery-ask"):
            is_gone = desk.workspace.project.design(lost.component) is None
            again = " Its file is gone: it is made again." if is_gone else ""
            ui.label(f"Recover the unsaved changes of {lost.component} from {_time_of(lost)}?{again}")
            ui.button("Discard", on_click=discard).props("flat no-caps color=negative")
            primary_button("Recover", recover)
        with ui.expansion("See the differences").props("dense").classes("section"):
            _differences(lost)


def _differences(lost: Lost) -> None:
    with ui.element("div").classes("patch"):
        for line in difference_of(lost).splitlines():
            kind = {"+": "added", "-": "removed", "@": "where"}.get(line[:1], "same")
            ui.label(line or " ").classes(f"mono diff-line {kind}")


def _time_of(lost: Lost) -> str:
    is_recent = time.time() - lost.at_s < _TODAY_S
    return time.strftime("%H:%M" if is_recent else "%d %b %H:%M", time.localtime(lost.at_s))
