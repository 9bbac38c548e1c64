"""Finds the lines of each member of a block collection, including its comments.

YAML gives comments no place in the tree, but people do: a comment directly above a member, or deeper below it, moves
and goes with it. Other comments, such as one with a blank line below it, belong to no member and stay.
"""

from dataclasses import dataclass

from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlSequence


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberSpan:
    """The span of a member.

    Attributes:
        start: Offset of the member or of the comments above it.
        key_start: Offset of its key or dash.
        end: Offset after its last line break.
        is_inline: Whether its line starts with something else, such as the dash of a list.
    """

    start: int
    key_start: int
    end: int
    is_inline: bool


def find_member_spans(text: str, node: YamlMapping | YamlSequence, floor: int | None, limit: int) -> list[MemberSpan]:
    """The spans of the members of a block collection.

    Args:
        text: The text of the file.
        node: A mapping or list in block style.
        floor: Offset of the colon or dash before the block; None for the document, whose head comment has no member.
        limit: End offset of the block.
    """
    key_starts = _key_starts(text, node)
    values = [value for _key, value in node.pairs] if isinstance(node, YamlMapping) else list(node.items)
    column = key_starts[0] - line_start(text, key_starts[0])
    spans: list[MemberSpan] = []
    free = line_start(text, key_starts[0]) if floor is None else next_line_start(text, floor)
    for index, value in enumerate(values):
        key_start = key_starts[index]
        own_line_start = line_start(text, key_start)
        until = line_start(text, key_starts[index + 1]) if index + 1 < len(key_starts) else limit
        end = end_of_deeper_comments(text, next_line_start(text, max(value.end, key_start)), until, column)
        is_inline = bool(text[own_line_start:key_start].strip(" "))
        start = key_start if is_inline else first_attached_comment(text, own_line_start, free)
        spans.append(MemberSpan(start=start, key_start=key_start, end=end, is_inline=is_inline))
        free = end
    return spans


def line_start(text: str, offset: int) -> int:
    """Start of the line of an offset, after a byte order mark."""
    start = text.rfind("\n", 0, offset) + 1
    return 1 if start == 0 and text.startswith("\ufeff") else start


def line_end(text: str, offset: int) -> int:
    """End of the line of an offset, before its line break."""
    end = text.find("\n", offset)
    end = len(text) if end < 0 else end
    return end - 1 if end > offset and text[end - 1] == "\r" else end


def next_line_start(text: str, offset: int) -> int:
    end = text.find("\n", offset)
    return len(text) if end < 0 else end + 1


def blank_lines_start(text: str, offset: int) -> int:
    """Start of the blank lines directly above a line."""
    while offset > 0:
        above = text.rfind("\n", 0, offset - 1) + 1
        if text[above:offset].strip():
            break
        offset = above
    return offset


def _key_starts(text: str, node: YamlMapping | YamlSequence) -> list[int]:
    if isinstance(node, YamlMapping):
        # The question mark of an explicit key is part of the key.
        return [_explicit_key_start(text, key) for key, _value in node.pairs]
    column = node.start - line_start(text, node.start)
    key_starts = [node.start]
    for before, item in zip(node.items, node.items[1:], strict=False):
        key_starts.append(_find_dash(text, before.end, item, column))
    return key_starts


def _explicit_key_start(text: str, key: YamlNode) -> int:
    before = text[line_start(text, key.start) : key.start]
    return key.start - 2 if before.endswith("? ") else key.start


def _find_dash(text: str, after: int, item: YamlNode, column: int) -> int:
    """Offset of the dash of an item: the first dash in the column of the list after the previous item."""
    line = next_line_start(text, after)
    while line <= item.start:
        content = text[line : line_end(text, line)]
        if content[column : column + 1] == "-" and not content[:column].strip(" "):
            return line + column
        if next_line_start(text, line) <= line:
            break
        line = next_line_start(text, line)
    return item.start


def end_of_deeper_comments(text: str, offset: int, until: int, column: int) -> int:
    """End of the comments that are indented deeper than the block: they belong to the member above."""
    end = offset
    while offset < until:
        content = text[offset : line_end(text, offset)]
        depth = len(content) - len(content.lstrip(" "))
        if content.strip() and (not content.strip().startswith("#") or depth <= column):
            break
        offset = next_line_start(text, offset)
        if content.strip():
            end = offset
    return end


def first_attached_comment(text: str, line: int, free: int) -> int:
    """Start of the comments directly above a line, but not before `free`."""
    while line > free:
        above = line_start(text, line - 1)
        if above < free or not text[above:line].strip().startswith("#"):
            break
        line = above
    return line
