"""Who is here, as a row of chips in the header; one's own chip changes the name that the others see."""

from collections.abc import Callable
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.rows import primary_button
from vicode.editor.session import Person
from vicode.editor.session.wording import words_of_presence

_MOST_SHOWN = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class _Chip:
    """One person: `doing` says what they are at."""

    person: Person
    doing: str
    is_me: bool


class PeopleChips:
    """Builds the row; `refresh` shows who is here now."""

    def __init__(self, desk: Desk) -> None:
        """Build it; `rename` is to be set to what gives this person another name."""
        self.desk = desk
        self.rename: Callable[[str], None] = lambda _name: None
        self.shown: object = None
        self.row = ui.row().classes("people").props('role="group" aria-label="Who is here"')
        self.refresh()

    def refresh(self) -> None:
        """Show who is here now, oneself first."""
        chips = self._chips()
        shape = (chips[:_MOST_SHOWN], [chip.person.name for chip in chips[_MOST_SHOWN:]])
        if shape == self.shown:
            return
        self.shown = shape
        self.row.clear()
        with self.row:
            for chip in chips[:_MOST_SHOWN]:
                self._draw(chip)
            if len(chips) > _MOST_SHOWN:
                names = ", ".join(chip.person.name for chip in chips[_MOST_SHOWN:])
                with ui.label(f"+{len(chips) - _MOST_SHOWN}").classes("person more"):
                    ui.tooltip(names)

    def _chips(self) -> list[_Chip]:
        me = self.desk.document.person
        chips: dict[str, _Chip] = {}
        for presence in sorted(self.desk.company.all, key=lambda each: each.person.id != me):
            person, is_me = presence.person, presence.person.id == me
            doing = "" if is_me else words_of_presence(presence)
            if person.id not in chips or not chips[person.id].doing:
                chips[person.id] = _Chip(person=person, doing=doing, is_me=is_me)
        return list(chips.values())

    def _draw(self, chip: _Chip) -> None:
        name = chip.person.name
        words = (
            f"You are {name}: change your name" if chip.is_me else f"{name}{f': {chip.doing}' if chip.doing else ''}"
        )
        button = ui.element("button" if chip.is_me else "div").classes(f"person person-{chip.person.colour}")
        # Set apart from the text of props, as a name may hold anything.
        button.props["aria-label"] = words
        button.props["role"] = "button" if chip.is_me else "img"
        with button:
            ui.label(initials_of(name)).props('aria-hidden="true"')
            ui.tooltip(words)
        if chip.is_me:
            button.classes("is-me").on("click", self._ask)

    def _ask(self) -> None:
        people = self.desk.document.sheet.people
        with titled_dialog("Your name") as dialog:
            ui.label("The others see it beside what you select and in the history.").classes("small")
            field = ui.input("Name", value=people.name_of(self.desk.document.person))
            field.props("outlined dense stack-label autofocus maxlength=24")

            def keep() -> None:
                self.rename(str(field.value))
                dialog.close()

            field.on("keydown.enter", keep)
            with ui.row().classes("dialog-buttons"):
                ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
                primary_button("Use this name", keep)
        dialog.on("hide", dialog.delete)


def initials_of(name: str) -> str:
    """At most two letters that stand for a name."""
    parts = name.split()
    return "".join(part[0] for part in (parts if len(parts) < 2 else (parts[0], parts[-1]))).upper()
