"""Folding ranges: blocks in braces, includes, descriptions and block comments."""

from collections.abc import Iterator

from lsprotocol import types as lsp

from vicode.xabsl.parser import ParsedFile
from vicode.xabsl.server.positions import position_at
from vicode.xabsl.tokens import TOKEN_PATTERN

_COMMENTS = ("initial", "doc", "block")


def folding_ranges(parsed: ParsedFile) -> list[lsp.FoldingRange]:
    return [*_blocks(parsed), *_comments(parsed), *_includes(parsed)]


def _blocks(parsed: ParsedFile) -> Iterator[lsp.FoldingRange]:
    tokens, opened = parsed.tokens, list[int]()
    for kind, start in zip(tokens.kinds, tokens.starts, strict=True):
        if kind == "{":
            opened.append(position_at(tokens.text, start).line)
        elif kind == "}" and opened:
            # The line of the closing brace stays visible.
            first, last = opened.pop(), position_at(tokens.text, start).line - 1
            if last > first:
                yield lsp.FoldingRange(start_line=first, end_line=last)


def _comments(parsed: ParsedFile) -> Iterator[lsp.FoldingRange]:
    text = parsed.tokens.text
    for match in TOKEN_PATTERN.finditer(text):
        if match.lastgroup in _COMMENTS:
            first = position_at(text, match.start(match.lastgroup)).line
            last = position_at(text, match.end()).line
            if last > first:
                yield lsp.FoldingRange(start_line=first, end_line=last, kind=lsp.FoldingRangeKind.Comment)


def _includes(parsed: ParsedFile) -> Iterator[lsp.FoldingRange]:
    includes, tokens = parsed.file.includes, parsed.tokens
    if len(includes) > 1:
        first = position_at(tokens.text, tokens.starts[includes[0].first_token]).line
        last = position_at(tokens.text, tokens.starts[includes[-1].last_token]).line
        if last > first:
            yield lsp.FoldingRange(start_line=first, end_line=last, kind=lsp.FoldingRangeKind.Imports)
