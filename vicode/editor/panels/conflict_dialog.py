"""What to do when the file was changed on disk where unsaved work was done: one choice for each place, or for all."""

from collections.abc import Callable
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DiskConflictError
from vicode.editor.session.descriptions import describe_path, describe_value, error_reason
from vicode.editor.session.document import DiskVersion
from vicode.findings import DesignPath
from vicode.model.merge import Conflict

_SIDES = (("mine", "Yours"), ("theirs", "On disk"))


def ask_to_resolve_conflict(context: WindowContext) -> None:
    """Ask; nothing is lost either way: what is not taken stays in the history, on both sides."""
    sheet = context.document.shared
    if sheet.disk_conflict is None:
        return
    name, is_gone = context.document.file.name, context.document.is_file_missing
    if sheet.conflicts:
        with titled_dialog(f"{name} was changed by another program", "conflict") as dialog:
            _ask_for_choices(_ConflictPrompt(context, dialog, sheet.disk_conflict, sheet.conflicts))
        return
    if sheet.disk_conflict.design is not None:
        # What touched was taken back here.
        context.workspace.resolve_conflict(context.document)
        context.show_toast("Merged with what another program wrote", "info")
        return
    what = "was deleted by another program" if is_gone else "holds no design any more"
    with titled_dialog(f"{name} {what}", "conflict") as dialog:
        _ask_to_overwrite(_ConflictPrompt(context, dialog, sheet.disk_conflict), is_gone=is_gone)


@dataclass(frozen=True, slots=True)
class _ConflictPrompt:
    """Which question a dialog asked."""

    context: WindowContext
    dialog: ui.dialog
    clash: DiskVersion
    conflicts: tuple[Conflict, ...] = ()


def _ask_to_overwrite(asked: _ConflictPrompt, *, is_gone: bool) -> None:
    name = asked.context.document.file.name
    aside = "" if is_gone else f" What it holds now is put aside as {name}.edited."
    ui.label(f"Your design is here. Saving writes the file anew.{aside}")
    with ui.row().classes("dialog-buttons"):
        ui.button("Cancel", on_click=asked.dialog.close).props("flat no-caps")
        primary_button("Write the file", lambda: _resolve(asked, (), "Saved"))


def _ask_for_choices(asked: _ConflictPrompt) -> None:
    conflicts = asked.conflicts
    chosen: dict[DesignPath, str] = {conflict.path: "mine" for conflict in conflicts}
    count = "one place" if len(conflicts) == 1 else f"{len(conflicts)} places"
    ui.label(f"It touches your unsaved work in {count}; all other changes of both come together.").classes("small")
    with ui.column().classes("conflict-list"):
        for conflict in conflicts:
            _conflict(conflict, chosen)

    def settle(side: str, said: str) -> Callable[[], None]:
        def act() -> None:
            taken = [path for path, choice in chosen.items() if (side or choice) == "theirs"]
            _resolve(asked, taken, said)

        return act

    with ui.row().classes("dialog-buttons"):
        ui.button("Cancel", on_click=asked.dialog.close).props("flat no-caps")
        ui.button("Take theirs", on_click=settle("theirs", "Opened as it is on disk")).props("flat no-caps")
        keep = settle("mine", "Saved over the change on disk")
        if len(conflicts) == 1:
            primary_button("Keep yours", keep)
        else:
            ui.button("Keep yours", on_click=keep).props("flat no-caps")
            primary_button("Save as chosen", settle("", "Saved as chosen"))


def _conflict(conflict: Conflict, chosen: dict[DesignPath, str]) -> None:
    """One place with what stands there on both sides; the side that is pressed is taken."""
    texts = {"mine": describe_value(conflict.ours), "theirs": describe_value(conflict.theirs)}
    ui.label(describe_path(conflict.path)).classes("conflict-place")
    buttons: dict[str, ui.element] = {}

    def choose(side: str) -> Callable[[], None]:
        def act() -> None:
            chosen[conflict.path] = side
            for name, button in buttons.items():
                button.props(f'aria-pressed="{str(name == side).lower()}"')

        return act

    with ui.element("div").classes("conflict-sides"):
        for side, title in _SIDES:
            other = set(texts["theirs" if side == "mine" else "mine"].splitlines())
            with ui.element("button").classes("conflict-side").props('type="button"') as button:
                ui.label(title).classes("conflict-title")
                for line in texts[side].splitlines():
                    ui.label(line or " ").classes("conflict-line mono" + ("" if line in other else " differs"))
            buttons[side] = button.on("click", choose(side))
    choose("mine")()


def _resolve(asked: _ConflictPrompt, theirs_at: list[DesignPath] | tuple[()], said: str) -> None:
    desk, dialog = asked.context, asked.dialog
    if (desk.document.shared.disk_conflict, desk.document.shared.conflicts) != (asked.clash, asked.conflicts):
        # Somebody else has answered, or changed something, here or in the file: this answer is for what was asked.
        dialog.close()
        if desk.document.shared.disk_conflict is None:
            desk.show_toast("It was settled meanwhile: History has what was not taken", "info")
        else:
            desk.show_toast("Something was changed meanwhile: choose once more", "info")
        ask_to_resolve_conflict(desk)
        return
    try:
        desk.workspace.resolve_conflict(desk.document, theirs_at)
        desk.workspace.save(desk.document)
    except (OSError, ValueError) as error:
        desk.show_toast(f"{desk.document.file.name} is not saved: {error_reason(error)}", "negative")
        return
    except DiskConflictError:
        # It was changed once more while the dialog was open.
        dialog.close()
        ask_to_resolve_conflict(desk)
        return
    desk.show_toast(said, "positive")
    dialog.close()
