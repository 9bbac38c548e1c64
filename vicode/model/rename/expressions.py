"""Renaming in expressions, based on tokens, which also works for invalid expressions."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from vicode.model.rename.references import ReferenceKind, ReferenceRename

_TOKEN = re.compile(r"(?P<word>[^\W\d]\w*)|\d[\w.]*|[=!<>]=|\S")


@dataclass(frozen=True, slots=True)
class _Identifier:
    """An identifier: `before` is the name before its dot, `after` the next token, `inside` the enclosing call."""

    start: int
    text: str
    before: str
    after: str
    inside: str
    is_behind_dot: bool


def rename_in_expression(text: str, rename: ReferenceRename) -> str:
    if rename.old not in text:
        return text
    pieces, end = [], 0
    for word in _iter_identifiers(text):
        if word.text == rename.old and _is_reference(word, rename):
            pieces += [text[end : word.start], rename.new]
            end = word.start + len(word.text)
    return "".join([*pieces, text[end:]])


def _is_reference(word: _Identifier, rename: ReferenceRename) -> bool:
    match rename.kind:
        case ReferenceKind.OWN | ReferenceKind.CONSTANT:
            return not word.is_behind_dot and word.after not in (".", "(", "=")
        case ReferenceKind.ALIAS:
            return not word.is_behind_dot and (word.after == "." or word.inside in ("done", "failed"))
        case ReferenceKind.ENUMERATION:
            # An enumeration alone is the type of a declaration in its short form.
            return not word.is_behind_dot and word.after in ("", ".")
        case ReferenceKind.MEMBER | ReferenceKind.ELEMENT:
            return word.is_behind_dot and word.before == rename.owner
        case ReferenceKind.ARGUMENT:
            return word.after == "=" and word.inside == rename.owner
        case ReferenceKind.PARAMETER:
            return False


def _iter_identifiers(text: str) -> Iterator[_Identifier]:
    tokens = list(_TOKEN.finditer(text))
    calls: list[str] = []
    for index, token in enumerate(tokens):
        sign = token.group()
        if sign == "(":
            calls.append(_callee(tokens, index))
        elif sign == ")" and calls:
            calls.pop()
        if token["word"]:
            is_behind_dot = _text_at(tokens, index - 1) == "."
            before = _text_at(tokens, index - 2) if is_behind_dot and _text_at(tokens, index - 3) != "." else ""
            inside = calls[-1] if calls else ""
            yield _Identifier(token.start(), sign, before, _text_at(tokens, index + 1), inside, is_behind_dot)


def _callee(tokens: list[re.Match[str]], index: int) -> str:
    """Return the function called at an opening parenthesis, such as `alias.function`; empty if there is none."""
    if index == 0 or not tokens[index - 1]["word"]:
        return ""
    name = _text_at(tokens, index - 1)
    return f"{_text_at(tokens, index - 3)}.{name}" if _text_at(tokens, index - 2) == "." else name


def _text_at(tokens: list[re.Match[str]], index: int) -> str:
    return tokens[index].group() if 0 <= index < len(tokens) else ""
