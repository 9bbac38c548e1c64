"""Implements the commands of the design page."""

from collections.abc import Callable
from functools import partial
from typing import TypeVar

from nicegui import run

from vicode.editor.pages.canvas_controller import CanvasController
from vicode.editor.pages.theme import Theme
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.texts import SAVED, not_saved
from vicode.editor.panels.versions.conflict_dialog import ask_to_resolve_conflict
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DiskConflictError, DocumentSession
from vicode.editor.session.code import code_sync
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.gestures.canvas_gestures import DisableGesture
from vicode.editor.view.changed_places import find_changed_places

T = TypeVar("T")


class PageCommands:
    """The commands of one window."""

    def __init__(self, context: WindowContext, canvas_controller: CanvasController, theme: Theme) -> None:
        self.context, self.canvas_controller, self.theme = context, canvas_controller, theme
        self.links_shown = True

    def commands(self) -> tuple[Command, ...]:
        design, edit, view = MenuGroup.DESIGN, MenuGroup.EDIT, MenuGroup.VIEW
        return (
            Command("save", "Save", self.save, design, icon="save", keys=("Ctrl+S",), while_typing=True),
            Command("generate", "Generate", self.generate_code, design, icon="bolt"),
            Command("undo", "Undo", self.undo, edit, icon="undo", keys=("Ctrl+Z",)),
            Command("redo", "Redo", self.redo, edit, icon="redo", keys=("Ctrl+Shift+Z", "Ctrl+Y")),
            Command("disable", "Disable or enable", self.toggle_disabled, edit, icon="block", keys=("D",)),
            Command("links", "Show or hide links to components", self.toggle_links, view, icon="hub"),
            Command("theme", "Theme", self.toggle_theme, view, icon="contrast"),
        )

    def save(self) -> bool:
        """Save the design to its file; return whether it was saved."""
        context = self.context
        try:
            context.workspace.save(context.document)
        except DiskConflictError:
            ask_to_resolve_conflict(context)
            return False
        except (OSError, ValueError) as error:
            # A design may have a temporary state that no file can hold: two declarations with one name.
            context.show_toast(not_saved(context.document.file.name, error_reason(error)), "negative")
            return False
        context.document.shared.outside.unmark()
        context.notify_subscribers()
        context.show_toast(SAVED, "positive")
        return True

    def undo(self) -> None:
        """Undo the last edit of this user; show an error if another user changed the same since."""
        self._change_and_show(self.context.document.undo)

    def redo(self) -> None:
        self._change_and_show(self.context.document.redo)

    def _change_and_show(self, change: Callable[[], str]) -> None:
        """Undo or redo, and pan to what it changed if that is not in view."""
        canvas = self.canvas_controller
        before = canvas.scene
        self._show_error(change())
        canvas.canvas.reveal_any(find_changed_places(before, canvas.scene))

    def generate_code(self) -> None:
        """Save, show the changes of the generated files, and write them."""
        # Edits of the generated code are applied before the design is saved.
        code_sync.find_lacking(self.context.workspace, self.context.design.component)
        if self.context.document.is_saved or self.save():
            self.context.run_in_background(self._write_code(), "generate")

    def toggle_disabled(self) -> None:
        """Disable the selected states and transitions, or enable them if all are disabled."""
        self._show_error(self.canvas_controller.apply(DisableGesture(items=self.context.selected)).error)

    def toggle_links(self) -> None:
        self.links_shown = not self.links_shown
        self.canvas_controller.canvas.show_links(self.links_shown)

    def toggle_theme(self) -> None:
        """Switch to the next theme: system, dark, light."""
        self.context.show_toast(self.theme.toggle(), "info")

    def _show_error(self, error: str) -> None:
        if error:
            self.context.show_toast(error, "warning")

    async def _write_code(self) -> None:
        """Ask for confirmation if files change, unless the user disabled it."""
        from vicode.editor.panels.code.generate_dialog import confirm_writing, is_confirmation_disabled

        context = self.context
        prepared = await self._run_in_thread(context.workspace.prepare_output)
        if prepared is None:
            return
        if prepared.changes and (prepared.manual_edits or not await is_confirmation_disabled()):
            confirm_writing(context, prepared, self._write_answered)
        else:
            await self._write(is_forced=False)

    def _write_answered(self, is_forced: bool) -> None:
        self.context.run_in_background(self._write(is_forced=is_forced), "write code")

    async def _write(self, *, is_forced: bool) -> None:
        context = self.context
        outcome = await self._run_in_thread(partial(context.workspace.generate, is_forced=is_forced))
        if outcome is not None:
            context.show_toast(outcome.message, "positive" if outcome.is_complete else "negative")

    async def _run_in_thread(self, work: Callable[[DocumentSession], T]) -> T | None:
        """Run a function of the document in a thread. Errors are shown; the result is then None."""
        context = self.context
        try:
            result = await run.io_bound(work, context.document)
        except DiskConflictError:
            ask_to_resolve_conflict(context)
            return None
        except OSError as error:
            context.show_toast(f"Code generation failed: {error}", "negative")
            return None
        return None if self.canvas_controller.canvas.is_deleted else result
