"""Whether two versions of a generated file differ in layout only."""

import re
from collections.abc import Iterator
from itertools import groupby

from vicode.regions import has_header, strip_bodies
from vicode.sync.code_items import HEADER, IMPORT, CodeItem, imported_names, split_items

# Numbers of C++ may contain single quotes.
_TOKEN = re.compile(
    r"""(?P<comment>/\*.*?\*/|//[^\n]*)|"(?:[^"\\\n]|\\.)*"|\d(?:'?\w|\.(?=\d))*|'(?:[^'\\\n]|\\.)*'|\w+|[^\w\s]""",
    re.DOTALL,
)


def is_same_code(a: str, b: str, comment: str = "#") -> bool:
    """Whether two texts are the same code with the same comments outside of the bodies of their regions.

    Numbers are compared by value. Line breaks, indentation, quotes, brackets without a meaning, the order of imports
    and the header do not count.

    Args:
        a: One version of the file.
        b: The other.
        comment: The start of a comment, "#" (Python) or "//" (C++, XABSL).
    """
    if comment != "#":
        return _tokens(a, comment) == _tokens(b, comment)
    try:
        return list(_python_keys(a)) == list(_python_keys(b))
    except SyntaxError:
        return strip_bodies(_without_header(a)).split() == strip_bodies(_without_header(b)).split()


def _python_keys(text: str) -> Iterator[object]:
    items = (item for item in split_items(text) if item.kind != HEADER)
    for is_import, group in groupby(items, key=lambda item: item.kind == IMPORT):
        if is_import:
            yield _import_key(list(group))
        else:
            yield from (item.key for item in group)


def _import_key(items: list[CodeItem]) -> object:
    comments = sorted(comment for item in items for comment in item.comments)
    return (items[0].scope, items[0].depth, imported_names(items), comments)


def _tokens(text: str, comment: str) -> list[str]:
    return [plain_token(word) for word, _span in find_token_spans(strip_bodies(_without_header(text), comment))]


def find_token_spans(text: str) -> Iterator[tuple[str, tuple[int, int]]]:
    """The tokens of C++ code, with spaces in comments collapsed, and their places in the text."""
    for token in _TOKEN.finditer(text):
        yield " ".join(token[0].split()) if token["comment"] else token[0], token.span()


def find_tokens(text: str) -> Iterator[tuple[str, int]]:
    """The tokens of C++ code with their lines."""
    line, end = 1, 0
    for word, (start, _end) in find_token_spans(text):
        line, end = line + text.count("\n", end, start), start
        yield word, line


def plain_token(word: str) -> str:
    """A token as it is compared: numbers are equal by value."""
    text = word.replace("'", "")
    if text.isdecimal():
        return str(int(text))
    try:
        return repr(float(text)).removesuffix(".0") if text[:1].isdigit() else word
    except ValueError:
        return word


def _without_header(text: str) -> str:
    text = text.replace("\r\n", "\n")
    return text.partition("\n")[2] if has_header(text) else text
