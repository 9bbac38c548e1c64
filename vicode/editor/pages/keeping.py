"""What keeps a window's work from being lost: recovery after a crash, saving by itself, and news of what others do."""

import contextlib
import time

from nicegui import app, run

from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.save_dialog import ask_about_disk
from vicode.editor.session.keeper import Keeper

_TICK_S = 0.5
# Journals take a tenth of the time at most, however large the designs are and however many work on them.
_SHARE = 9


def keep_all(keeper: Keeper) -> None:
    """Let a keeper look after the designs for as long as the server runs."""
    rests_until_s = 0.0

    async def look() -> None:
        nonlocal rests_until_s
        keeper.save_rested()
        begun_s = time.perf_counter()
        if begun_s < rests_until_s:
            return
        for snapshot in keeper.due():
            # Writing a large design takes a while; the next look waits for it.
            with contextlib.suppress(OSError):
                await run.io_bound(keeper.recovery.write, snapshot)
        ended_s = time.perf_counter()
        rests_until_s = ended_s + _SHARE * (ended_s - begun_s)

    app.timer(_TICK_S, look)
    app.on_shutdown(keeper.close)


class Keeping:
    """Offers in one window what was lost, and tells there what others did to the whole design."""

    def __init__(self, desk: Desk, keeper: Keeper | None) -> None:
        """Begin with the news of now; an offer, if there is something to recover, comes with the page."""
        self.desk, self.keeper = desk, keeper
        self.told = desk.document.sheet.news
        if keeper is not None:
            from vicode.editor.panels.recovery_dialog import offer_recovery

            offer_recovery(desk, keeper)

    def commands(self) -> tuple[Command, ...]:
        """What can be asked of it."""
        return (
            Command("autosave", "Save by itself, or only when asked", self.toggle, Place.DESIGN, icon="update"),
            Command("clash", "Choose between your work and the file", self.ask, Place.DESIGN, icon="difference"),
        )

    def toggle(self) -> None:
        """Save this project by itself from now on, or no more; for everybody who works on it."""
        workspace = self.desk.workspace
        if self.keeper is None:
            workspace.autosave = not workspace.autosave
        else:
            self.keeper.set_autosave(workspace, is_on=not workspace.autosave)
        words = "saves by itself now" if workspace.autosave else "is saved only when asked now"
        self.desk.say(f"{workspace.project.name} {words}", "info")
        self.desk.tell()

    def ask(self) -> None:
        """Show what both this program and another changed in the file."""
        if self.desk.document.sheet.clash is None:
            self.desk.say("Nothing to choose: the file was not changed where you work", "info")
        ask_about_disk(self.desk)

    def refresh(self) -> None:
        """Tell what others did to the whole design: merges from disk, jumps in the history."""
        news = self.desk.document.sheet.news
        if news != self.told:
            self.told = news
            if news.person != self.desk.document.person:
                self.desk.say(news.text, "info")
