"""Map comments of an XABSL file to the design elements they precede."""

import textwrap
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence

from vicode.findings import DesignPath
from vicode.importers.declarations import PlacedComment
from vicode.xabsl.lexer import Comment

Anchor = tuple[int, DesignPath]
"""The index of a token and the path of the design element that starts there."""


def comment_text(comments: Iterable[Comment]) -> str:
    """Join the text of comments without the comment markers."""
    return "\n".join(_plain(comment.text) for comment in comments).strip()


def group_comments(comments: Iterable[Comment]) -> list[list[Comment]]:
    """Group comments: consecutive lines form one text, a block comment is a separate one."""
    groups: list[list[Comment]] = []
    for comment in comments:
        is_line = comment.text.startswith("//")
        if groups and is_line and not comment.after_blank_line and groups[-1][-1].text.startswith("//"):
            groups[-1].append(comment)
        else:
            groups.append([comment])
    return groups


def looks_like_code(text: str) -> bool:
    """Whether a comment contains commented-out code."""
    return any(sign in text for sign in ";{}") or "goto " in text


def place_comments(comments: dict[int, list[Comment]], anchors: Sequence[Anchor]) -> Iterator[PlacedComment]:
    """Assign each comment to the following element, or to the preceding one if it is on the same line."""
    ordered = sorted(anchors, key=lambda anchor: anchor[0])
    starts = [token for token, _path in ordered]
    for token, group in sorted(comments.items()):
        for comment in group:
            text = _plain(comment.text)
            if not text.strip():
                continue
            index = bisect_left(starts, token)
            if (not comment.own_line and index) or index == len(ordered):
                index -= 1
            yield (ordered[index][1] if ordered else (), text)


def _plain(text: str) -> str:
    if text.startswith("//"):
        return text.lstrip("/").removeprefix(" ").rstrip()
    lines = text.removeprefix("/*").removesuffix("*/").strip("*").expandtabs(4).splitlines()
    if all(line.strip().startswith("*") or not line.strip() for line in lines[1:]):
        lines = [line.strip().removeprefix("*").removeprefix(" ") for line in lines]
    return textwrap.dedent("\n".join([line.rstrip() for line in lines])).strip("\n")
