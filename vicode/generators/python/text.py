"""Users' words as docstrings, comments and strings of Python, which nothing in them can end."""

import textwrap
import unicodedata

from vicode.generators.python.pretty_printer import LINE_WIDTH
from vicode.regions import escape_marks


def docstring(text: str, indent: int, sections: tuple[str, ...] = ()) -> str:
    """A docstring, indented: the text, then finished sections of lines."""
    margin = " " * indent
    lines = [
        *_wrapped(text, LINE_WIDTH - indent - 3),
        *(line for section in sections for line in ("", *section.split("\n"))),
    ]
    escaped = [_escaped(line) for line in lines]
    if escaped[0].startswith('"'):
        escaped[0] = f"\\{escaped[0]}"
    # The closing quotes stand alone only where they, and they alone, are too much for the line.
    if len(escaped) == 1 and not LINE_WIDTH - 3 < indent + 3 + _columns(escaped[0]) <= LINE_WIDTH:
        return f'{margin}"""{_escape_last_quote(escaped[0])}"""'
    rest = [margin + line if line else "" for line in escaped[1:]]
    return "\n".join([f'{margin}"""{escaped[0]}', *rest, f'{margin}"""'])


def section(title: str, entries: list[tuple[str, str]], indent: int) -> str:
    """A section of a docstring, such as Args, whose entries are pairs of name and text."""
    lines = [f"{title}:"]
    for name, text in entries:
        width = LINE_WIDTH - indent
        lines += textwrap.wrap(
            f"{name}: {_clean(text)}", width, initial_indent="    ", subsequent_indent=" " * 8, break_long_words=False
        )
    return "\n".join(lines)


def comment(text: str, indent: int) -> list[str]:
    """A text as lines of comment."""
    prefix = " " * indent + "# "
    clean = _clean(text)
    # A remark to a tool would mean something else than the person who wrote it did.
    if clean.lower().startswith(("fmt:", "isort:", "mypy:", "noqa", "pragma:", "pyright:", "ruff:", "type:", "yapf:")):
        clean = f"({clean})"
    return textwrap.wrap(clean, LINE_WIDTH, initial_indent=prefix, subsequent_indent=prefix, break_long_words=False)


def quoted(text: str) -> str:
    """A string literal as a formatter leaves it."""
    escaped = "".join(_escaped_character(char) for char in text.replace("\\", "\\\\"))
    if '"' in escaped and "'" not in escaped:
        return f"'{escaped}'"
    return '"' + escaped.replace('"', '\\"') + '"'


def declaration_description(doc: str, unit: str, range_: tuple[float, float] | None) -> str:
    """A declaration in words: its doc, unit and range."""
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
    # Wrapping would make blanks of vertical tabs and form feeds, after the margin has been measured.
    blank = escape_marks(text).replace("\v", " ").replace("\f", " ")
    lines = blank.replace("\r\n", "\n").replace("\r", "\n").expandtabs(4).split("\n")
    lines = "\n".join(line.rstrip() for line in lines).strip("\n ").lstrip().split("\n")
    # As Python reads docstrings: the first line may begin anywhere, the others have a margin in common.
    lines = [lines[0], *textwrap.dedent("\n".join(lines[1:])).split("\n")] if lines[1:] else lines
    return [line for index, line in enumerate(lines) if line or lines[index - 1]]


def _columns(text: str) -> int:
    """How many columns a formatter counts: letters of East Asia are wide, marks on letters take no room."""
    wide = sum(unicodedata.east_asian_width(char) in "WF" for char in text)
    return len(text) + wide - sum(unicodedata.combining(char) > 0 for char in text)


def _clean(text: str) -> str:
    """One line of printable characters."""
    words = escape_marks(" ".join(text.split())).split()
    return " ".join("".join(char if char.isprintable() else "?" for char in word) for word in words)


def _escaped(line: str) -> str:
    text = line.replace("\\", "\\\\").replace('"""', '\\"\\"\\"')
    return "".join(_escaped_character(char) for char in text)


def _escaped_character(char: str) -> str:
    # Letters that turn the direction of reading can show code as something else than it is.
    is_turning = unicodedata.bidirectional(char) in {"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"}
    if char.isprintable() and not is_turning:
        return char
    code = ord(char)
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def _escape_last_quote(line: str) -> str:
    """A last quote would belong to the three that end the docstring."""
    return line[:-1] + '\\"' if line.endswith('"') and not line.endswith('\\"') else line
