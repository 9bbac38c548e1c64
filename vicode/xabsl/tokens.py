"""Keywords, operators and token kinds of XABSL, used by the lexer, completion and the TextMate grammar."""

import re

from vicode.languages import LANGUAGES

KEYWORDS = LANGUAGES["xabsl"].keywords

OPERATORS = ("<=", ">=", "==", "!=", "&&", "||")

NAME, NUMBER, STRING, RANGE = "name", "number", "string", "range"
DOC, HEADER, END = "description", "first comment", "end of file"
"""Kinds of tokens. The kind of a keyword, operator or punctuation mark is its text."""

TOKEN_PATTERN = re.compile(
    r"""
    [\s\ufeff]*(?:
      (?P<name>@?[A-Za-z_][A-Za-z0-9_.]*)
    | (?P<close>\*/)
    | (?P<own>[{}();,:?+*%]|<=|>=|==|!=|&&|\|\||[<>=!|-]|/(?![/*]))
    | (?P<number>[0-9]+(?:\.[0-9]*)?)
    | (?P<line>//[^\n]*)
    | (?P<initial>/\*\*\*(?!/)(?s:.*?)\*/)
    | (?P<doc>/\*\*(?![*/])(?s:.*?)\*/)
    | (?P<block>/\*(?s:.*?)\*/)
    | (?P<string>"[^"]*")
    | (?P<open>"[^"\n]*)
    | (?P<range>\[[^\]\n]{0,300}\])
    | (?P<end>\Z)
    | (?P<bad>(?s:.))
    )""",
    re.VERBOSE,
)
