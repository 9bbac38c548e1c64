"""Which lines of a text belong to which member of a block: its own, and the comments that go with it."""

from dataclasses import dataclass

from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlSequence


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberSpan:
    """A member's characters from `start` (its comments above) to `end`, past its last line break.

    `key_start` is where its key or dash stands, `is_inline` whether something else stands before it on that line.
    """

    start: int
    key_start: int
    end: int
    is_inline: bool


def find_member_spans(text: str, node: YamlMapping | YamlSequence, floor: int | None, limit: int) -> list[MemberSpan]:
    """The regions of a block's members.

    Args:
        text: The file.
        node: A mapping or list in block style.
        floor: The colon or dash that the block follows; None for the document, whose head is nobody's comment.
        limit: Where what belongs to the block ends.
    """
    firsts = _key_starts(text, node)
    values = [value for _key, value in node.pairs] if isinstance(node, YamlMapping) else list(node.items)
    column = firsts[0] - line_start(text, firsts[0])
    regions: list[MemberSpan] = []
    free = line_start(text, firsts[0]) if floor is None else next_line_start(text, floor)
    for number, value in enumerate(values):
        first = firsts[number]
        own_line = line_start(text, first)
        until = line_start(text, firsts[number + 1]) if number + 1 < len(firsts) else limit
        end = _end_of_deeper_comments(text, next_line_start(text, max(value.end, first)), until, column)
        is_inline = bool(text[own_line:first].strip(" "))
        start = first if is_inline else _first_attached_comment(text, own_line, free)
        regions.append(MemberSpan(start=start, key_start=first, end=end, is_inline=is_inline))
        free = end
    return regions


def line_start(text: str, offset: int) -> int:
    """Where the line of an offset begins; a byte order mark is not part of it."""
    start = text.rfind("\n", 0, offset) + 1
    return 1 if start == 0 and text.startswith("\ufeff") else start


def line_end(text: str, offset: int) -> int:
    """Where the line of an offset ends, before its line break."""
    end = text.find("\n", offset)
    end = len(text) if end < 0 else end
    return end - 1 if end > offset and text[end - 1] == "\r" else end


def next_line_start(text: str, offset: int) -> int:
    """Where the next line begins."""
    end = text.find("\n", offset)
    return len(text) if end < 0 else end + 1


def blank_lines_start(text: str, offset: int) -> int:
    """Where the blank lines directly above a line begin."""
    while offset > 0:
        above = text.rfind("\n", 0, offset - 1) + 1
        if text[above:offset].strip():
            break
        offset = above
    return offset


def _key_starts(text: str, node: YamlMapping | YamlSequence) -> list[int]:
    if isinstance(node, YamlMapping):
        # An explicit key begins with its question mark.
        return [_explicit_key_start(text, key) for key, _value in node.pairs]
    column = node.start - line_start(text, node.start)
    firsts = [node.start]
    for before, item in zip(node.items, node.items[1:], strict=False):
        firsts.append(_find_dash(text, before.end, item, column))
    return firsts


def _explicit_key_start(text: str, key: YamlNode) -> int:
    before = text[line_start(text, key.start) : key.start]
    return key.start - 2 if before.endswith("? ") else key.start


def _find_dash(text: str, after: int, item: YamlNode, column: int) -> int:
    """The dash of an item: the first line below the item before that has one in the list's column."""
    line = next_line_start(text, after)
    while line <= item.start:
        content = text[line : line_end(text, line)]
        if content[column : column + 1] == "-" and not content[:column].strip(" "):
            return line + column
        if next_line_start(text, line) <= line:
            break
        line = next_line_start(text, line)
    return item.start


def _end_of_deeper_comments(text: str, offset: int, until: int, column: int) -> int:
    """Past the comments that are indented deeper than the block: they belong to what stands above."""
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


def _first_attached_comment(text: str, line: int, free: int) -> int:
    """Where the comments directly above a line begin; they do not reach above `free`."""
    while line > free:
        above = line_start(text, line - 1)
        if above < free or not text[above:line].strip().startswith("#"):
            break
        line = above
    return line
