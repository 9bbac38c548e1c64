"""What a text should come to say: the new value in the forms of the old text, kept where nothing changes."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class TargetKeep:
    """Leave the old node as it is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetScalar:
    """A single text; a `is_plain` one (number, truth) means another thing in quotes."""

    text: str
    is_plain: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetMember:
    """An item, or with a `key` a pair; `old` is its number in the old node, None for a new one."""

    value: "TargetNode"
    key: str | None = None
    old_index: int | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetCollection:
    """A mapping or a list; written in brackets when it fits into `flow_width` columns.

    `is_ordered`: the order of the members means something.
    """

    members: tuple[TargetMember, ...]
    is_mapping: bool
    flow_width: int
    is_ordered: bool = True


TargetNode = TargetKeep | TargetScalar | TargetCollection


def has_multiline_text(wish: TargetNode) -> bool:
    """Whether it holds a text of several lines."""
    if isinstance(wish, TargetScalar):
        return "\n" in wish.text
    return isinstance(wish, TargetCollection) and any(has_multiline_text(member.value) for member in wish.members)
