"""What keeps a window's work from being lost: recovery after a crash, saving by itself, and news of what others do."""

import contextlib
import time

from nicegui import app, run

from vicode.editor.panels.command import Command, MenuGroup
from vicode.editor.panels.conflict_dialog import ask_to_resolve_conflict
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.autosave import AutosaveService

_TICK_S = 0.5
# Journals take a tenth of the time at most, however large the designs are and however many work on them.
_SHARE = 9


def run_autosave(autosave: AutosaveService) -> None:
    """Let a keeper look after the designs for as long as the server runs."""
    rests_until_s = 0.0

    async def look() -> None:
        nonlocal rests_until_s
        autosave.save_idle_documents()
        begun_s = time.perf_counter()
        if begun_s < rests_until_s:
            return
        for snapshot in autosave.pending_snapshots():
            # Writing a large design takes a while; the next look waits for it.
            with contextlib.suppress(OSError):
                await run.io_bound(autosave.recovery.write, snapshot)
        ended_s = time.perf_counter()
        rests_until_s = ended_s + _SHARE * (ended_s - begun_s)

    app.timer(_TICK_S, look)
    app.on_shutdown(autosave.close)


class AutosaveControls:
    """Offers in one window what was lost, and tells there what others did to the whole design."""

    def __init__(self, context: WindowContext, keeper: AutosaveService | None) -> None:
        """Begin with the news of now; an offer, if there is something to recover, comes with the page."""
        self.context, self.autosave = context, keeper
        self.shown_notice = context.document.shared.notice
        if keeper is not None:
            from vicode.editor.panels.recovery_dialog import offer_recovery

            offer_recovery(context, keeper)

    def commands(self) -> tuple[Command, ...]:
        """What can be asked of it."""
        return (
            Command(
                "autosave", "Save by itself, or only when asked", self.toggle_autosave, MenuGroup.DESIGN, icon="update"
            ),
            Command(
                "conflict",
                "Choose between your work and the file",
                self.resolve_conflict,
                MenuGroup.DESIGN,
                icon="difference",
            ),
        )

    def toggle_autosave(self) -> None:
        """Save this project by itself from now on, or no more; for everybody who works on it."""
        workspace = self.context.workspace
        if self.autosave is None:
            workspace.autosave = not workspace.autosave
        else:
            self.autosave.set_autosave(workspace, is_on=not workspace.autosave)
        words = "saves by itself now" if workspace.autosave else "is saved only when asked now"
        self.context.show_toast(f"{workspace.project.name} {words}", "info")
        self.context.notify_listeners()

    def resolve_conflict(self) -> None:
        """Show what both this program and another changed in the file."""
        if self.context.document.shared.disk_conflict is None:
            self.context.show_toast("Nothing to choose: the file was not changed where you work", "info")
        ask_to_resolve_conflict(self.context)

    def refresh(self) -> None:
        """Tell what others did to the whole design: merges from disk, jumps in the history."""
        news = self.context.document.shared.notice
        if news != self.shown_notice:
            self.shown_notice = news
            if news.user_id != self.context.document.user_id:
                self.context.show_toast(news.text, "info")
