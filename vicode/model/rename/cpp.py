"""Renames in hand-written C++ where it is certain what is meant: by its tokens, never in strings and comments.

What a component has is said there as `this->NAME`, what another one has as `this->ALIAS.NAME`, an element as
`Enumeration::element`. A name by itself may be anything, and is left to a person.
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
    """The code with the new name."""
    if rename.old not in text:
        return text
    pieces, end = [], 0
    for token in _find_references(list(_tokens(text)), role, rename):
        pieces += [text[end : token.start], rename.new]
        end = token.start + len(token.text)
    return "".join([*pieces, text[end:]])


def has_reference_in_cpp(text: str, role: str, rename: ReferenceRename) -> bool:
    """Whether code says a name already."""
    return rename_in_cpp(text, role, rename) != text


def declares_in_cpp(text: str, name: str) -> bool:
    """Whether code gives a type or a namespace this name."""
    tokens = list(_tokens(text)) if name in text else []
    return any(token.text == name and _is_declared(tokens, at) for at, token in enumerate(tokens))


def count_identifier_in_cpp(text: str, name: str) -> int:
    """How often a name stands in code, whatever it means there."""
    return sum(token.is_word and token.text == name for token in _tokens(text)) if name in text else 0


def _tokens(text: str) -> Iterator[_Token]:
    for match in _TOKEN.finditer(text):
        if not match["skipped"]:
            yield _Token(match.start(), match.group(), bool(match["word"]))


def _find_references(tokens: list[_Token], role: str, said: ReferenceRename) -> Iterator[_Token]:
    owner = said.owner or said.old
    is_shared = said.kind in (ReferenceKind.ENUMERATION, ReferenceKind.ELEMENT)
    has_types = any(token.text in _TYPE_KEYWORDS for token in tokens)
    if is_shared and any(token.text == owner and _is_declared(tokens, at) for at, token in enumerate(tokens)):
        return
    # Where a type is written, `this` may be another thing.
    if not is_shared and (role == "module" or has_types):
        return
    for at, token in enumerate(tokens):
        if token.is_word and token.text == said.old and _is_reference(tokens, at, said):
            yield token


def _is_reference(tokens: list[_Token], at: int, said: ReferenceRename) -> bool:
    before = [_text_at(tokens, at - step) for step in (1, 2, 3, 4)]
    match said.kind:
        case ReferenceKind.OWN | ReferenceKind.ALIAS:
            return before[:2] == ["->", "this"]
        case ReferenceKind.MEMBER:
            return before[0] in (".", "->") and before[1:] == [said.owner, "->", "this"]
        case ReferenceKind.ELEMENT:
            return before[:2] == ["::", said.owner] and before[2] not in ("::", ".", "->")
        case ReferenceKind.ENUMERATION:
            return _text_at(tokens, at + 1) == "::" and before[0] not in ("::", ".", "->")
        case _:
            return False


def _is_declared(tokens: list[_Token], at: int) -> bool:
    """Whether the words before a name declare it."""
    while at > 0 and tokens[at - 1].text not in _DECLARATION_STARTS:
        at -= 1
        if tokens[at].text in _DECLARING_KEYWORDS:
            return True
    return False


def _text_at(tokens: list[_Token], at: int) -> str:
    return tokens[at].text if 0 <= at < len(tokens) else ""
