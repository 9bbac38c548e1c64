"""The target of a patch: the new value in the notation of the old text, with references to unchanged nodes."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class TargetKeep:
    """Keep the old node."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetScalar:
    """A scalar; `is_plain` if it must not be quoted, such as a number or boolean."""

    text: str
    is_plain: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetMember:
    """An item, or a pair if it has a `key`; `old_index` is its index in the old node, None if it is new."""

    value: "TargetNode"
    key: str | None = None
    old_index: int | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetCollection:
    """A mapping or list.

    Attributes:
        flow_width: Maximum line length for flow style, 0 for block style.
        is_ordered: Whether the order of the members is significant.
    """

    members: tuple[TargetMember, ...]
    is_mapping: bool
    flow_width: int
    is_ordered: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetMoved:
    """An item of a list that was elsewhere in the old text, with its comments.

    Attributes:
        lines: Its old lines, from the comments above it.
        column: The old column of its dash.
        target: Its value, if it must be written in another style.
    """

    lines: tuple[str, ...]
    column: int
    target: "TargetNode"


TargetNode = TargetKeep | TargetScalar | TargetCollection | TargetMoved


def has_multiline_text(target: TargetNode) -> bool:
    if isinstance(target, TargetScalar):
        return "\n" in target.text
    if isinstance(target, TargetMoved):
        return True
    return isinstance(target, TargetCollection) and any(has_multiline_text(member.value) for member in target.members)
