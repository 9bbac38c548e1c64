"""What the commands of the design page do."""

from collections.abc import Callable
from functools import partial
from typing import TypeVar

from nicegui import run

from vicode.editor.pages.canvas_controller import CanvasController
from vicode.editor.pages.theme import Theme
from vicode.editor.panels.command import Command, MenuGroup
from vicode.editor.panels.conflict_dialog import ask_to_resolve_conflict
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DiskConflictError, DocumentSession, apply_gesture
from vicode.editor.session.descriptions import error_reason

T = TypeVar("T")


class PageCommands:
    """The commands of one window."""

    def __init__(self, context: WindowContext, drawing: CanvasController, theme: Theme) -> None:
        """Work on what this window shows."""
        self.context, self.canvas_controller, self.theme = context, drawing, theme
        self.links_shown = True

    def commands(self) -> tuple[Command, ...]:
        """All of them, in the order in which they are listed."""
        design, edit, view = MenuGroup.DESIGN, MenuGroup.EDIT, MenuGroup.VIEW
        return (
            Command("save", "Save", self.save, design, icon="save", keys=("Ctrl+S",), while_typing=True),
            Command("generate", "Generate", self.generate_code, design, icon="bolt"),
            Command("undo", "Undo", self.undo, edit, icon="undo", keys=("Ctrl+Z",)),
            Command("redo", "Redo", self.redo, edit, icon="redo", keys=("Ctrl+Shift+Z", "Ctrl+Y")),
            Command(
                "disable",
                "Disable what is selected, or enable it again",
                self.toggle_disabled,
                edit,
                icon="block",
                keys=("D",),
            ),
            Command("links", "Show or hide links to components", self.toggle_links, view, icon="hub"),
            Command("theme", "Light, dark, or as the system", self.toggle_theme, view, icon="contrast"),
        )

    def save(self) -> bool:
        """Write the design into its file; false if it was not."""
        desk = self.context
        try:
            desk.workspace.save(desk.document)
        except DiskConflictError:
            ask_to_resolve_conflict(desk)
            return False
        except (OSError, ValueError) as error:
            # A design may hold for a while what no file can: two declarations of one name.
            desk.show_toast(f"{desk.document.file.name} is not saved: {error_reason(error)}", "negative")
            return False
        desk.show_toast("Saved", "positive")
        return True

    def undo(self) -> None:
        """Take back what this person did last; says why not, if another changed it since."""
        self._show_error(self.context.document.undo())

    def redo(self) -> None:
        """Do again what undo took back."""
        self._show_error(self.context.document.redo())

    def generate_code(self) -> None:
        """Write the code, after saving, and after showing what would change."""
        if self.context.document.is_saved or self.save():
            self.context.run_in_background(self._write_code(), "generate")

    def toggle_disabled(self) -> None:
        """Disable the selected states and transitions, or enable them when all of them are disabled."""
        items = [{"of": thing.kind, "id": thing.id} for thing in self.context.selected]
        outcome = apply_gesture(self.context.document, {"kind": "disable", "items": items})
        if outcome.error:
            self.context.show_toast(outcome.error, "warning")

    def toggle_links(self) -> None:
        """Show or hide what states require and modulate."""
        self.links_shown = not self.links_shown
        self.canvas_controller.canvas.show_links(self.links_shown)

    def toggle_theme(self) -> None:
        """Go on to the next of system, dark and light."""
        self.context.show_toast(self.theme.toggle(), "info")

    def _show_error(self, refused: str) -> None:
        if refused:
            self.context.show_toast(refused, "warning")

    async def _write_code(self) -> None:
        """Show what would change, unless nothing would or the person does not want to be asked."""
        from vicode.editor.panels.generate_dialog import confirm_writing, is_confirmation_disabled

        desk = self.context
        prepared = await self._run_in_thread(desk.workspace.prepare_output)
        if prepared is None:
            return
        if prepared.changes and (prepared.manual_edits or not await is_confirmation_disabled()):
            confirm_writing(prepared, desk.design.component, self._write_answered)
        else:
            await self._write(is_forced=False)

    def _write_answered(self, is_forced: bool) -> None:
        self.context.run_in_background(self._write(is_forced=is_forced), "write code")

    async def _write(self, *, is_forced: bool) -> None:
        desk = self.context
        outcome = await self._run_in_thread(partial(desk.workspace.generate, is_forced=is_forced))
        if outcome is not None:
            desk.show_toast(outcome.message, "positive" if outcome.is_complete else "negative")

    async def _run_in_thread(self, work: Callable[[DocumentSession], T]) -> T | None:
        """Do something with the open design beside the event loop; None if it could not be done, which was said."""
        desk = self.context
        try:
            done = await run.io_bound(work, desk.document)
        except DiskConflictError:
            ask_to_resolve_conflict(desk)
            return None
        except OSError as error:
            desk.show_toast(f"Not generated: {error}", "negative")
            return None
        return None if self.canvas_controller.canvas.is_deleted else done
