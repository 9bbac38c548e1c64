"""Presence: the users of the editor, and what each of their windows selects and edits."""

from dataclasses import dataclass, field, replace
from itertools import count
from typing import Any

from vicode.editor.view import ItemRef
from vicode.findings import DesignPath
from vicode.model.design import Point
from vicode.subscribers import Subscribers

DISK_USER = "disk"
"""The user id of edits by other programs."""

COLOR_COUNT = 8
_MAX_NAME_LENGTH = 24
_MAX_USERS = 1000


@dataclass(frozen=True, slots=True, kw_only=True)
class User:
    """A user in a browser; `color` is an index below COLOR_COUNT."""

    id: str
    name: str
    color: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Presence:
    """One window of a user: the selection, the path of the edited field, the position of the pointer."""

    window: str
    user: User
    selected: tuple[ItemRef, ...] = ()
    editing_path: DesignPath = ()
    pointer: Point | None = None


@dataclass(eq=False)
class UserDirectory:
    """All users since the start of the server, under chosen names or names such as "Guest 2"."""

    _known: dict[str, User] = field(default_factory=dict)
    _open_sections: dict[str, set[str]] = field(default_factory=dict)

    def get_or_create_user(self, id_: str, name: str = "") -> User:
        """The user of an id, renamed if `name` is given."""
        wanted = clean_name(name)
        known = self._known.get(id_)
        if known is None:
            if len(self._known) >= _MAX_USERS:
                oldest = next(iter(self._known))
                self._known.pop(oldest)
                self._open_sections.pop(oldest, None)
            guest = self._first_free_guest_name()
            known = User(id=id_, name=wanted or guest, color=len(self._known) % COLOR_COUNT)
        elif wanted:
            known = replace(known, name=wanted)
        self._known[id_] = known
        return known

    def _first_free_guest_name(self) -> str:
        taken = {user.name for user in self._known.values()}
        return next(name for name in (f"Guest {number}" for number in count(1)) if name not in taken)

    def open_sections(self, id_: str) -> set[str]:
        """The keys of the sections of forms that a user left open."""
        return self._open_sections.setdefault(id_, set())

    def name_of(self, id_: str) -> str:
        """The name of a user in a sentence."""
        if id_ == DISK_USER:
            return "another program"
        known = self._known.get(id_)
        return known.name if known else "someone"


@dataclass(eq=False)
class PresenceRoom:
    """The open windows of one design; subscribers of `changes` are called after each."""

    _presences: dict[str, Presence] = field(default_factory=dict)
    changes: Subscribers[[]] = field(default_factory=Subscribers)

    def join(self, window: str, user: User) -> None:
        self._presences[window] = Presence(window=window, user=user)
        self.changes.notify()

    def leave(self, window: str) -> None:
        if self._presences.pop(window, None) is not None:
            self.changes.notify()

    def update(self, window: str, **changes: Any) -> None:
        """Change `user`, `selected`, `editing_path` or `pointer` of a window."""
        before = self._presences.get(window)
        if before is not None and (now := replace(before, **changes)) != before:
            self._presences[window] = now
            self.changes.notify()

    @property
    def presences(self) -> tuple[Presence, ...]:
        """All windows in the order of joining."""
        return tuple(self._presences.values())

    def others(self, window: str) -> tuple[Presence, ...]:
        """All windows but one, including those of the same user."""
        return tuple(presence for presence in self._presences.values() if presence.window != window)

    def names_editing(self, path: DesignPath, window: str) -> tuple[str, ...]:
        """The names of the users who edit a field in other windows."""
        names = (other.user.name for other in self.others(window) if path and other.editing_path == path)
        return tuple(dict.fromkeys(names))


def clean_name(name: str) -> str:
    """A name on one line, of printable characters, of limited length."""
    printable = "".join(letter if letter.isprintable() else " " for letter in name)
    return " ".join(printable.split())[:_MAX_NAME_LENGTH].strip()
