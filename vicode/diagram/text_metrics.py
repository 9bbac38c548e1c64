"""Widths of texts in diagrams, computed without a font.

The widths are those of Helvetica, which Arial and Liberation Sans share; Roboto is nearly as wide.
"""

import unicodedata
from dataclasses import dataclass
from functools import lru_cache

# In thousandths of the font size, from the space (32) to the tilde (126). Source: Adobe's font metrics of Helvetica.
_WIDTHS = (
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556, 556, 556, 556, 556,
    556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833,
    722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556,
    556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334,
    260, 334, 584,
)  # fmt: skip
# Source: Adobe's font metrics of Helvetica-Bold.
_BOLD_WIDTHS = (
    278, 333, 474, 556, 556, 889, 722, 238, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556, 556, 556, 556, 556,
    556, 556, 556, 333, 333, 584, 584, 584, 611, 975, 722, 722, 722, 722, 667, 611, 778, 722, 278, 556, 722, 611, 833,
    722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 333, 278, 333, 584, 556, 333, 556, 611, 556, 611,
    556, 333, 611, 611, 278, 278, 556, 278, 889, 611, 611, 611, 611, 389, 556, 333, 611, 556, 778, 556, 556, 500, 389,
    280, 389, 584,
)  # fmt: skip
_SYMBOLS = {"…": 1000, "·": 278, "›": 333, "→": 1000, "≤": 549, "≥": 549, "°": 400}
_GLYPH_WIDTHS = {
    is_bold: {**{chr(32 + index): width for index, width in enumerate(widths)}, **_SYMBOLS}
    for is_bold, widths in ((False, _WIDTHS), (True, _BOLD_WIDTHS))
}
_DEFAULT_WIDTH, _WIDE_GLYPH_WIDTH = 600, 1000
_FIRST_WIDE_CODE_POINT = 0x2E80
# From here on mostly emoji: several code points may form one glyph.
_FIRST_EMOJI_CODE_POINT = 0x1F000
# Longer texts fit into no shape.
_MAX_LENGTH = 120

FONT_FAMILIES = ("Roboto", "Segoe UI", "Helvetica Neue", "Arial", "Liberation Sans", "DejaVu Sans", "sans-serif")


@dataclass(frozen=True, slots=True, kw_only=True)
class Font:
    """Size in pixels and weight."""

    size: float
    bold: bool = False


NAME_FONT = Font(size=14, bold=True)
SMALL_FONT = Font(size=11)
LABEL_FONT = Font(size=12)


def text_width(text: str, font: Font) -> float:
    """Return the width in pixels; characters outside the tables get an estimated width."""
    return _thousandths(text, font.bold) / 1000 * font.size


def has_exact_width(text: str) -> bool:
    """Whether `text_width` is the exact width of the text in Helvetica."""
    return all(map(_is_measured, text))


def shorten(text: str, font: Font, max_width: float) -> str:
    """Return the text on one line if it fits, otherwise its beginning and an ellipsis."""
    line = " ".join(text.split())
    start = line[:_MAX_LENGTH]
    if start == line and text_width(line, font) <= max_width:
        return line
    end, thousandths = 0, _SYMBOLS["…"]
    for character in start:
        thousandths += _character_width(character, font.bold)
        if thousandths / 1000 * font.size > max_width:
            break
        end += 1
    return f"{start[:end].rstrip()}…"


@lru_cache(maxsize=1 << 14)
def _thousandths(text: str, is_bold: bool) -> int:
    return sum(_character_width(character, is_bold) for character in text)


@lru_cache(maxsize=1 << 12)
def _character_width(character: str, is_bold: bool) -> int:
    widths = _GLYPH_WIDTHS[is_bold]
    # A letter with an accent is as wide as the letter.
    known = widths.get(character) or widths.get(unicodedata.normalize("NFD", character)[0])
    return known or (_WIDE_GLYPH_WIDTH if ord(character) >= _FIRST_WIDE_CODE_POINT else _DEFAULT_WIDTH)


def _is_measured(character: str) -> bool:
    is_wide = _FIRST_WIDE_CODE_POINT <= ord(character) < _FIRST_EMOJI_CODE_POINT
    return is_wide or unicodedata.normalize("NFD", character)[0] in _GLYPH_WIDTHS[False]
