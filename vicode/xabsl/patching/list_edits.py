"""Matches the items of two versions of a list, and edits the list in the original text.

The items that keep their order, a longest increasing subsequence of the matches, stay where they are. The others are
cut out with their comments, and inserted behind the item that precedes them now. So the text of a list changes as
little as its order, and a moved item keeps its layout and the edits in it.
"""

import re
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher

from vicode.matching import Match, find_unmoved, match_equal, match_similar
from vicode.xabsl import tree
from vicode.xabsl.patching.source_edits import SourceEdits

_BLANK_LINE_BEFORE = re.compile(r"\n[ \t\r]*\n\Z")
_BLANK_LINE_OR_END = re.compile(r"[ \t]*(?:\r?\n|\}|\Z)")


def match_items(
    old: Sequence[Hashable], new: Sequence[Hashable], similarity: Callable[[int, int], float]
) -> list[Match]:
    """For each new item the matching old one: equal items in order, equal items that moved, then similar ones.

    Args:
        old: The keys of the old items.
        new: The keys of the new items.
        similarity: The similarity of an old and a new item, from 0 to 1.
    """
    matches: list[Match] = [None] * len(new)
    match_equal(old, new, matches)
    match_similar(len(old), matches, similarity)
    return matches


def text_similarity(old: str, new: str) -> float:
    """The share of words that two texts have in common."""
    return SequenceMatcher(None, old.split(), new.split(), autojunk=False).ratio()


@dataclass(frozen=True, slots=True, kw_only=True)
class ListStyle:
    """Where a list stands in a file.

    Attributes:
        opening: The token before the first item, which starts the list.
        indent: The indentation of an item.
        unit: One level of indentation.
        has_blank_lines: Whether a blank line precedes each added item.
    """

    opening: int
    indent: str
    unit: str = "  "
    has_blank_lines: bool = False


@dataclass(frozen=True, slots=True)
class _Chunk:
    """The range of an item, in whole lines or within a line."""

    start: int
    end: int
    is_lines: bool


def edit_list(
    file: SourceEdits,
    items: Sequence[tree.SyntaxNode],
    matches: Sequence[Match],
    added: Sequence[str],
    style: ListStyle,
) -> None:
    """Remove, move and add items; matched items keep their text, with the edits in it.

    Args:
        file: The file of the list.
        items: The original items.
        matches: The original item of each new item.
        added: The text of each new item, empty if it is matched.
        style: Where the list stands.
    """
    chunks = [_chunk(file, item.first_token, item.last_token) for item in items]
    kept = find_unmoved(matches)
    texts = [
        _Text(file.read(chunks[match].start, chunks[match].end), chunks[match].is_lines)
        if match is not None
        else _Text(style.indent + text, is_lines=True)
        for match, text in zip(matches, added, strict=True)
    ]
    for index in range(len(items)):
        if index not in kept:
            _remove(file, chunks[index])
    if not items:
        if texts:
            _fill_empty_list(file, texts, style)
        return
    previous: Match = None
    for match, text in zip(matches, texts, strict=True):
        if match is not None and match in kept:
            previous = match
        else:
            _insert(file, chunks, previous, text, style)


@dataclass(frozen=True, slots=True)
class _Text:
    """The text of an item; with `is_lines` it starts with its indentation."""

    text: str
    is_lines: bool


def remove_item(file: SourceEdits, first: int, last: int) -> None:
    """Remove the tokens of an item, with the comments and one of the blank lines around it."""
    _remove(file, _chunk(file, first, last))


def _chunk(file: SourceEdits, first: int, last: int) -> _Chunk:
    start = file.start_with_comments(first)
    return _Chunk(start, file.end_with_comment(last), file.starts_line(first))


def _remove(file: SourceEdits, chunk: _Chunk) -> None:
    text, start, end = file.text, chunk.start, chunk.end
    if not chunk.is_lines:
        start = len(text[:start].rstrip(" \t"))
    elif not text[end:].split("\n", 1)[0].strip():
        newline = text.find("\n", end)
        end = len(text) if newline < 0 else newline + 1
        blank = _BLANK_LINE_BEFORE.search(text[:start])
        if blank and _BLANK_LINE_OR_END.match(text, end):
            start = blank.start() + 1
    file.delete(start, end)


def _insert(file: SourceEdits, chunks: Sequence[_Chunk], previous: Match, text: _Text, style: ListStyle) -> None:
    position = chunks[previous].end if previous is not None else file.end_with_comment(style.opening)
    plain = text.text.replace("\r\n", "\n")
    if not chunks[0].is_lines:
        _insert_inline(file, position, plain.strip(), style)
        return
    lines = plain if text.is_lines else style.indent + plain.strip()
    if previous is None and style.opening < 0:
        file.insert(chunks[0].start, lines + "\n")
    elif previous is not None:
        file.insert(position, ("\n\n" if style.has_blank_lines else "\n") + lines)
    else:
        # The first item keeps the blank lines and separators above it.
        file.insert(position, "\n" + lines + ("\n" if style.has_blank_lines else ""))


def _insert_inline(file: SourceEdits, position: int, text: str, style: ListStyle) -> None:
    """Insert an item into a line, or in its own lines if it has several."""
    is_lines = "\n" in text or file.text[:position].rsplit("\n", 1)[-1].count("//")
    gap = f"\n{style.indent}" if is_lines else "" if file.text[position - 1] == "(" else " "
    has_comment = "//" in text.rsplit("\n", 1)[-1]
    file.insert(position, gap + text + (f"\n{style.indent}" if has_comment else ""))


def _fill_empty_list(file: SourceEdits, texts: Sequence[_Text], style: ListStyle) -> None:
    lines = ("\n\n" if style.has_blank_lines else "\n").join(text.text for text in texts)
    closing, kind = file.start(style.opening + 1), file.tokens.kinds[style.opening + 1]
    if kind == ")":
        file.insert(file.end(style.opening), " ".join(text.text.strip() for text in texts))
    elif kind != "}":
        file.insert(file.end_with_comment(style.opening), f"\n{lines}\n")
    elif file.is_first_in_line(closing):
        file.insert(file.text.rfind("\n", 0, closing) + 1, lines + "\n")
    else:
        start = len(file.text[:closing].rstrip(" \t"))
        file.replace(start, closing, f"\n{lines}\n{file.indent_at(file.start(style.opening))}")
