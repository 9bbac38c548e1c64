"""Who is here, as a row of chips in the header; one's own chip changes the name that the others see."""

from collections.abc import Callable
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import User
from vicode.editor.session.descriptions import describe_presence

_MAX_SHOWN = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class _Avatar:
    """One person: `doing` says what they are at."""

    person: User
    doing: str
    is_me: bool


class PresenceBar:
    """Builds the row; `refresh` shows who is here now."""

    def __init__(self, context: WindowContext) -> None:
        """Build it; `rename` is to be set to what gives this person another name."""
        self.context = context
        self.rename: Callable[[str], None] = lambda _name: None
        self.rendered_key: object = None
        self.row = ui.row().classes("people").props('role="group" aria-label="Who is here"')
        self.refresh()

    def refresh(self) -> None:
        """Show who is here now, oneself first."""
        chips = self._collect_avatars()
        shape = (chips[:_MAX_SHOWN], [chip.person.name for chip in chips[_MAX_SHOWN:]])
        if shape == self.rendered_key:
            return
        self.rendered_key = shape
        self.row.clear()
        with self.row:
            for chip in chips[:_MAX_SHOWN]:
                self._build_avatar(chip)
            if len(chips) > _MAX_SHOWN:
                names = ", ".join(chip.person.name for chip in chips[_MAX_SHOWN:])
                with ui.label(f"+{len(chips) - _MAX_SHOWN}").classes("person more"):
                    ui.tooltip(names)

    def _collect_avatars(self) -> list[_Avatar]:
        me = self.context.document.user_id
        chips: dict[str, _Avatar] = {}
        for presence in sorted(self.context.presence.presences, key=lambda each: each.user.id != me):
            person, is_me = presence.user, presence.user.id == me
            doing = "" if is_me else describe_presence(presence)
            if person.id not in chips or not chips[person.id].doing:
                chips[person.id] = _Avatar(person=person, doing=doing, is_me=is_me)
        return list(chips.values())

    def _build_avatar(self, chip: _Avatar) -> None:
        name = chip.person.name
        words = (
            f"You are {name}: change your name" if chip.is_me else f"{name}{f': {chip.doing}' if chip.doing else ''}"
        )
        button = ui.element("button" if chip.is_me else "div").classes(f"person person-{chip.person.colour}")
        # Set apart from the text of props, as a name may hold anything.
        button.props["aria-label"] = words
        button.props["role"] = "button" if chip.is_me else "img"
        with button:
            ui.label(get_initials(name)).props('aria-hidden="true"')
            ui.tooltip(words)
        if chip.is_me:
            button.classes("is-me").on("click", self._ask)

    def _ask(self) -> None:
        people = self.context.document.shared.users
        with titled_dialog("Your name") as dialog:
            ui.label("The others see it beside what you select and in the history.").classes("small")
            field = ui.input("Name", value=people.name_of(self.context.document.user_id))
            field.props("outlined dense stack-label autofocus maxlength=24")

            def keep() -> None:
                self.rename(str(field.value))
                dialog.close()

            field.on("keydown.enter", keep)
            with ui.row().classes("dialog-buttons"):
                ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
                primary_button("Use this name", keep)
        dialog.on("hide", dialog.delete)


def get_initials(name: str) -> str:
    """At most two letters that stand for a name."""
    parts = name.split()
    return "".join(part[0] for part in (parts if len(parts) < 2 else (parts[0], parts[-1]))).upper()
