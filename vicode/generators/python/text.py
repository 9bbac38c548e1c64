"""Escapes text from designs for Python docstrings, comments and string literals."""

import textwrap
import unicodedata

from vicode.generators.python.pretty_printer import LINE_WIDTH
from vicode.regions import escape_marks


def docstring(text: str, indent: int, sections: tuple[str, ...] = ()) -> str:
    """Format an indented docstring from a text and formatted sections."""
    margin = " " * indent
    lines = [
        *_wrapped(text, LINE_WIDTH - indent - 3),
        *(line for section in sections for line in ("", *section.split("\n"))),
    ]
    escaped = [_escaped(line) for line in lines]
    if escaped[0].startswith('"'):
        escaped[0] = f"\\{escaped[0]}"
    # As ruff does, move the closing quotes to a separate line only if they alone exceed the line width.
    if len(escaped) == 1 and not LINE_WIDTH - 3 < indent + 3 + _columns(escaped[0]) <= LINE_WIDTH:
        return f'{margin}"""{_escape_last_quote(escaped[0])}"""'
    rest = [margin + line if line else "" for line in escaped[1:]]
    return "\n".join([f'{margin}"""{escaped[0]}', *rest, f'{margin}"""'])


def section(title: str, entries: list[tuple[str, str]], indent: int) -> str:
    """Format a docstring section such as Args; entries are pairs of name and text."""
    lines = [f"{title}:"]
    for name, text in entries:
        width = LINE_WIDTH - indent
        lines += textwrap.wrap(
            f"{name}: {_clean(text)}", width, initial_indent="    ", subsequent_indent=" " * 8, break_long_words=False
        )
    return "\n".join(lines)


def comment(text: str, indent: int) -> list[str]:
    prefix = " " * indent + "# "
    clean = _clean(text)
    # Prevent a text from acting as a tool directive.
    if clean.lower().startswith(("fmt:", "isort:", "mypy:", "noqa", "pragma:", "pyright:", "ruff:", "type:", "yapf:")):
        clean = f"({clean})"
    return textwrap.wrap(clean, LINE_WIDTH, initial_indent=prefix, subsequent_indent=prefix, break_long_words=False)


def quoted(text: str) -> str:
    """Format a string literal as ruff does."""
    escaped = "".join(_escaped_character(char) for char in text.replace("\\", "\\\\"))
    if '"' in escaped and "'" not in escaped:
        return f"'{escaped}'"
    return '"' + escaped.replace('"', '\\"') + '"'


def declaration_description(doc: str, unit: str, range_: tuple[float, float] | None) -> str:
    """Describe a declaration by its doc, unit and range."""
    facts = [f"in {unit}"] if unit else []
    facts += [f"{range_[0]:g} to {range_[1]:g}"] if range_ else []
    text = " ".join(doc.split())
    if not facts:
        return text
    fact = ", ".join(facts)
    if not text:
        return fact[:1].upper() + fact[1:]
    return f"{text.removesuffix('.')} ({fact})"


def _wrapped(text: str, width: int) -> list[str]:
    lines: list[str] = []
    for line in _plain_lines(text):
        lead = line[: len(line) - len(line.lstrip())]
        lines += textwrap.wrap(line, width, subsequent_indent=lead, break_long_words=False) or [""]
    return lines or [""]


def _plain_lines(text: str) -> list[str]:
    # textwrap converts vertical tabs and form feeds to spaces, but after the margin is measured.
    cleaned = escape_marks(text).replace("\v", " ").replace("\f", " ")
    lines = cleaned.replace("\r\n", "\n").replace("\r", "\n").expandtabs(4).split("\n")
    lines = "\n".join(line.rstrip() for line in lines).strip("\n ").lstrip().split("\n")
    # As in PEP 257, the indentation of the first line does not count for the common margin.
    lines = [lines[0], *textwrap.dedent("\n".join(lines[1:])).split("\n")] if lines[1:] else lines
    return [line for index, line in enumerate(lines) if line or lines[index - 1]]


def _columns(text: str) -> int:
    """Count columns as ruff does: East Asian wide characters take two, combining characters none."""
    wide = sum(unicodedata.east_asian_width(char) in "WF" for char in text)
    return len(text) + wide - sum(unicodedata.combining(char) > 0 for char in text)


def _clean(text: str) -> str:
    """Convert a text to one line of printable characters."""
    words = escape_marks(" ".join(text.split())).split()
    return " ".join("".join(char if char.isprintable() else "?" for char in word) for word in words)


def _escaped(line: str) -> str:
    text = line.replace("\\", "\\\\").replace('"""', '\\"\\"\\"')
    return "".join(_escaped_character(char) for char in text)


def _escaped_character(char: str) -> str:
    # Bidirectional control characters can make code look different from what it is.
    is_bidi_control = unicodedata.bidirectional(char) in {"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"}
    if char.isprintable() and not is_bidi_control:
        return char
    code = ord(char)
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def _escape_last_quote(line: str) -> str:
    """Escape a final quote, which would join the closing quotes."""
    return line[:-1] + '\\"' if line.endswith('"') and not line.endswith('\\"') else line
