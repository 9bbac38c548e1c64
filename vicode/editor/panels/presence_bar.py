"""The users of the design as avatars in the header; the own avatar opens a dialog to change the name."""

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
    """A user; `doing` describes the current activity."""

    user: User
    doing: str
    is_me: bool


class PresenceBar:
    """Builds the row; `refresh` updates it."""

    def __init__(self, context: WindowContext) -> None:
        """Build the row of avatars. The page sets `rename`, which changes the user's name."""
        self.context = context
        self.rename: Callable[[str], None] = lambda _name: None
        self.rendered_key: object = None
        self.row = ui.row().classes("people").props('role="group" aria-label="Connected users"')

    def refresh(self) -> None:
        """Show the current users, this one first."""
        avatars = self._collect_avatars()
        key = (avatars[:_MAX_SHOWN], [avatar.user.name for avatar in avatars[_MAX_SHOWN:]])
        if key == self.rendered_key:
            return
        self.rendered_key = key
        self.row.clear()
        with self.row:
            for avatar in avatars[:_MAX_SHOWN]:
                self._build_avatar(avatar)
            if len(avatars) > _MAX_SHOWN:
                names = ", ".join(avatar.user.name for avatar in avatars[_MAX_SHOWN:])
                with ui.label(f"+{len(avatars) - _MAX_SHOWN}").classes("person more"):
                    ui.tooltip(names)

    def _collect_avatars(self) -> list[_Avatar]:
        me = self.context.document.user_id
        avatars: dict[str, _Avatar] = {}
        for presence in sorted(self.context.presence.presences, key=lambda each: each.user.id != me):
            user, is_me = presence.user, presence.user.id == me
            doing = "" if is_me else describe_presence(presence)
            if user.id not in avatars or not avatars[user.id].doing:
                avatars[user.id] = _Avatar(user=user, doing=doing, is_me=is_me)
        return list(avatars.values())

    def _build_avatar(self, avatar: _Avatar) -> None:
        name = avatar.user.name
        label = (
            f"You are {name}. Change your name…"
            if avatar.is_me
            else f"{name}{f': {avatar.doing}' if avatar.doing else ''}"
        )
        button = ui.element("button" if avatar.is_me else "div").classes(f"person person-{avatar.user.color}")
        # Speech control uses what is visible. Not through `props(text)`, as names may contain any character.
        button.props["aria-label"] = f"{get_initials(name)}. {label}"
        button.props["role"] = "button" if avatar.is_me else "img"
        with button:
            ui.label(get_initials(name)).props('aria-hidden="true"')
            ui.tooltip(label)
        if avatar.is_me:
            button.classes("is-me").on("click", self._ask)

    def _ask(self) -> None:
        users = self.context.document.shared.users
        with titled_dialog("Your name") as dialog:
            ui.label("Other users see this name next to your selection and in the history.").classes("small")
            field = ui.input("Name", value=users.name_of(self.context.document.user_id))
            field.props("outlined dense stack-label autofocus maxlength=24")

            def save() -> None:
                self.rename(str(field.value))
                dialog.close()

            field.on("keydown.enter", save)
            with ui.row().classes("dialog-buttons"):
                ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
                primary_button("Change name", save)
        dialog.on("hide", dialog.delete)


def get_initials(name: str) -> str:
    """Return at most two initials of a name."""
    parts = name.split()
    return "".join(part[0] for part in (parts if len(parts) < 2 else (parts[0], parts[-1]))).upper()
