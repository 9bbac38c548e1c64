"""Comments of a file of XABSL, which become remarks beside the things of a design they stand before."""

import textwrap
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence

from vicode.findings import DesignPath
from vicode.importers.declarations import PlacedComment
from vicode.xabsl.lexer import Comment

Anchor = tuple[int, DesignPath]
"""The number of a token, and the path of the thing that begins with it."""


def comment_text(comments: Iterable[Comment]) -> str:
    """What comments say, without their signs."""
    return "\n".join(_plain(each.text) for each in comments).strip()


def looks_like_code(text: str) -> bool:
    """Whether a comment holds code that was set aside rather than words."""
    return any(sign in text for sign in ";{}") or "goto " in text


def place_comments(comments: dict[int, list[Comment]], anchors: Sequence[Anchor]) -> Iterator[PlacedComment]:
    """Where each comment belongs: at what follows it, or behind what stands before it in its line."""
    ordered = sorted(anchors, key=lambda anchor: anchor[0])
    starts = [token for token, _path in ordered]
    for token, group in sorted(comments.items()):
        for comment in group:
            text = _plain(comment.text)
            if not text.strip():
                continue
            at = bisect_left(starts, token)
            if (not comment.own_line and at) or at == len(ordered):
                at -= 1
            yield (ordered[at][1] if ordered else (), text)


def _plain(text: str) -> str:
    if text.startswith("//"):
        return text.lstrip("/").removeprefix(" ").rstrip()
    lines = text.removeprefix("/*").removesuffix("*/").strip("*").expandtabs(4).splitlines()
    if all(line.strip().startswith("*") or not line.strip() for line in lines[1:]):
        lines = [line.strip().removeprefix("*").removeprefix(" ") for line in lines]
    return textwrap.dedent("\n".join([line.rstrip() for line in lines])).strip("\n")
