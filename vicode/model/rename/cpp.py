"""Renaming in hand-written C++, based on tokens outside strings and comments.

Only unambiguous references are renamed: `this->NAME` for members of the component, `this->ALIAS.NAME` for members of
a used component, and `Enumeration::element`. Unqualified names are ambiguous.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from vicode.model.rename.references import ReferenceKind, ReferenceRename

_TOKEN = re.compile(
    r"""
      (?P<skipped>//(?:\\\r?\n|[^\n])* | /\*.*?(?:\*/|\Z)
        | (?:u8|[uUL])?R"(?P<mark>[^\s()\\"]{0,16})\(.*?(?:\)(?P=mark)"|\Z)
        | "(?:\\.|[^"\\\n])*"? | '(?:\\.|[^'\\\n])*'?)
    | (?P<word>[^\W\d]\w*)
    | (?P<number>\.?\d(?:'?[\w.])*)
    | (?P<sign>::|->|\S)
    """,
    re.VERBOSE | re.DOTALL,
)
_TYPE_KEYWORDS = frozenset(("struct", "class", "union"))
_DECLARING_KEYWORDS = frozenset((*_TYPE_KEYWORDS, "enum", "namespace", "using", "typename", "typedef"))
_DECLARATION_STARTS = frozenset((";", "{", "}", ":", "="))


@dataclass(frozen=True, slots=True)
class _Token:
    start: int
    text: str
    is_word: bool


def rename_in_cpp(text: str, role: str, rename: ReferenceRename) -> str:
    if rename.old not in text:
        return text
    pieces, end = [], 0
    for token in _find_references(list(_tokens(text)), role, rename):
        pieces += [text[end : token.start], rename.new]
        end = token.start + len(token.text)
    return "".join([*pieces, text[end:]])


def has_reference_in_cpp(text: str, role: str, rename: ReferenceRename) -> bool:
    return rename_in_cpp(text, role, rename) != text


def declares_in_cpp(text: str, name: str) -> bool:
    """Return whether code declares a type or namespace with this name."""
    tokens = list(_tokens(text)) if name in text else []
    return any(token.text == name and _is_declared(tokens, index) for index, token in enumerate(tokens))


def count_identifier_in_cpp(text: str, name: str) -> int:
    """Count the occurrences of an identifier, regardless of its meaning."""
    return sum(token.is_word and token.text == name for token in _tokens(text)) if name in text else 0


def _tokens(text: str) -> Iterator[_Token]:
    for match in _TOKEN.finditer(text):
        if not match["skipped"]:
            yield _Token(match.start(), match.group(), bool(match["word"]))


def _find_references(tokens: list[_Token], role: str, rename: ReferenceRename) -> Iterator[_Token]:
    owner = rename.owner or rename.old
    is_shared = rename.kind in (ReferenceKind.ENUMERATION, ReferenceKind.ELEMENT)
    has_types = any(token.text in _TYPE_KEYWORDS for token in tokens)
    if is_shared and any(token.text == owner and _is_declared(tokens, index) for index, token in enumerate(tokens)):
        return
    # In code that declares a type, `this` may refer to another object.
    if not is_shared and (role == "module" or has_types):
        return
    for index, token in enumerate(tokens):
        if token.is_word and token.text == rename.old and _is_reference(tokens, index, rename):
            yield token


def _is_reference(tokens: list[_Token], index: int, rename: ReferenceRename) -> bool:
    before = [_text_at(tokens, index - step) for step in (1, 2, 3, 4)]
    match rename.kind:
        case ReferenceKind.OWN | ReferenceKind.ALIAS:
            return before[:2] == ["->", "this"]
        case ReferenceKind.MEMBER:
            return before[0] in (".", "->") and before[1:] == [rename.owner, "->", "this"]
        case ReferenceKind.ELEMENT:
            return before[:2] == ["::", rename.owner] and before[2] not in ("::", ".", "->")
        case ReferenceKind.ENUMERATION:
            return _text_at(tokens, index + 1) == "::" and before[0] not in ("::", ".", "->")
        case _:
            return False


def _is_declared(tokens: list[_Token], index: int) -> bool:
    """Return whether a declaring keyword precedes a name."""
    while index > 0 and tokens[index - 1].text not in _DECLARATION_STARTS:
        index -= 1
        if tokens[index].text in _DECLARING_KEYWORDS:
            return True
    return False


def _text_at(tokens: list[_Token], index: int) -> str:
    return tokens[index].text if 0 <= index < len(tokens) else ""
