"""Trees as texts of files, with people's words as descriptions and comments that nothing in them can end."""

import textwrap
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields

from vicode.regions import defuse
from vicode.xabsl import tree
from vicode.xabsl.lexer import Comment
from vicode.xabsl.parser import Parsed, parse
from vicode.xabsl.printer import print_file

_WIDTH = 100


@dataclass(frozen=True, slots=True)
class Remark:
    """A comment on the lines before a node, or behind it."""

    node: tree.Node
    comment: Comment
    is_behind: bool = False


def said(text: str, depth: int) -> str:
    """A person's words as a description: in one line, or with its later lines under the first."""
    margin = " " * (2 * depth + 4)
    words = in_one_line(text)
    return textwrap.fill(words, _WIDTH, subsequent_indent=margin, break_long_words=False, break_on_hyphens=False)


def in_one_line(text: str) -> str:
    """A person's words as a description."""
    return " ".join(_plain(text).split()).replace("*/", "* /").replace("/*", "/ *")


def title(text: str) -> str:
    """A person's words between quotes."""
    return " ".join(_plain(text).split()).replace('"', "'")


def first_comment(lines: Iterable[str]) -> str:
    """A person's words as the first comment of a file."""
    return "\n".join(_plain(line).replace("*/", "* /") for line in lines)


def remark(node: tree.Node, text: str) -> Iterator[Remark]:
    """A person's words as lines of comment before a node."""
    words = " ".join(_plain(text).split())
    for line in textwrap.wrap(words, _WIDTH, break_long_words=False, break_on_hyphens=False):
        yield Remark(node, Comment(f"// {line}", own_line=True))


def print_option(option: tree.Option, remarks: Iterable[Remark]) -> str:
    """The text of an option's file with its comments."""
    file = tree.File(body=[option])
    waiting = list(remarks)
    if waiting:
        read = parse(print_file(file)).file
        places = {id(made): found for made, found in pairs(option, read.body[0])}
        for each in waiting:
            found = places[id(each.node)]
            token = found.to + 1 if each.is_behind else _begin_of(option, each.node, found.at)
            comment = Comment(each.comment.text, own_line=not each.is_behind)
            file.comments.setdefault(token, []).append(comment)
    return print_file(file)


def pairs(made: tree.Node, read: tree.Node) -> Iterator[tuple[tree.Node, tree.Node]]:
    """Nodes of a tree that was made, each with the one that its text was read as."""
    yield made, read
    for each in fields(made):
        mine, theirs = getattr(made, each.name), getattr(read, each.name)
        if isinstance(mine, tree.Node) and isinstance(theirs, tree.Node):
            yield from pairs(mine, theirs)
        elif isinstance(mine, list):
            for one, other in zip(mine, theirs, strict=True):
                yield from pairs(one, other)


def read_option(text: str) -> tuple[Parsed, tree.Option | None]:
    """A text that may be the file of an option."""
    parsed = parse(text)
    body = parsed.file.body
    return parsed, body[0] if len(body) == 1 and isinstance(body[0], tree.Option) and not parsed.findings else None


def _begin_of(option: tree.Option, node: tree.Node, at: int) -> int:
    """The token that a thing begins with for who reads: words before its brace belong to it."""
    if node is option.common_decision:
        return at - 3
    return at - 2 if node is option.common_actions else at


def _plain(text: str) -> str:
    """Printable characters, nothing that could pass for a mark."""
    blanks = "".join(char if char.isprintable() else " " for char in text)
    return defuse(blanks)
