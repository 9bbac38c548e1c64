"""Renames in hand-written C++ where it is certain what is meant: by its tokens, never in strings and comments.

What a component has is said there as `this->NAME`, what another one has as `this->ALIAS.NAME`, an element as
`Enumeration::element`. A name by itself may be anything, and is left to a person.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from vicode.model.renaming.names import Said, Way

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
_TYPES = frozenset(("struct", "class", "union"))
_DECLARING = frozenset((*_TYPES, "enum", "namespace", "using", "typename", "typedef"))
_ENDS = frozenset((";", "{", "}", ":", "="))


@dataclass(frozen=True, slots=True)
class _Token:
    start: int
    text: str
    is_word: bool


def rename_in_cpp(text: str, role: str, said: Said) -> str:
    """The code with the new name."""
    if said.old not in text:
        return text
    pieces, end = [], 0
    for token in _places(list(_tokens(text)), role, said):
        pieces += [text[end : token.start], said.new]
        end = token.start + len(token.text)
    return "".join([*pieces, text[end:]])


def says_in_cpp(text: str, role: str, said: Said) -> bool:
    """Whether code says a name already."""
    return rename_in_cpp(text, role, said) != text


def binds_in_cpp(text: str, name: str) -> bool:
    """Whether code gives a type or a namespace this name."""
    tokens = list(_tokens(text)) if name in text else []
    return any(token.text == name and _is_declared(tokens, at) for at, token in enumerate(tokens))


def count_in_cpp(text: str, name: str) -> int:
    """How often a name stands in code, whatever it means there."""
    return sum(token.is_word and token.text == name for token in _tokens(text)) if name in text else 0


def _tokens(text: str) -> Iterator[_Token]:
    for match in _TOKEN.finditer(text):
        if not match["skipped"]:
            yield _Token(match.start(), match.group(), bool(match["word"]))


def _places(tokens: list[_Token], role: str, said: Said) -> Iterator[_Token]:
    owner = said.owner or said.old
    is_shared = said.way in (Way.ENUMERATION, Way.ELEMENT)
    has_types = any(token.text in _TYPES for token in tokens)
    if is_shared and any(token.text == owner and _is_declared(tokens, at) for at, token in enumerate(tokens)):
        return
    # Where a type is written, `this` may be another thing.
    if not is_shared and (role == "module" or has_types):
        return
    for at, token in enumerate(tokens):
        if token.is_word and token.text == said.old and _is_said(tokens, at, said):
            yield token


def _is_said(tokens: list[_Token], at: int, said: Said) -> bool:
    before = [_sign(tokens, at - step) for step in (1, 2, 3, 4)]
    match said.way:
        case Way.OWN | Way.ALIAS:
            return before[:2] == ["->", "this"]
        case Way.MEMBER:
            return before[0] in (".", "->") and before[1:] == [said.owner, "->", "this"]
        case Way.ELEMENT:
            return before[:2] == ["::", said.owner] and before[2] not in ("::", ".", "->")
        case Way.ENUMERATION:
            return _sign(tokens, at + 1) == "::" and before[0] not in ("::", ".", "->")
        case _:
            return False


def _is_declared(tokens: list[_Token], at: int) -> bool:
    """Whether the words before a name declare it."""
    while at > 0 and tokens[at - 1].text not in _ENDS:
        at -= 1
        if tokens[at].text in _DECLARING:
            return True
    return False


def _sign(tokens: list[_Token], at: int) -> str:
    return tokens[at].text if 0 <= at < len(tokens) else ""
