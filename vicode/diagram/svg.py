"""Writes a vector image as SVG: one file without scripts or external resources, with selectable text."""

import re
from xml.sax.saxutils import escape, quoteattr

from vicode.diagram.primitives import PathShape, ShapeGroup, TextShape, VectorImage
from vicode.diagram.text_metrics import FONT_FAMILIES, has_exact_width, text_width

# Characters that XML 1.0 cannot represent.
_INVALID_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
# From the middle of small letters to their baseline, as a fraction of the font size.
_BASELINE_SHIFT = 0.36


def write_svg(image: VectorImage, *, is_embedded: bool = False) -> str:
    """Format an image as SVG. An embedded image also contains the keys of its groups."""
    left, top, width, height = map(_number, (image.left, image.top, image.width, image.height))
    families = ", ".join(f"'{name}'" if " " in name else name for name in FONT_FAMILIES)
    position = f'width="{width}" height="{height}" viewBox="{left} {top} {width} {height}"'
    # `role=img` would hide the links inside from screen readers.
    role = "group" if any(group.href for group in image.groups) else "img"
    # A `<title>` of the whole image would be a tooltip everywhere in it.
    name = f" aria-label={quoteattr(_INVALID_XML.sub('', image.title))}" if is_embedded else ""
    # What all shapes of an embedded image inherit; elsewhere each shape stands for itself.
    style = ' stroke-linejoin="round" xml:space="preserve"' if is_embedded else ""
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {position} font-family="{families}"{style} role="{role}"{name}>',
        *([] if is_embedded else [f"<title>{_text(image.title)}</title>"]),
        *([f"<desc>{_text(image.doc)}</desc>"] if image.doc else ()),
        f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="{image.background}"/>',
        *(line for group in image.groups for line in _group_element(group, is_part=is_embedded)),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def _group_element(group: ShapeGroup, *, is_part: bool) -> list[str]:
    shapes = [
        _path_element(shape, is_part=is_part) if isinstance(shape, PathShape) else _text_element(shape, is_part=is_part)
        for shape in group.shapes
    ]
    inner = [*([f"<title>{_text(group.title)}</title>"] if group.title else ()), *shapes]
    about = f'class="{group.css_class}"' + (_data_attributes(group) if is_part else "")
    if group.href:
        return [f"<a {about} href={quoteattr(_INVALID_XML.sub('', group.href))}>", *inner, "</a>"]
    return [f"<g {about}>", *inner, "</g>"]


def _data_attributes(group: ShapeGroup) -> str:
    names = {"data-key": group.key} if group.key else {}
    names |= dict(zip(("data-from", "data-to"), group.end_keys, strict=False))
    words = "".join(f" {name}={quoteattr(_INVALID_XML.sub('', value))}" for name, value in names.items())
    return words + (' tabindex="-1" aria-hidden="true"' if group.is_decorative else "")


def _path_element(path: PathShape, *, is_part: bool) -> str:
    data = "".join(letter + " ".join(map(_number, numbers)) for letter, numbers in path.commands)
    paint = f' fill="{path.fill or "none"}"'
    if path.stroke:
        paint += f' stroke="{path.stroke}" stroke-width="{_number(path.width)}"'
        paint += "" if is_part else ' stroke-linejoin="round"'
        paint += ' stroke-linecap="round"' if not path.dash or path.dash[0] < path.width else ""
    if path.dash:
        paint += f' stroke-dasharray="{" ".join(map(_number, path.dash))}"'
    return f'<path d="{data}"{paint}/>'


def _text_element(text: TextShape, *, is_part: bool) -> str:
    letters = text.font
    # `dominant-baseline` is not supported everywhere; shifting the text is.
    foot = text.y + letters.size * _BASELINE_SHIFT
    weight = ' font-weight="600"' if letters.bold else ""
    anchor = ' text-anchor="middle"' if text.is_centered else ""
    strike = ' text-decoration="line-through"' if text.is_struck_through else ""
    look = f'font-size="{_number(letters.size)}"{weight}{anchor}{strike} fill={quoteattr(text.fill)}'
    position = f'x="{_number(text.x)}" y="{_number(foot)}"{_fixed_width(text)}'
    space = "" if is_part else ' xml:space="preserve"'
    return f"<text {position} {look}{space}>{_text(text.text)}</text>"


def _fixed_width(text: TextShape) -> str:
    """Scale the text to the width that its shape was sized for: not every font is as wide as Helvetica.

    An estimated width would stretch or squeeze the text even in Helvetica, so such a text keeps its natural width.
    """
    if not text.text or not has_exact_width(text.text):
        return ""
    return f' textLength="{_number(text_width(text.text, text.font))}" lengthAdjust="spacingAndGlyphs"'


def _text(text: str) -> str:
    return escape(_INVALID_XML.sub("\ufffd", text))


def _number(value: float) -> str:
    return f"{value:.1f}".removesuffix(".0")
