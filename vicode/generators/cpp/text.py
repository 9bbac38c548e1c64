"""Escapes text from designs for C++ comments and string literals."""

import textwrap

from vicode.generators.plan import ValuePlan
from vicode.regions import escape_marks

LINE_WIDTH = 110


def comment(text: str, indent: int = 0, *, mark: str = "//") -> list[str]:
    """The lines of a comment; empty for an empty text."""
    prefix = f"{' ' * indent}{mark} "
    paragraphs = [" ".join(paragraph.split()) for paragraph in text.split("\n\n")]
    lines: list[str] = []
    for paragraph in filter(None, paragraphs):
        lines += [prefix.rstrip()] if lines else []
        lines += textwrap.wrap(
            _printable(paragraph),
            LINE_WIDTH,
            initial_indent=prefix,
            subsequent_indent=prefix,
            break_long_words=False,
            break_on_hyphens=False,
        )
    # A backslash at the end would continue the comment on the next line.
    return [f"{line} (backslash)" if line.endswith("\\") else line for line in lines]


def doc_comment(text: str, indent: int = 0) -> list[str]:
    return comment(text, indent, mark="///")


def describe(value: ValuePlan) -> str:
    """The description of a value with its unit and range."""
    facts = [f"in {value.unit}"] if value.unit else []
    facts += [f"{value.range[0]:g} to {value.range[1]:g}"] if value.range else []
    text, fact = " ".join(value.doc.split()), ", ".join(facts)
    if not fact:
        return text
    return f"{text.removesuffix('.')} ({fact})" if text else fact[:1].upper() + fact[1:]


def quoted(text: str) -> str:
    """A string literal in UTF-8."""
    escaped = "".join(_ESCAPES.get(char) or _escaped(char) for char in text)
    return '"' + escaped.replace("??", "?\\?") + '"'


_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t"}


def _escaped(char: str) -> str:
    # Octal escapes end after three digits; hexadecimal ones would take digits that follow.
    return char if char.isprintable() else "".join(f"\\{byte:03o}" for byte in char.encode("utf-8", "replace"))


def _printable(text: str) -> str:
    printable = "".join(char if char.isprintable() else "?" for char in escape_marks(text))
    # Compilers warn about trigraphs in comments.
    return printable.replace("??", "? ?")
