"""The words of XABSL: one table for lexer, completion and the syntax files of text editors."""

import re

KEYWORDS = frozenset(
    (
        *("true", "false", "option", "action", "initial", "target", "state", "common", "decision", "goto", "stay"),
        *("if", "else", "state_time", "option_time", "action_done", "agent", "function", "enum", "input", "output"),
        *("internal", "bool", "float", "const", "namespace", "behavior", "include", "capacity", "synchronized"),
        "conflict",
    )
)
"""`function` is reserved and means nothing."""

OPERATORS = ("<=", ">=", "==", "!=", "&&", "||")
PUNCTUATION = "%!<>{}();|+-*/=,?:"

NAME, NUMBER, STRING, RANGE = "name", "number", "string", "range"
DOC, HEADER, END = "description", "first comment", "end of file"
"""Kinds of tokens that are not their own text; keywords, operators and punctuation are."""

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
