"""Semantic tokens: every name by what it refers to, and all other tokens by their kind."""

from collections.abc import Iterator
from itertools import pairwise

from lsprotocol import types as lsp

from vicode.xabsl.lexer import Tokens
from vicode.xabsl.server.open_behavior import OpenBehavior
from vicode.xabsl.server.positions import line_starts, position_at, utf16_length
from vicode.xabsl.symbol_table import Definition
from vicode.xabsl.tokens import KEYWORDS, TOKEN_PATTERN

_ROLES = {
    "option": "class",
    "behavior": "function",
    "input": "variable",
    "output": "property",
    "internal": "property",
    "const": "variable",
    "parameter": "parameter",
    "enum": "enum",
    "element": "enumMember",
    "state": "label",
    "agent": "class",
}
_GROUPS = {
    **dict.fromkeys(("line", "initial", "doc", "block"), "comment"),
    "string": "string",
    "number": "number",
    "range": "number",
}
_READONLY = frozenset(("input", "const", "element"))
_TYPES = tuple(dict.fromkeys((*_ROLES.values(), *_GROUPS.values(), "keyword")))
_DECLARATION, _READONLY_BIT = 1, 2

LEGEND = lsp.SemanticTokensLegend(token_types=list(_TYPES), token_modifiers=["declaration", "readonly"])


def semantic_tokens(behavior: OpenBehavior, tokens: Tokens) -> list[int]:
    """The tokens of a file in the relative encoding of the protocol."""
    data: list[int] = []
    line, column = 0, 0
    for start, end, type_name, modifiers in _classified(behavior, tokens):
        for first, last in _split_lines(tokens.text, start, end):
            position = position_at(tokens.text, first)
            same_line = position.line == line
            data += (
                position.line - line,
                position.character - column if same_line else position.character,
                utf16_length(tokens.text[first:last]),
                _TYPES.index(type_name),
                modifiers,
            )
            line, column = position.line, position.character
    return data


def _classified(behavior: OpenBehavior, tokens: Tokens) -> Iterator[tuple[int, int, str, int]]:
    """Ranges of characters with the name of their type and their modifiers, in order."""
    names = {tokens.starts[number]: (number, definition) for number, definition in behavior.references_in(tokens)}
    for match in TOKEN_PATTERN.finditer(tokens.text):
        group = match.lastgroup or ""
        start, end = match.start(group), match.end()
        if group == "name" and start in names:
            number, definition = names[start]
            yield start, end, _ROLES[definition.role], _modifiers(tokens, number, definition)
        elif group == "name" and match[group] in KEYWORDS:
            yield start, end, "keyword", 0
        elif group in _GROUPS:
            yield start, end, _GROUPS[group], 0


def _modifiers(tokens: Tokens, number: int, definition: Definition) -> int:
    is_declaration = definition.tokens is tokens and definition.name_node.first_token == number
    return _DECLARATION * is_declaration + _READONLY_BIT * (definition.role in _READONLY)


def _split_lines(text: str, start: int, end: int) -> Iterator[tuple[int, int]]:
    """Split a range of characters at line breaks: tokens of the protocol do not span lines."""
    if "\n" not in text[start:end] and "\r" not in text[start:end]:
        yield start, end
        return
    first_line, last_line = position_at(text, start).line, position_at(text, end).line
    inner = line_starts(text)[first_line + 1 : last_line + 1]
    for first, last in pairwise((start, *inner, end)):
        stripped = text[first:last].rstrip("\r\n")
        if stripped:
            yield first, first + len(stripped)
