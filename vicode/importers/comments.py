"""Map comments of an XABSL file to the design elements they precede."""

import textwrap
from bisect import bisect_left
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from vicode.findings import DesignPath
from vicode.xabsl.lexer import Comment, Tokens
from vicode.xabsl.tokens import HEADER

Anchor = tuple[int, DesignPath]
"""The index of a token and the path of the design element that starts there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlacedComment:
    """A comment of an XABSL file and the design element above which the design shows it.

    Attributes:
        path: The path of the design element.
        text: The text without markers.
        token: The index of the token that the comment precedes.
        own_line: Whether it is the first text in its line.
        span: Its offsets in the file; None if it is not a comment there, such as the title of a namespace.
    """

    path: DesignPath
    text: str
    token: int = 0
    own_line: bool = True
    span: tuple[int, int] | None = None


@dataclass(slots=True)
class CommentPlaces:
    """The design elements of one file in the order of their tokens.

    Attributes:
        anchors: The tokens, each with the design element that shows the comments before it.
        starts: The tokens before which new comments of a design element are written.
    """

    anchors: list[Anchor] = field(default_factory=list)
    starts: dict[DesignPath, int] = field(default_factory=dict)

    def add(self, token: int, path: DesignPath) -> None:
        """Add a token before which comments of the element may be written."""
        self.anchors.append((token, path))
        self.starts.setdefault(path, token)

    def add_end(self, token: int, path: DesignPath) -> None:
        """Add a token that ends an element, such as a closing brace."""
        self.anchors.append((token, path))


def comment_text(comments: Iterable[Comment]) -> str:
    """Join the text of comments without the comment markers."""
    return "\n".join(plain_text(comment.text) for comment in comments).strip()


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


def place_comments(comments: dict[int, list[Comment]], places: CommentPlaces) -> Iterator[PlacedComment]:
    """Assign each comment to the following element, or to the preceding one if it is on the same line."""
    ordered = sorted(places.anchors, key=lambda anchor: anchor[0])
    tokens = [token for token, _path in ordered]
    for token, group in sorted(comments.items()):
        for comment in group:
            text = plain_text(comment.text)
            if not text.strip():
                continue
            index = bisect_left(tokens, token)
            if (not comment.own_line and index) or index == len(ordered):
                index -= 1
            path = ordered[index][1] if ordered else ()
            yield PlacedComment(path=path, text=text, token=token, own_line=comment.own_line, span=comment.span)


def place_header(tokens: Tokens, header: str, path: DesignPath = ()) -> Iterator[PlacedComment]:
    """The comment at the start of a file."""
    if header and tokens.kinds[0] == HEADER:
        start = tokens.starts[0]
        yield PlacedComment(path=path, text=header, span=(start, start + len(tokens.texts[0])))


def plain_text(text: str) -> str:
    """The text of a comment without markers."""
    if text.startswith("//"):
        return text.lstrip("/").removeprefix(" ").rstrip()
    lines = text.removeprefix("/*").removesuffix("*/").strip("*").expandtabs(4).splitlines()
    if all(line.strip().startswith("*") or not line.strip() for line in lines[1:]):
        lines = [line.strip().removeprefix("*").removeprefix(" ") for line in lines]
    return textwrap.dedent("\n".join([line.rstrip() for line in lines])).strip("\n")
