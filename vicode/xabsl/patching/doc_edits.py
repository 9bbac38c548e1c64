"""Edits descriptions and comments word by word, so that their lines and markers stay."""

import re
from collections.abc import Sequence
from difflib import SequenceMatcher
from itertools import pairwise

from vicode.xabsl.patching.source_edits import SourceEdits

Span = tuple[int, int]


def edit_words(file: SourceEdits, spans: Sequence[Span], before: str, after: str) -> None:
    """Change the words of comments; if their text is not `before`, the comments are replaced.

    Args:
        file: The file.
        spans: The start and end of each comment.
        before: The text of the comments, without line breaks and markers.
        after: The new text.
    """
    words = [word for start, end in spans for word in _words(file.text, start, end)]
    if [file.text[start:end] for start, end in words] != before.split() or not words or not after.split():
        _replace(file, spans, after)
        return
    new = after.split()
    for tag, first, last, new_first, new_last in SequenceMatcher(
        None, before.split(), new, autojunk=False
    ).get_opcodes():
        text = " ".join(new[new_first:new_last])
        if tag == "insert":
            at = words[first - 1][1] if first else words[0][0]
            file.insert(at, f" {text}" if first else f"{text} ")
        elif tag == "replace":
            _replace_words(file, words[first:last], text)
        elif tag == "delete":
            _delete_words(file, words, first, last)


def last_spans_with_words(file: SourceEdits, spans: Sequence[Span], text: str) -> Sequence[Span]:
    """The last ones of several comments that together have this text; empty if there are none."""
    for first in reversed(range(len(spans))):
        words = (file.text[start:end] for span in spans[first:] for start, end in _words(file.text, *span))
        if list(words) == text.split():
            return spans[first:]
    return ()


def _words(text: str, start: int, end: int) -> list[Span]:
    """The words of a comment without its markers, as an import reads them."""
    inner = text[start:end]
    if inner.startswith("//"):
        first, last = start + len(inner) - len(inner.lstrip("/")), end
    elif inner.startswith("/**") and not inner.startswith("/***"):
        first, last = start + 3, end - 2
    else:
        stripped = inner[2:-2].rstrip("*")
        first, last = end - 2 - len(inner[2:-2].lstrip("*")), start + 2 + len(stripped)
        lines = text[first:last].split("\n")[1:]
        if all(not line.strip() or line.strip().startswith("*") for line in lines):
            return [span for span in _spans(text, first, last) if not _is_marker(text, *span)]
    return _spans(text, first, last)


def _spans(text: str, start: int, end: int) -> list[Span]:
    return [match.span() for match in re.compile(r"\S+").finditer(text, start, end)]


def _is_marker(text: str, start: int, end: int) -> bool:
    """Whether a word is the asterisk at the start of a line of a comment."""
    return text[start:end] == "*" and not text[text.rfind("\n", 0, start) + 1 : start].strip()


def _replace_words(file: SourceEdits, words: Sequence[Span], text: str) -> None:
    """Write the text in the place of the first word and delete the others.

    The space before a deleted word is deleted with it, unless the word is the first in its line: then the line break
    and the marker before it stay.
    """
    file.replace(*words[0], text)
    for (_, end), (start, stop) in pairwise(words):
        between = file.text[end:start]
        file.delete(start if "\n" in between else end, stop)


def _delete_words(file: SourceEdits, words: Sequence[Span], first: int, last: int) -> None:
    for index in range(first, last):
        start, end = words[index]
        if index and "\n" not in file.text[words[index - 1][1] : start]:
            start = words[index - 1][1]
        elif index + 1 < len(words) and "\n" not in file.text[end : words[index + 1][0]]:
            end = words[index + 1][0]
        file.delete(start, end)


def _replace(file: SourceEdits, spans: Sequence[Span], after: str) -> None:
    text = " ".join(after.split())
    for index, (start, end) in enumerate(spans):
        if index or not text:
            _remove_line(file, start, end)
        else:
            opening = re.match(r"/\*\*|/\*|//", file.text[start:])
            mark = opening[0] if opening else "//"
            file.overwrite(start, end, f"{mark} {text}" + (" */" if mark != "//" else ""))


def _remove_line(file: SourceEdits, start: int, end: int) -> None:
    line = file.text.rfind("\n", 0, start) + 1
    newline = file.text.find("\n", end)
    if newline >= 0 and not file.text[line:start].strip() and not file.text[end:newline].strip():
        file.delete(line, newline + 1)
    else:
        file.delete(start, end)
