"""Who is here: people with a name and a colour, and what each window of theirs is at."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

from vicode.editor.view import ItemRef
from vicode.findings import DesignPath
from vicode.model.design import Point

DISK_USER = "disk"
"""Stands for the person where another program changed the file."""

COLOUR_COUNT = 8
_MAX_NAME_LENGTH = 24
_MAX_USERS = 1000


@dataclass(frozen=True, slots=True, kw_only=True)
class User:
    """Somebody at a browser; `colour` is the number of one of the colours that tell people apart."""

    id: str
    name: str
    colour: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Presence:
    """What somebody is at in one window: what is selected, the field being typed in, where the pointer is."""

    window: str
    user: User
    selected: tuple[ItemRef, ...] = ()
    editing_path: DesignPath = ()
    pointer: Point | None = None


@dataclass(eq=False)
class UserDirectory:
    """Everybody who came since the editor was started; names are chosen, or "Guest 2"."""

    _known: dict[str, User] = field(default_factory=dict)

    def get_or_create_user(self, id_: str, name: str = "") -> User:
        """The person of an id, by the name given now, else the one from before."""
        wanted = clean_name(name)
        known = self._known.get(id_)
        if known is None:
            if len(self._known) >= _MAX_USERS:
                self._known.pop(next(iter(self._known)))
            number = len(self._known) + 1
            known = User(id=id_, name=wanted or f"Guest {number}", colour=(number - 1) % COLOUR_COUNT)
        elif wanted:
            known = replace(known, name=wanted)
        self._known[id_] = known
        return known

    def name_of(self, id_: str) -> str:
        """The name of a person in a sentence."""
        if id_ == DISK_USER:
            return "another program"
        known = self._known.get(id_)
        return known.name if known else "somebody"


@dataclass(eq=False)
class PresenceRoom:
    """The windows that are open on one design; watchers are told when one comes, goes or turns to another thing."""

    _here: dict[str, Presence] = field(default_factory=dict)
    _listeners: list[Callable[[], None]] = field(default_factory=list)

    def join(self, window: str, person: User) -> None:
        """A window was opened."""
        self._here[window] = Presence(window=window, user=person)
        self._tell()

    def leave(self, window: str) -> None:
        """A window was closed."""
        if self._here.pop(window, None) is not None:
            self._tell()

    def update(self, window: str, **changes: Any) -> None:
        """Somebody turned to other things: `user`, `selected`, `editing_path` or `pointer` of the presence change."""
        before = self._here.get(window)
        if before is not None and (now := replace(before, **changes)) != before:
            self._here[window] = now
            self._tell()

    @property
    def presences(self) -> tuple[Presence, ...]:
        """Every window, in the order in which they came."""
        return tuple(self._here.values())

    def others(self, window: str) -> tuple[Presence, ...]:
        """All windows but one, those of the same person too."""
        return tuple(each for each in self._here.values() if each.window != window)

    def names_editing(self, path: DesignPath, window: str) -> tuple[str, ...]:
        """The names of those who type in a field in other windows."""
        names = (each.user.name for each in self.others(window) if path and each.editing_path == path)
        return tuple(dict.fromkeys(names))

    def subscribe(self, watcher: Callable[[], None]) -> Callable[[], None]:
        """Tell `watcher` after every change; what is returned ends it."""
        self._listeners.append(watcher)
        return lambda: self._listeners.remove(watcher) if watcher in self._listeners else None

    def _tell(self) -> None:
        for watcher in tuple(self._listeners):
            watcher()


def clean_name(name: str) -> str:
    """A name as it may be shown: in one line, of letters that can be seen, not too long."""
    seen = "".join(letter if letter.isprintable() else " " for letter in name)
    return " ".join(seen.split())[:_MAX_NAME_LENGTH].strip()
