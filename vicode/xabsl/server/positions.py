"""Converts between offsets of characters and the positions of the Language Server Protocol, and paths and URIs."""

import re
from bisect import bisect_right
from functools import lru_cache
from pathlib import Path

from lsprotocol import types as lsp
from pygls import uris

from vicode.xabsl.lexer import Tokens

_LINE_BREAK = re.compile(r"\r\n|\n|\r")


@lru_cache(maxsize=512)
def line_starts(text: str) -> tuple[int, ...]:
    """The offsets of the first characters of all lines, as the protocol counts lines."""
    return (0, *(match.end() for match in _LINE_BREAK.finditer(text)))


def offset_at(text: str, position: lsp.Position) -> int:
    """The offset of a position, whose column counts UTF-16 code units."""
    starts = line_starts(text)
    if position.line >= len(starts):
        return len(text)
    units, offset = 0, starts[position.line]
    while units < position.character and offset < len(text) and text[offset] not in "\r\n":
        units += 1 + (ord(text[offset]) > 0xFFFF)
        offset += 1
    return offset


def position_at(text: str, offset: int) -> lsp.Position:
    line = bisect_right(line_starts(text), offset) - 1
    return lsp.Position(line, utf16_length(text[line_starts(text)[line] : offset]))


def range_at(text: str, start: int, end: int) -> lsp.Range:
    return lsp.Range(position_at(text, start), position_at(text, end))


def token_range(tokens: Tokens, first: int, last: int = -1) -> lsp.Range:
    """The range of a token, or of the tokens from `first` to `last`."""
    last = min(max(first, last), len(tokens.starts) - 1)
    return range_at(tokens.text, tokens.starts[first], tokens.starts[last] + len(tokens.texts[last]))


def utf16_length(text: str) -> int:
    return len(text) if text.isascii() else len(text.encode("utf-16-le")) // 2


def path_of(uri: str) -> Path:
    return Path(uris.to_fs_path(uri) or uri).resolve()


def uri_of(path: Path) -> str:
    return uris.from_fs_path(str(path)) or ""
