"""What a text should come to say: the new value in the forms of the old text, kept where nothing changes."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Kept:
    """Leave the old node as it is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Word:
    """A single text; a `bare` one (number, truth) means another thing in quotes."""

    text: str
    bare: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Member:
    """An item, or with a `key` a pair; `old` is its number in the old node, None for a new one."""

    value: "Wish"
    key: str | None = None
    old: int | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Members:
    """A mapping or a list; written in brackets when it fits into `width` columns.

    `is_ordered`: the order of the members means something.
    """

    members: tuple[Member, ...]
    is_mapping: bool
    width: int
    is_ordered: bool = True


Wish = Kept | Word | Members


def is_long(wish: Wish) -> bool:
    """Whether it holds a text of several lines."""
    if isinstance(wish, Word):
        return "\n" in wish.text
    return isinstance(wish, Members) and any(is_long(member.value) for member in wish.members)
