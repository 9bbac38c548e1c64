"""Code as HTML: coloured by classes, line by line."""

import re
from collections.abc import Iterator
from functools import lru_cache
from typing import Any

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexer import Lexer
from pygments.lexers import CppLexer, PythonLexer, YamlLexer
from pygments.lexers.special import TextLexer
from pygments.token import Comment, Error, Keyword, Name, Number, Operator, Punctuation, String, Whitespace

from vicode.xabsl.tokens import KEYWORDS

# A longer text is not coloured: it would be read by nobody, and cost minutes.
_MOST_LETTERS = 400_000
TITLES = {"python": "Python", "cpp": "C++", "xabsl": "XABSL", "yaml": "YAML"}


# In this order: one expression for all finds a token at once, where Pygments tries rule after rule.
_XABSL_TOKENS = (
    (Whitespace, r"\s+"),
    (Comment.Single, r"//[^\n]*"),
    (Comment.Multiline, r"/\*(?s:.*?)(?:\*/|\Z)"),
    (String, r'"[^"]*"'),
    (Keyword, rf"\b(?:{'|'.join(map(re.escape, sorted(KEYWORDS)))})(?![\w.])"),
    (Name, r"@?[A-Za-z_][\w.]*"),
    (Number, r"\d+(?:\.\d+)?"),
    (Operator, r"[-+*/%=<>!&|?:]+"),
    (Punctuation, r"[^\w\s]"),
    (Error, r"(?s:.)"),
)
_XABSL = re.compile("|".join(f"({pattern})" for _kind, pattern in _XABSL_TOKENS))


class _XabslLexer(Lexer):  # type: ignore[misc]  # Pygments has no types
    """The words of XABSL."""

    name = "XABSL"

    def get_tokens_unprocessed(self, text: str) -> Iterator[tuple[int, Any, str]]:
        for match in _XABSL.finditer(text):
            yield match.start(), _XABSL_TOKENS[(match.lastindex or 1) - 1][0], match.group()


_LEXERS = {"python": PythonLexer, "cpp": CppLexer, "xabsl": _XabslLexer, "yaml": YamlLexer}


def lines_of(text: str, language: str) -> tuple[str, ...]:
    """The lines of a text, each as HTML of its own."""
    plain = text.replace("\r\n", "\n").replace("\r", "\n")
    lexer = _LEXERS.get(language, TextLexer) if len(plain) <= _MOST_LETTERS else TextLexer
    made = highlight(plain, lexer(stripnl=False, ensurenl=False), _formatter())
    return tuple(str(made).removesuffix("\n").split("\n"))


def block_of(text: str, language: str) -> str:
    """A piece of code as HTML."""
    return "\n".join(lines_of(text.strip("\n"), language))


@lru_cache(maxsize=1)
def _formatter() -> "HtmlFormatter[str]":
    return HtmlFormatter(nowrap=True)
