"""Whether two versions of a generated file differ in layout only."""

from collections.abc import Iterator, Sequence
from itertools import groupby

from vicode.cpp_tokens import iter_tokens, iter_words, number_value
from vicode.regions import has_header, strip_bodies
from vicode.sync.code_items import HEADER, IMPORT, CodeItem, ModulePart, imported_names, split_items, split_parts


def is_same_code(a: str, b: str, comment: str = "#") -> bool:
    """Whether two texts are the same code with the same comments outside of the bodies of their regions.

    Numbers are compared by value; in C++ only in generated code, where the type of a number changes no result unless
    it is divided or calculated with another number. Line breaks, indentation, quotes, brackets without a meaning, the
    order of imports and the header do not count.

    Args:
        a: One version of the file.
        b: The other.
        comment: The start of a comment, "#" (Python) or "//" (C++, XABSL).
    """
    if comment != "#":
        return a == b or _tokens(a, comment) == _tokens(b, comment)
    texts = [strip_bodies(_without_header(text)) for text in (a, b)]
    if texts[0] == texts[1]:
        return True
    parts = [split_parts(text.replace("\r\n", "\n").replace("\r", "\n")) for text in (a, b)]
    try:
        return _has_same_keys(*parts)
    except SyntaxError:
        pass
    try:
        return list(_python_keys(split_items(a))) == list(_python_keys(split_items(b)))
    except SyntaxError:
        return texts[0].split() == texts[1].split()


def _has_same_keys(a: Sequence[ModulePart], b: Sequence[ModulePart]) -> bool:
    """Whether the parts of two modules are the same code; equal parts at the start and the end are not read."""
    shorter = min(len(a), len(b))
    start = next((at for at in range(shorter) if not _is_same_part(a[at], b[at])), shorter)
    rest = shorter - start
    end = next((at for at in range(rest) if not _is_same_part(a[-1 - at], b[-1 - at])), rest)
    keys = [[key for part in side[start : len(side) - end] for key in _python_keys(part.split())] for side in (a, b)]
    return keys[0] == keys[1]


def _is_same_part(a: ModulePart, b: ModulePart) -> bool:
    return a.owner == b.owner and (a.text == b.text or strip_bodies(a.text) == strip_bodies(b.text))


def _python_keys(split: Sequence[CodeItem]) -> Iterator[object]:
    items = (item for item in split if item.kind != HEADER)
    for is_import, group in groupby(items, key=lambda item: item.kind == IMPORT):
        if is_import:
            yield _import_key(list(group))
        else:
            yield from (item.key for item in group)


def _import_key(items: list[CodeItem]) -> object:
    comments = sorted(comment for item in items for comment in item.comments)
    return (items[0].scope, items[0].depth, imported_names(items), comments)


def _tokens(text: str, comment: str) -> list[str]:
    is_generated = has_header(text)
    words = list(iter_words(strip_bodies(_without_header(text), comment)))
    if not is_generated:
        return [word for _is_number, word in words]
    return [
        plain_token(word) if is_number and not _is_typed(words, at) else word
        for at, (is_number, word) in enumerate(words)
    ]


def _is_typed(words: Sequence[tuple[bool, str]], at: int) -> bool:
    """Whether the result of a calculation may depend on the type of a number."""
    sides = (words[max(0, at - 2) : at][::-1], words[at + 1 : at + 3])
    return any(
        side[0][1] in ("/", "%") or (side[0][1] in ("+", "-", "*") and side[1][0]) for side in sides if len(side) == 2
    )


def find_tokens(text: str) -> Iterator[tuple[str, int]]:
    """Yield the tokens of C++ code with their lines."""
    line, end = 1, 0
    for token in iter_tokens(text):
        line, end = line + text.count("\n", end, token.start), token.start
        yield token.text, line


def plain_token(word: str) -> str:
    """Return a token as it is compared: numbers are equal by value."""
    value = number_value(word)
    if value is None:
        return word
    return str(int(value)) if abs(value) < 1e15 and value == int(value) else repr(value)


def _without_header(text: str) -> str:
    text = text.replace("\r\n", "\n")
    return text.partition("\n")[2] if has_header(text) else text
