"""The conflict dialog: the file on disk and the unsaved design changed the same place; choose a side for each."""

from collections.abc import Callable
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.versions.side_choice import ChoiceSide, side_choice
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DiskConflictError
from vicode.editor.session.descriptions import describe_value, error_reason
from vicode.editor.session.document import DiskVersion
from vicode.findings import DesignPath
from vicode.model.merge import Conflict
from vicode.model.paths import describe_path

_SIDES = (("mine", "Your version"), ("theirs", "On disk"))


def ask_to_resolve_conflict(context: WindowContext) -> None:
    """Open the dialog if there is a conflict. Discarded changes of both sides stay in the history."""
    shared = context.document.shared
    if shared.disk_conflict is None:
        return
    name, is_deleted = context.document.file.name, context.document.is_file_missing
    if shared.conflicts:
        with titled_dialog(texts.changed_by_another_program(name), "conflict") as dialog:
            _ask_for_choices(_ConflictPrompt(context, dialog, shared.disk_conflict, shared.conflicts))
        return
    if shared.disk_conflict.design is not None:
        # The conflicting edits were undone.
        context.workspace.resolve_conflict(context.document)
        context.show_toast("Merged with the changes on disk", "info")
        return
    with titled_dialog(texts.file_missing(name, is_deleted=is_deleted), "conflict") as dialog:
        _ask_to_overwrite(_ConflictPrompt(context, dialog, shared.disk_conflict), is_deleted=is_deleted)


@dataclass(frozen=True, slots=True)
class _ConflictPrompt:
    context: WindowContext
    dialog: ui.dialog
    disk_version: DiskVersion
    conflicts: tuple[Conflict, ...] = ()


def _ask_to_overwrite(prompt: _ConflictPrompt, *, is_deleted: bool) -> None:
    name = prompt.context.document.file.name
    ui.label(texts.save_again(name, is_deleted=is_deleted))
    with ui.row().classes("dialog-buttons"):
        ui.button("Cancel", on_click=prompt.dialog.close).props("flat no-caps")
        primary_button("Save file", lambda: _resolve(prompt, (), texts.SAVED))


def _ask_for_choices(prompt: _ConflictPrompt) -> None:
    conflicts = prompt.conflicts
    chosen: dict[DesignPath, str] = {conflict.path: "mine" for conflict in conflicts}
    ui.label(texts.conflict_count(len(conflicts))).classes("small")
    with ui.column().classes("conflict-list"):
        for conflict in conflicts:
            _conflict(conflict, chosen)

    def resolve_all(side: str, message: str) -> Callable[[], None]:
        def handle_click() -> None:
            paths = [path for path, choice in chosen.items() if (side or choice) == "theirs"]
            _resolve(prompt, paths, message)

        return handle_click

    with ui.row().classes("dialog-buttons"):
        ui.button("Cancel", on_click=prompt.dialog.close).props("flat no-caps")
        ui.button("Use version on disk", on_click=resolve_all("theirs", "Loaded the version on disk")).props(
            "flat no-caps"
        )
        keep = resolve_all("mine", "Saved your version")
        if len(conflicts) == 1:
            primary_button("Keep your version", keep)
        else:
            ui.button("Keep your version", on_click=keep).props("flat no-caps")
            primary_button("Save merged version", resolve_all("", "Saved the merged version"))


def _conflict(conflict: Conflict, chosen: dict[DesignPath, str]) -> None:
    """Show both values of a conflict; a click selects one."""
    values = {"mine": conflict.ours, "theirs": conflict.theirs}
    sides = {side: ChoiceSide(title=title, text=describe_value(values[side])) for side, title in _SIDES}

    def choose(side: str) -> None:
        chosen[conflict.path] = side

    ui.label(describe_path(conflict.path)).classes("conflict-place")
    side_choice(sides, choose)("mine")


def _resolve(prompt: _ConflictPrompt, theirs_at: list[DesignPath] | tuple[()], message: str) -> None:
    context, dialog = prompt.context, prompt.dialog
    if (context.document.shared.disk_conflict, context.document.shared.conflicts) != (
        prompt.disk_version,
        prompt.conflicts,
    ):
        # The conflict has changed since the dialog opened: this answer does not apply.
        dialog.close()
        if context.document.shared.disk_conflict is None:
            context.show_toast("The conflict is already resolved. See History for the other version.", "info")
        else:
            context.show_toast(texts.CONFLICT_CHANGED, "info")
        ask_to_resolve_conflict(context)
        return
    try:
        context.workspace.resolve_conflict(context.document, theirs_at)
        context.workspace.save(context.document)
    except (OSError, ValueError) as error:
        context.show_toast(texts.not_saved(context.document.file.name, error_reason(error)), "negative")
        return
    except DiskConflictError:
        # The file changed again while the dialog was open.
        dialog.close()
        ask_to_resolve_conflict(context)
        return
    context.show_toast(message, "positive")
    dialog.close()
