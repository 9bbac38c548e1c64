"""Trees as texts of files, with people's words as descriptions and comments that nothing in them can end."""

import textwrap
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields

from vicode.regions import escape_marks
from vicode.xabsl import tree
from vicode.xabsl.lexer import Comment
from vicode.xabsl.parser import ParsedFile, parse
from vicode.xabsl.printer import print_file

_WIDTH = 100


@dataclass(frozen=True, slots=True)
class AttachedComment:
    """A comment on the lines before a node, or behind it."""

    node: tree.SyntaxNode
    comment: Comment
    is_behind: bool = False


def wrap_description(text: str, depth: int) -> str:
    """A person's words as a description: in one line, or with its later lines under the first."""
    margin = " " * (2 * depth + 4)
    words = description_line(text)
    return textwrap.fill(words, _WIDTH, subsequent_indent=margin, break_long_words=False, break_on_hyphens=False)


def description_line(text: str) -> str:
    """A person's words as a description."""
    return " ".join(_printable(text).split()).replace("*/", "* /").replace("/*", "/ *")


def title_text(text: str) -> str:
    """A person's words between quotes."""
    return " ".join(_printable(text).split()).replace('"', "'")


def header_comment(lines: Iterable[str]) -> str:
    """A person's words as the first comment of a file."""
    return "\n".join(_printable(line).replace("*/", "* /") for line in lines)


def attach_comment(node: tree.SyntaxNode, text: str) -> Iterator[AttachedComment]:
    """A person's words as lines of comment before a node."""
    words = " ".join(_printable(text).split())
    for line in textwrap.wrap(words, _WIDTH, break_long_words=False, break_on_hyphens=False):
        yield AttachedComment(node, Comment(f"// {line}", own_line=True))


def print_option(option: tree.OptionNode, comments: Iterable[AttachedComment]) -> str:
    """The text of an option's file with its comments."""
    file = tree.FileNode(body=[option])
    waiting = list(comments)
    if waiting:
        read = parse(print_file(file)).file
        places = {id(made): found for made, found in pair_nodes(option, read.body[0])}
        for each in waiting:
            found = places[id(each.node)]
            token = found.last_token + 1 if each.is_behind else _first_token(option, each.node, found.first_token)
            comment = Comment(each.comment.text, own_line=not each.is_behind)
            file.comments.setdefault(token, []).append(comment)
    return print_file(file)


def pair_nodes(built: tree.SyntaxNode, parsed: tree.SyntaxNode) -> Iterator[tuple[tree.SyntaxNode, tree.SyntaxNode]]:
    """Nodes of a tree that was made, each with the one that its text was read as."""
    yield built, parsed
    for each in fields(built):
        mine, theirs = getattr(built, each.name), getattr(parsed, each.name)
        if isinstance(mine, tree.SyntaxNode) and isinstance(theirs, tree.SyntaxNode):
            yield from pair_nodes(mine, theirs)
        elif isinstance(mine, list):
            for one, other in zip(mine, theirs, strict=True):
                yield from pair_nodes(one, other)


def parse_option(text: str) -> tuple[ParsedFile, tree.OptionNode | None]:
    """A text that may be the file of an option."""
    parsed = parse(text)
    body = parsed.file.body
    return parsed, body[0] if len(body) == 1 and isinstance(body[0], tree.OptionNode) and not parsed.findings else None


def _first_token(option: tree.OptionNode, node: tree.SyntaxNode, at: int) -> int:
    """The token that a thing begins with for who reads: words before its brace belong to it."""
    if node is option.common_decision:
        return at - 3
    return at - 2 if node is option.common_actions else at


def _printable(text: str) -> str:
    """Printable characters, nothing that could pass for a mark."""
    blanks = "".join(char if char.isprintable() else " " for char in text)
    return escape_marks(blanks)
