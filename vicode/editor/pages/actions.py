"""What the commands of the design page do."""

from collections.abc import Callable
from functools import partial
from typing import TypeVar

from nicegui import run

from vicode.editor.pages.drawing import Drawing
from vicode.editor.pages.look import Theme
from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.save_dialog import ask_about_disk
from vicode.editor.session import ChangedOnDiskError, Document, apply_gesture
from vicode.editor.session.wording import reason_of

T = TypeVar("T")


class Actions:
    """The commands of one window."""

    def __init__(self, desk: Desk, drawing: Drawing, theme: Theme) -> None:
        """Work on what this window shows."""
        self.desk, self.drawing, self.theme = desk, drawing, theme
        self.links_shown = True

    def commands(self) -> tuple[Command, ...]:
        """All of them, in the order in which they are listed."""
        design, edit, view = Place.DESIGN, Place.EDIT, Place.VIEW
        return (
            Command("save", "Save", self.save, design, icon="save", keys=("Ctrl+S",), while_typing=True),
            Command("generate", "Generate", self.generate, design, icon="bolt"),
            Command("undo", "Undo", self.undo, edit, icon="undo", keys=("Ctrl+Z",)),
            Command("redo", "Redo", self.redo, edit, icon="redo", keys=("Ctrl+Shift+Z", "Ctrl+Y")),
            Command(
                "disable", "Disable what is selected, or enable it again", self.disable, edit, icon="block", keys=("D",)
            ),
            Command("links", "Show or hide links to components", self.toggle_links, view, icon="hub"),
            Command("theme", "Light, dark, or as the system", self.toggle_theme, view, icon="contrast"),
        )

    def save(self) -> bool:
        """Write the design into its file; false if it was not."""
        desk = self.desk
        try:
            desk.workspace.save(desk.document)
        except ChangedOnDiskError:
            ask_about_disk(desk)
            return False
        except (OSError, ValueError) as error:
            # A design may hold for a while what no file can: two declarations of one name.
            desk.say(f"{desk.document.file.name} is not saved: {reason_of(error)}", "negative")
            return False
        desk.say("Saved", "positive")
        return True

    def undo(self) -> None:
        """Take back what this person did last; says why not, if another changed it since."""
        self._say_why_not(self.desk.document.undo())

    def redo(self) -> None:
        """Do again what undo took back."""
        self._say_why_not(self.desk.document.redo())

    def generate(self) -> None:
        """Write the code, after saving, and after showing what would change."""
        if self.desk.document.is_saved or self.save():
            self.desk.begin(self._write_code(), "generate")

    def disable(self) -> None:
        """Disable the selected states and transitions, or enable them when all of them are disabled."""
        items = [{"of": thing.of, "id": thing.id} for thing in self.desk.selected]
        outcome = apply_gesture(self.desk.document, {"kind": "disable", "items": items})
        if outcome.refused:
            self.desk.say(outcome.refused, "warning")

    def toggle_links(self) -> None:
        """Show or hide what states require and modulate."""
        self.links_shown = not self.links_shown
        self.drawing.canvas.show_links(self.links_shown)

    def toggle_theme(self) -> None:
        """Go on to the next of system, dark and light."""
        self.desk.say(self.theme.toggle(), "info")

    def _say_why_not(self, refused: str) -> None:
        if refused:
            self.desk.say(refused, "warning")

    async def _write_code(self) -> None:
        """Show what would change, unless nothing would or the person does not want to be asked."""
        from vicode.editor.panels.generate_dialog import ask_before_writing, is_unasked

        desk = self.desk
        prepared = await self._try(desk.workspace.prepare)
        if prepared is None:
            return
        if prepared.changes and (prepared.edits or not await is_unasked()):
            ask_before_writing(prepared, desk.design.component, self._write_answered)
        else:
            await self._write(is_forced=False)

    def _write_answered(self, is_forced: bool) -> None:
        self.desk.begin(self._write(is_forced=is_forced), "write code")

    async def _write(self, *, is_forced: bool) -> None:
        desk = self.desk
        outcome = await self._try(partial(desk.workspace.generate, is_forced=is_forced))
        if outcome is not None:
            desk.say(outcome.words, "positive" if outcome.is_sound else "negative")

    async def _try(self, work: Callable[[Document], T]) -> T | None:
        """Do something with the open design beside the event loop; None if it could not be done, which was said."""
        desk = self.desk
        try:
            done = await run.io_bound(work, desk.document)
        except ChangedOnDiskError:
            ask_about_disk(desk)
            return None
        except OSError as error:
            desk.say(f"Not generated: {error}", "negative")
            return None
        return None if self.drawing.canvas.is_deleted else done
