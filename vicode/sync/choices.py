"""The sides that a user chose for conflicts between generated files and designs."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

Side = Literal["file", "design"]
"""The side that wins a conflict."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Choices:
    """The chosen sides.

    Attributes:
        default: The side of all conflicts without a choice of their own; None leaves them.
        items: The sides of single conflicts, by the id of the region or by FILE:LINE, where FILE may be the last parts
            of its path.
    """

    default: Side | None = None
    items: tuple[tuple[str, Side], ...] = ()

    def find(self, names: Iterable[str]) -> Side | None:
        """The side of a conflict with these names."""
        sides = [side for item, side in self.items if any(is_named(item, name) for name in names)]
        return sides[-1] if sides else self.default

    def list_unused(self, names: Iterable[str]) -> tuple[str, ...]:
        """The items that name none of these conflicts."""
        known = tuple(names)
        return tuple(item for item, _side in self.items if not any(is_named(item, name) for name in known))


NO_CHOICES = Choices()


def is_named(item: str, name: str) -> bool:
    """Whether two names of a conflict are equal, or paths of which one is the end of the other."""
    return f"/{name}".endswith(f"/{item}") or f"/{item}".endswith(f"/{name}")


@dataclass(frozen=True, slots=True, kw_only=True)
class SettledConflict:
    """A conflict for which a side was chosen.

    Attributes:
        path: The generated file.
        names: The names of the conflict.
        side: The side that was kept.
        dropped: The text of the other side.
    """

    path: str
    names: tuple[str, ...]
    side: Side
    dropped: str
