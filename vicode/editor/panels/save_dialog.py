"""What to do when the file was changed on disk where unsaved work was done: one choice for each place, or for all."""

from collections.abc import Callable
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.rows import primary_button
from vicode.editor.session import ChangedOnDiskError
from vicode.editor.session.document import OnDisk
from vicode.editor.session.wording import reason_of, words_of_path, words_of_value
from vicode.findings import Path
from vicode.model.merging import Conflict

_SIDES = (("mine", "Yours"), ("theirs", "On disk"))


def ask_about_disk(desk: Desk) -> None:
    """Ask; nothing is lost either way: what is not taken stays in the history, on both sides."""
    sheet = desk.document.sheet
    if sheet.clash is None:
        return
    name, is_gone = desk.document.file.name, desk.document.file_is_gone
    if sheet.conflicts:
        with titled_dialog(f"{name} was changed by another program", "clash") as dialog:
            _ask_for_choices(_Asked(desk, dialog, sheet.clash, sheet.conflicts))
        return
    if sheet.clash.design is not None:
        # What touched was taken back here.
        desk.workspace.settle(desk.document)
        desk.say("Merged with what another program wrote", "info")
        return
    what = "was deleted by another program" if is_gone else "holds no design any more"
    with titled_dialog(f"{name} {what}", "clash") as dialog:
        _ask_to_write(_Asked(desk, dialog, sheet.clash), is_gone=is_gone)


@dataclass(frozen=True, slots=True)
class _Asked:
    """Which question a dialog asked."""

    desk: Desk
    dialog: ui.dialog
    clash: OnDisk
    conflicts: tuple[Conflict, ...] = ()


def _ask_to_write(asked: _Asked, *, is_gone: bool) -> None:
    name = asked.desk.document.file.name
    aside = "" if is_gone else f" What it holds now is put aside as {name}.edited."
    ui.label(f"Your design is here. Saving writes the file anew.{aside}")
    with ui.row().classes("dialog-buttons"):
        ui.button("Cancel", on_click=asked.dialog.close).props("flat no-caps")
        primary_button("Write the file", lambda: _settle(asked, (), "Saved"))


def _ask_for_choices(asked: _Asked) -> None:
    conflicts = asked.conflicts
    chosen: dict[Path, str] = {conflict.path: "mine" for conflict in conflicts}
    count = "one place" if len(conflicts) == 1 else f"{len(conflicts)} places"
    ui.label(f"It touches your unsaved work in {count}; all other changes of both come together.").classes("small")
    with ui.column().classes("clash-list"):
        for conflict in conflicts:
            _conflict(conflict, chosen)

    def settle(side: str, said: str) -> Callable[[], None]:
        def act() -> None:
            taken = [path for path, choice in chosen.items() if (side or choice) == "theirs"]
            _settle(asked, taken, said)

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


def _settle(asked: _Asked, theirs_at: list[Path] | tuple[()], said: str) -> None:
    desk, dialog = asked.desk, asked.dialog
    if (desk.document.sheet.clash, desk.document.sheet.conflicts) != (asked.clash, asked.conflicts):
        # Somebody else has answered, or changed something, here or in the file: this answer is for what was asked.
        dialog.close()
        if desk.document.sheet.clash is None:
            desk.say("It was settled meanwhile: History has what was not taken", "info")
        else:
            desk.say("Something was changed meanwhile: choose once more", "info")
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
