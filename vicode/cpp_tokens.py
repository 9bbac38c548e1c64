"""Splits C++ into tokens; XABSL, which is written alike, too."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

COMMENT, DIRECTIVE, STRING, NUMBER, WORD, SIGN = "comment", "directive", "string", "number", "word", "sign"

# A backslash at the end of a line continues a directive and a comment; numbers contain single quotes and signs.
_TOKEN = re.compile(
    r"""
    (?P<comment>/\*.*?\*/|//(?:\\\r?\n|[^\n])*)
    |(?P<directive>^[ \t]*\#(?:\\\r?\n|/\*.*?\*/|(?!//)[^\n])*)
    |(?P<string>(?:u8|[uUL])?R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)"
        |(?:u8|[uUL])?"(?:[^"\\\n]|\\.)*"|(?:u8|[uUL])?'(?:[^'\\\n]|\\.)*')
    |(?P<number>(?:(?<![.\w])\.)?\d(?:[eEpP][+-]|'?\w|\.(?!\.))*)
    |(?P<word>\w+)
    |(?P<sign>::|->|\+\+|--|&&|\|\||[-+*/%=!<>&|^]=|[^\w\s])
    """,
    re.DOTALL | re.MULTILINE | re.VERBOSE,
)
_WHOLE = re.compile(r"0|[1-9][0-9]*")
_DECIMAL = re.compile(r"(?:[0-9]+\.[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|[0-9]+[eE][+-]?[0-9]+")


@dataclass(frozen=True, slots=True)
class CppToken:
    """A token, with spaces in comments and directives collapsed, and its place in the text."""

    kind: str
    text: str
    start: int
    end: int


def iter_tokens(text: str) -> Iterator[CppToken]:
    """Yield the tokens of a text."""
    for found in _TOKEN.finditer(text):
        kind = found.lastgroup or SIGN
        kind = STRING if kind == "mark" else kind
        word = " ".join(found[0].split()) if kind in (COMMENT, DIRECTIVE) else found[0]
        yield CppToken(kind, word, found.start(), found.end())


def iter_words(text: str) -> Iterator[tuple[bool, str]]:
    """Yield the texts of the tokens, and whether they are numbers; faster than `iter_tokens`."""
    for found in _TOKEN.finditer(text):
        kind = found.lastgroup
        yield kind == NUMBER, " ".join(found[0].split()) if kind in (COMMENT, DIRECTIVE) else found[0]


def number_value(text: str) -> int | float | None:
    """Return the value of a number in decimal notation without a suffix; None for any other token."""
    plain = text.replace("'", "")
    if _WHOLE.fullmatch(plain):
        return int(plain)
    return float(plain) if _DECIMAL.fullmatch(plain) else None
