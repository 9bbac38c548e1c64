"""Code as HTML: coloured by classes, line by line."""

from functools import lru_cache

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexer import RegexLexer, words
from pygments.lexers import CppLexer, PythonLexer, YamlLexer
from pygments.lexers.special import TextLexer
from pygments.token import Comment, Keyword, Name, Number, Operator, Punctuation, String, Whitespace

from vicode.xabsl.tokens import KEYWORDS

# A longer text is not coloured: it would be read by nobody, and cost minutes.
_MOST_LETTERS = 400_000
TITLES = {"python": "Python", "cpp": "C++", "xabsl": "XABSL", "yaml": "YAML"}


class _XabslLexer(RegexLexer):  # type: ignore[misc]  # Pygments has no types
    """The words of XABSL."""

    name = "XABSL"
    tokens = {  # noqa: RUF012  # as Pygments has it
        "root": [
            (r"\s+", Whitespace),
            (r"//[^\n]*", Comment.Single),
            (r"/\*(?s:.*?)(\*/|\Z)", Comment.Multiline),
            (r'"[^"]*"', String),
            (words(sorted(KEYWORDS), prefix=r"\b", suffix=r"(?![\w.])"), Keyword),
            (r"@?[A-Za-z_][\w.]*", Name),
            (r"\d+(\.\d+)?", Number),
            (r"[-+*/%=<>!&|?:]+", Operator),
            (r"[^\w\s]", Punctuation),
        ]
    }


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
