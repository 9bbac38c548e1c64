"""Confirmation before code is written: the files with their differences, and what to do with edits of them."""

from collections.abc import Callable
from pathlib import Path

from nicegui import ui

from vicode.editor.panels.code.edits_to_apply import EditsToApply
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.texts import files_to_write
from vicode.editor.panels.versions.diff_view import diff_view
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.output import FileDiff, FileStatus
from vicode.services.generation.design_output import PendingOutput

_ICONS = {FileStatus.NEW: "add_circle", FileStatus.CHANGED: "change_circle", FileStatus.STALE: "remove_circle"}
_WORDS = {FileStatus.NEW: "new", FileStatus.CHANGED: "changed", FileStatus.STALE: "no longer generated"}
_KEY = "vicode-generate-unasked"


# A browser that does not answer in this time would not show the dialog either.
_ANSWER_TIMEOUT_S = 60.0


async def is_confirmation_disabled() -> bool:
    """Whether the user disabled the confirmation in this browser."""
    try:
        return bool(await ui.run_javascript(f'localStorage.getItem("{_KEY}") === "yes"', timeout=_ANSWER_TIMEOUT_S))
    except TimeoutError:
        return False


def confirm_writing(context: WindowContext, prepared: PendingOutput, write: Callable[[bool], None]) -> None:
    """Show the changes, and what to do with edits of the files. On confirmation, the chosen edits are saved.

    The files of the open component come first. `write` is called with whether edited files must be backed up.
    """
    name = _normalize_name(context.design.component)
    changes = tuple(sorted(prepared.changes, key=lambda each: _normalize_name(Path(each.path).stem) != name))
    with titled_dialog("Write the generated code?", "generate-dialog") as dialog:
        edits = EditsToApply(context, prepared) if prepared.manual_edits else None
        ui.label(files_to_write(len(changes), prepared.folder.name, prepared.unchanged)).classes("small")
        with ui.element("div").classes("generate-files"):
            _files(prepared, changes)
        if prepared.skipped:
            ui.label(prepared.skipped).classes("field-finding")
        skip_confirmation = ui.checkbox("Don't ask again in this browser").props("dense")

        def confirm(*, overwrites: bool) -> None:
            if skip_confirmation.value:
                ui.run_javascript(f'localStorage.setItem("{_KEY}", "yes")')
            dialog.close()
            if overwrites or edits is None or edits.apply():
                write(overwrites or (edits is not None and edits.has_rest))

        with ui.row().classes("dialog-buttons"):
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
            if edits is None:
                primary_button("Write", lambda: confirm(overwrites=False)).props("autofocus")
            else:
                ui.button("Overwrite", on_click=lambda: confirm(overwrites=True)).props("flat no-caps")
                edits.enable(primary_button("Apply and write", lambda: confirm(overwrites=False)))

    dialog.on("hide", dialog.delete)


def _files(prepared: PendingOutput, changes: tuple[FileDiff, ...]) -> None:
    """Build the list of files, and the differences of the selected one."""
    file_list = ui.column().classes("generate-list").props('role="list"')
    diff = ui.element("div").classes("generate-diff")
    buttons: list[ui.element] = []

    def show(at: int) -> None:
        diff.clear()
        with diff:
            diff_view(changes[at].old, changes[at].new)
        for index, button in enumerate(buttons):
            button.props(f'aria-pressed="{str(index == at).lower()}"')

    with file_list:
        for at, change in enumerate(changes):
            buttons.append(_file(change, is_edited=change.path in prepared.manual_edits))
            buttons[-1].on("click", lambda at=at: show(at))
    show(0)


def _file(change: FileDiff, *, is_edited: bool) -> ui.element:
    with ui.element("div").props('role="listitem"'):
        button = ui.element("button").classes("generate-file").props('type="button"')
        with button:
            ui.icon("edit" if is_edited else _ICONS[change.status]).props('aria-hidden="true"')
            with ui.element("span"):
                ui.label(change.path.rpartition("/")[2]).classes("mono")
                words = _WORDS[change.status] + (", edited by hand" if is_edited else "")
                ui.label(words).classes("small")
    return button


def _normalize_name(name: str) -> str:
    """Normalize a name: the languages differ in case and underscores."""
    return name.replace("_", "").casefold()
