"""Print option files; texts from designs become escaped descriptions and comments."""

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
    """A comment on the line before a node, or on the same line after it."""

    node: tree.SyntaxNode
    comment: Comment
    is_behind: bool = False


def wrap_description(text: str, depth: int) -> str:
    """Format a text as a description, wrapped and indented for the nesting depth."""
    margin = " " * (2 * depth + 4)
    words = description_line(text)
    return textwrap.fill(words, _WIDTH, subsequent_indent=margin, break_long_words=False, break_on_hyphens=False)


def description_line(text: str) -> str:
    return " ".join(_printable(text).split()).replace("*/", "* /").replace("/*", "/ *")


def title_text(text: str) -> str:
    return " ".join(_printable(text).split()).replace('"', "'")


def header_comment(lines: Iterable[str]) -> str:
    return "\n".join(_printable(line).replace("*/", "* /") for line in lines)


def attach_comment(node: tree.SyntaxNode, text: str) -> Iterator[AttachedComment]:
    """Format a text as comment lines before a node."""
    words = " ".join(_printable(text).split())
    for line in textwrap.wrap(words, _WIDTH, break_long_words=False, break_on_hyphens=False):
        yield AttachedComment(node, Comment(f"// {line}", own_line=True))


def print_option(option: tree.OptionNode, comments: Iterable[AttachedComment]) -> str:
    file = tree.FileNode(body=[option])
    attached_comments = list(comments)
    if attached_comments:
        parsed = parse(print_file(file)).file
        parsed_nodes = {id(built): node for built, node in pair_nodes(option, parsed.body[0])}
        for attached in attached_comments:
            node = parsed_nodes[id(attached.node)]
            token = node.last_token + 1 if attached.is_behind else _first_token(option, attached.node, node.first_token)
            comment = Comment(attached.comment.text, own_line=not attached.is_behind)
            file.comments.setdefault(token, []).append(comment)
    return print_file(file)


def pair_nodes(built: tree.SyntaxNode, parsed: tree.SyntaxNode) -> Iterator[tuple[tree.SyntaxNode, tree.SyntaxNode]]:
    """Pair the nodes of a built tree with those of the tree parsed from its text."""
    yield built, parsed
    for field in fields(built):
        left, right = getattr(built, field.name), getattr(parsed, field.name)
        if isinstance(left, tree.SyntaxNode) and isinstance(right, tree.SyntaxNode):
            yield from pair_nodes(left, right)
        elif isinstance(left, list):
            for left_item, right_item in zip(left, right, strict=True):
                yield from pair_nodes(left_item, right_item)


def parse_option(text: str) -> tuple[ParsedFile, tree.OptionNode | None]:
    """Parse a file; the option is None if the file is not a valid option file."""
    parsed = parse(text)
    body = parsed.file.body
    return parsed, body[0] if len(body) == 1 and isinstance(body[0], tree.OptionNode) and not parsed.findings else None


def _first_token(option: tree.OptionNode, node: tree.SyntaxNode, token: int) -> int:
    """Return the first token including the keywords before the opening brace."""
    if node is option.common_decision:
        return token - 3
    return token - 2 if node is option.common_actions else token


def _printable(text: str) -> str:
    """Replace non-printable characters and escape region marks."""
    printable = "".join(char if char.isprintable() else " " for char in text)
    return escape_marks(printable)
