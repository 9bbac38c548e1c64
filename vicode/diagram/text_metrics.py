"""Approximate text widths without a font.

The widths are those of Helvetica, which Arial, Liberation Sans and, nearly, Roboto share.
"""

from dataclasses import dataclass
from functools import lru_cache

# In thousandths of the font size, from space (32) to tilde (126): Adobe's metrics of Helvetica.
_WIDTHS = (
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556, 556, 556, 556, 556,
    556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833,
    722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556,
    556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334,
    260, 334, 584,
)  # fmt: skip
_SIGNS = {"…": 1000, "·": 278, "›": 333, "→": 1000, "≤": 549, "≥": 549, "°": 400}
_GLYPH_WIDTHS = {**{chr(32 + index): width for index, width in enumerate(_WIDTHS)}, **_SIGNS}
_DEFAULT_WIDTH, _WIDE_GLYPH_WIDTH = 600, 1000
_FIRST_WIDE_CODE_POINT = 0x2E80
_BOLD_FACTOR = 1.07
# Longer texts never fit.
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
    """The width in pixels."""
    return _to_pixels(_thousandths_of(text), font)


def shorten(text: str, font: Font, max_width: float) -> str:
    """The text on one line if it fits, else its start and an ellipsis."""
    line = " ".join(text.split())
    start = line[:_MAX_LENGTH]
    if start == line and text_width(line, font) <= max_width:
        return line
    end, thousandths = 0, _SIGNS["…"]
    for letter in start:
        thousandths += _width_of(letter)
        if _to_pixels(thousandths, font) > max_width:
            break
        end += 1
    return f"{start[:end].rstrip()}…"


def _to_pixels(thousandths: int, letters: Font) -> float:
    return thousandths / 1000 * letters.size * (_BOLD_FACTOR if letters.bold else 1)


@lru_cache(maxsize=1 << 14)
def _thousandths_of(text: str) -> int:
    return sum(map(_width_of, text))


def _width_of(letter: str) -> int:
    return _GLYPH_WIDTHS.get(letter) or (_WIDE_GLYPH_WIDTH if ord(letter) >= _FIRST_WIDE_CODE_POINT else _DEFAULT_WIDTH)
