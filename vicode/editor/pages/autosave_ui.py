"""Autosave and recovery in the user interface, and notices about changes by other users."""

import contextlib
import time

from nicegui import app, run

from vicode.editor.panels.code.code_choices import ask_to_resolve_code
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.texts import recovered
from vicode.editor.panels.versions.conflict_dialog import ask_to_resolve_conflict
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.recovery.autosave import AutosaveService

_TICK_S = 0.5
# Writing recovery files takes at most a tenth of the time, whatever the number and size of the designs.
_PAUSE_FACTOR = 9


def run_autosave(autosave: AutosaveService) -> None:
    """Save idle documents and write recovery files while the server runs."""
    paused_until_s = 0.0

    async def tick() -> None:
        nonlocal paused_until_s
        autosave.save_idle_documents()
        autosave.find_other_editors()
        started_s = time.perf_counter()
        if started_s < paused_until_s:
            return
        for snapshot in autosave.pending_snapshots():
            # Writing a large design takes a while; the timer waits for it.
            with contextlib.suppress(OSError):
                await run.io_bound(autosave.recovery.write, snapshot)
        ended_s = time.perf_counter()
        paused_until_s = ended_s + _PAUSE_FACTOR * (ended_s - started_s)

    app.timer(_TICK_S, tick)
    app.on_shutdown(autosave.close)


class AutosaveControls:
    """Offers recovery, the autosave and conflict commands, and shows notices of the document in one window."""

    def __init__(self, context: WindowContext, autosave: AutosaveService | None) -> None:
        self.context, self.autosave = context, autosave
        self.shown_notice = context.document.shared.notice

    def recover(self) -> None:
        """Recover the unsaved work on the design of this window."""
        context = self.context
        for lost in self.autosave.recoverable(context.workspace) if self.autosave is not None else ():
            if self.autosave is not None and lost.component == context.design.component:
                overruled = self.autosave.recover(context.workspace, lost, context.document.user_id)
                context.show_toast(recovered(lost.component, overruled), "info")

    def offer_recovery(self) -> None:
        if self.autosave is not None:
            from vicode.editor.panels.versions.recovery_dialog import offer_recovery

            offer_recovery(self.context, self.autosave)

    def commands(self) -> tuple[Command, ...]:
        return (
            Command(
                "conflict",
                "Resolve conflict with files on disk",
                self.resolve_conflict,
                MenuGroup.DESIGN,
                icon="difference",
            ),
        )

    def resolve_conflict(self) -> None:
        shared = self.context.document.shared
        if shared.disk_conflict is not None:
            ask_to_resolve_conflict(self.context)
        elif shared.outside.waiting:
            ask_to_resolve_code(self.context)
        else:
            self.context.show_toast("No conflict to resolve", "info")

    def refresh(self) -> None:
        """Show new notices: merges from disk, jumps in the history."""
        notice = self.context.document.shared.notice
        if notice != self.shown_notice:
            self.shown_notice = notice
            if notice.user_id != self.context.document.user_id:
                self.context.show_toast(notice.text, "info")
