"""Renames in expressions, by their words; what cannot be read as an expression is renamed as far as it goes."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from vicode.model.renaming.names import Said, Way

_TOKEN = re.compile(r"(?P<word>[^\W\d]\w*)|\d[\w.]*|[=!<>]=|\S")


@dataclass(frozen=True, slots=True)
class _Word:
    """A name: `before` is the one before its dot, `after` the sign that follows, `inside` the call it stands in."""

    start: int
    text: str
    before: str
    after: str
    inside: str
    is_behind_dot: bool


def rename_in_expression(text: str, said: Said) -> str:
    """The expression with the new name."""
    if said.old not in text:
        return text
    pieces, end = [], 0
    for word in _words(text):
        if word.text == said.old and _is_said(word, said):
            pieces += [text[end : word.start], said.new]
            end = word.start + len(word.text)
    return "".join([*pieces, text[end:]])


def _is_said(word: _Word, said: Said) -> bool:
    match said.way:
        case Way.OWN | Way.CONSTANT:
            return not word.is_behind_dot and word.after not in (".", "(", "=")
        case Way.ALIAS:
            return not word.is_behind_dot and (word.after == "." or word.inside == "done")
        case Way.ENUMERATION:
            return not word.is_behind_dot and word.after == "."
        case Way.MEMBER | Way.ELEMENT:
            return word.is_behind_dot and word.before == said.owner
        case Way.ARGUMENT:
            return word.after == "=" and word.inside == said.owner
        case Way.PARAMETER:
            return False


def _words(text: str) -> Iterator[_Word]:
    tokens = list(_TOKEN.finditer(text))
    calls: list[str] = []
    for at, token in enumerate(tokens):
        sign = token.group()
        if sign == "(":
            calls.append(_callee(tokens, at))
        elif sign == ")" and calls:
            calls.pop()
        if token["word"]:
            is_behind_dot = _sign(tokens, at - 1) == "."
            before = _sign(tokens, at - 2) if is_behind_dot and _sign(tokens, at - 3) != "." else ""
            inside = calls[-1] if calls else ""
            yield _Word(token.start(), sign, before, _sign(tokens, at + 1), inside, is_behind_dot)


def _callee(tokens: list[re.Match[str]], at: int) -> str:
    """What is called by a bracket: `function` or `alias.function`, nothing for a bracket alone."""
    if at == 0 or not tokens[at - 1]["word"]:
        return ""
    name = _sign(tokens, at - 1)
    return f"{_sign(tokens, at - 3)}.{name}" if _sign(tokens, at - 2) == "." else name


def _sign(tokens: list[re.Match[str]], at: int) -> str:
    return tokens[at].group() if 0 <= at < len(tokens) else ""
