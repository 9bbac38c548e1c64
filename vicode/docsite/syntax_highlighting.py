"""Syntax highlighting as HTML, line by line."""

import re
from collections.abc import Iterator
from html import escape

from pygments.lexers import CppLexer, JavascriptLexer, YamlLexer
from pygments.token import Comment, Keyword, Name, Number, Operator, String

from vicode.languages import LANGUAGES

# Longer texts are not highlighted: it would take minutes.
_MAX_HIGHLIGHTED_CHARS = 400_000

# Classes of the style sheet: keywords, strings, numbers (m), comments, definitions (f).
_CLASSES = (
    *((kind, "k") for kind in (Keyword, Operator.Word, Name.Tag)),
    *((String, "s"), (Number, "m"), (Comment, "c")),
    *((kind, "f") for kind in (Name.Function, Name.Class)),
)


def _keywords(language: str) -> str:
    return "|".join(sorted(LANGUAGES[language].keywords))


# One regular expression per language is many times faster than the lexers of Pygments. Text
# outside the named groups is not highlighted; matching whole names avoids matches inside them.
_PYTHON = re.compile(
    r"(?P<c>#[^\n]*)"
    r"|(?P<s>\b(?i:[rbfu]|[rbf]{2})?(?:\"\"\"(?s:\\.|.)*?\"\"\"|'''(?s:\\.|.)*?'''|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'))"
    rf"|(?P<k>\b(?:{_keywords('python')})\b)"
    r"|(?P<f>(?<=\bdef )[^\W\d]\w*|(?<=\bclass )[^\W\d]\w*)"
    r"|[^\W\d]\w*"
    r"|(?P<m>\d(?:[\w.]|(?<=[eE])[-+])*)"
)
_XABSL = re.compile(
    r"(?P<c>//[^\n]*|/\*(?s:.*?)(?:\*/|\Z))"
    r'|(?P<s>"[^"]*")'
    rf"|(?P<k>\b(?:{_keywords('xabsl')})(?![\w.]))"
    r"|@?[A-Za-z_][\w.]*"
    r"|(?P<m>\d+(?:\.\d+)?)"
)
_EXPRESSIONS = {"python": _PYTHON, "xabsl": _XABSL}
_LEXERS = {"cpp": CppLexer, "javascript": JavascriptLexer, "yaml": YamlLexer}


def highlight_lines(text: str, language: str) -> tuple[str, ...]:
    """Highlight a text; each line is separate HTML."""
    plain = text.replace("\r\n", "\n").replace("\r", "\n").removesuffix("\n")
    pieces = _tokens(plain, language) if len(plain) <= _MAX_HIGHLIGHTED_CHARS else [("", plain)]
    return tuple("".join(map(_token_html, pieces)).split("\n"))


def code_row(number: int, html: str, href: str, title: str) -> str:
    """A table row for a line of code; `href` links to the node with the name `title`."""
    # Not a template: most of the content of a site is in these rows.
    about = escape(title)
    link = f'<a href="{escape(href)}" title="{about}" aria-label="{about}">↗</a>' if href else ""
    # HTML allows to omit the ends of rows and cells.
    return f'<tr id="L{number}"><td><a href="#L{number}">{number}</a><td>{link}<td><code>{html}</code>'


def highlight_block(text: str, language: str) -> str:
    return "\n".join(highlight_lines(text.strip("\n"), language))


def _token_html(piece: tuple[str, str]) -> str:
    """Split spans at line ends."""
    name, text = piece
    html = escape(text, quote=False)
    if not name:
        return html
    return "\n".join(f'<span class="{name}">{line}</span>' if line else "" for line in html.split("\n"))


def _tokens(text: str, language: str) -> Iterator[tuple[str, str]]:
    """The tokens of a text with their classes, "" for none."""
    expression = _EXPRESSIONS.get(language)
    if expression is None:
        yield from _pygments_tokens(text, language)
        return
    done = 0
    for match in expression.finditer(text):
        if match.lastgroup:
            yield "", text[done : match.start()]
            yield match.lastgroup, match.group()
            done = match.end()
    yield "", text[done:]


def _pygments_tokens(text: str, language: str) -> Iterator[tuple[str, str]]:
    lexer = _LEXERS.get(language)
    if lexer is None:
        yield "", text
        return
    for kind, piece in lexer(stripnl=False, ensurenl=False).get_tokens(text):
        yield next((name for parent, name in _CLASSES if kind in parent), ""), piece
