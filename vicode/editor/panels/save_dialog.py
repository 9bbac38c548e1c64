"""What to do when the file was changed on disk where unsaved work was done: one choice for each place, or for all."""

from collections.abc import Callable
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.rows import primary_button
from vicode.editor.session import ChangedOnDiskError
from vicode.editor.session.document import Clash
from vicode.editor.session.wording import reason_of, words_of_path, words_of_value
from vicode.findings import Path
from vicode.model.merging import Conflict

_SIDES = (("mine", "Yours"), ("theirs", "On disk"))


def ask_about_disk(desk: Desk) -> None:
    """Ask; nothing is lost either way: what is not taken stays in the history, on both sides."""
    clash = desk.document.sheet.clash
    if clash is None:
        return
    name, is_gone = desk.document.file.name, desk.document.file_is_gone
    if clash.disk.design is not None:
        with titled_dialog(f"{name} was changed by another program", "clash") as dialog:
            _ask_for_choices(desk, dialog, clash)
        return
    what = "was deleted by another program" if is_gone else "holds no design any more"
    with titled_dialog(f"{name} {what}", "clash") as dialog:
        _ask_to_write(desk, dialog, clash, is_gone=is_gone)


def _ask_to_write(desk: Desk, dialog: ui.dialog, clash: Clash, *, is_gone: bool) -> None:
    name = desk.document.file.name
    aside = "" if is_gone else f" What it holds now is put aside as {name}.edited."
    ui.label(f"Your design is here. Saving writes the file anew.{aside}")
    with ui.row().classes("dialog-buttons"):
        ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
        primary_button("Write the file", lambda: _settle(_Asked(desk, dialog, clash), (), "Saved"))


def _ask_for_choices(desk: Desk, dialog: ui.dialog, clash: Clash) -> None:
    conflicts = clash.conflicts
    chosen: dict[Path, str] = {conflict.path: "mine" for conflict in conflicts}
    count = "one place" if len(conflicts) == 1 else f"{len(conflicts)} places"
    ui.label(f"It touches your unsaved work in {count}; all other changes of both come together.").classes("small")
    with ui.column().classes("clash-list"):
        for conflict in conflicts:
            _conflict(conflict, chosen)

    def settle(side: str, said: str) -> Callable[[], None]:
        def act() -> None:
            taken = [path for path, choice in chosen.items() if (side or choice) == "theirs"]
            _settle(_Asked(desk, dialog, clash), taken, said)

        return act

    with ui.row().classes("dialog-buttons"):
        ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
        ui.button("Take theirs", on_click=settle("theirs", "Opened as it is on disk")).props("flat no-caps")
        keep = settle("mine", "Saved over the change on disk")
        if len(conflicts) == 1:
            primary_button("Keep yours", keep)
        else:
            ui.button("Keep yours", on_click=keep).props("flat no-caps")
            primary_button("Save as chosen", settle("", "Saved as chosen"))


def _conflict(conflict: Conflict, chosen: dict[Path, str]) -> None:
    """One place with what stands there on both sides; the side that is pressed is taken."""
    texts = {"mine": words_of_value(conflict.ours), "theirs": words_of_value(conflict.theirs)}
    ui.label(words_of_path(conflict.path)).classes("clash-place")
    buttons: dict[str, ui.element] = {}

    def choose(side: str) -> Callable[[], None]:
        def act() -> None:
            chosen[conflict.path] = side
            for name, button in buttons.items():
                button.props(f'aria-pressed="{str(name == side).lower()}"')

        return act

    with ui.element("div").classes("clash-sides"):
        for side, title in _SIDES:
            other = set(texts["theirs" if side == "mine" else "mine"].splitlines())
            with ui.element("button").classes("clash-side").props('type="button"') as button:
                ui.label(title).classes("clash-title")
                for line in texts[side].splitlines():
                    ui.label(line or " ").classes("clash-line mono" + ("" if line in other else " differs"))
            buttons[side] = button.on("click", choose(side))
    choose("mine")()


@dataclass(frozen=True, slots=True)
class _Asked:
    """Which question a dialog asked."""

    desk: Desk
    dialog: ui.dialog
    clash: Clash


def _settle(asked: _Asked, theirs_at: list[Path] | tuple[()], said: str) -> None:
    desk, dialog = asked.desk, asked.dialog
    if desk.document.sheet.clash != asked.clash:
        # Somebody else has answered, or the file was changed once more: this answer is for what was asked.
        dialog.close()
        if desk.document.sheet.clash is None:
            desk.say("It was settled meanwhile: History has what was not taken", "info")
        ask_about_disk(desk)
        return
    try:
        desk.workspace.settle(desk.document, theirs_at)
        desk.workspace.save(desk.document)
    except (OSError, ValueError) as error:
        desk.say(f"{desk.document.file.name} is not saved: {reason_of(error)}", "negative")
        return
    except ChangedOnDiskError:
        # It was changed once more while the dialog was open.
        dialog.close()
        ask_about_disk(desk)
        return
    desk.say(said, "positive")
    dialog.close()
