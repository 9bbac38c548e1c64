"""A drawing as SVG: one file, no scripts, nothing from outside, texts that can be selected."""

import re
from xml.sax.saxutils import escape, quoteattr

from vicode.diagram.lettering import FAMILIES
from vicode.diagram.shapes import Drawing, Group, Path, Text

# What XML 1.0 has no way to say.
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
# From the middle of small letters to their foot, as a share of their size.
_MIDDLE = 0.36


def write_svg(drawing: Drawing, *, is_part: bool = False) -> str:
    """The text of the file; as a part of a page it also says which groups belong together."""
    left, top, width, height = map(_number, (drawing.left, drawing.top, drawing.width, drawing.height))
    families = ", ".join(f"'{name}'" if " " in name else name for name in FAMILIES)
    place = f'width="{width}" height="{height}" viewBox="{left} {top} {width} {height}"'
    # A picture of one piece hides from screen readers the links that are in it.
    role = "group" if any(group.href for group in drawing.groups) else "img"
    # As a title the name of a page's part would stand beside the pointer everywhere in it.
    name = f" aria-label={quoteattr(_NOT_XML.sub('', drawing.title))}" if is_part else ""
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {place} font-family="{families}" role="{role}"{name}>',
        *([] if is_part else [f"<title>{_text(drawing.title)}</title>"]),
        *([f"<desc>{_text(drawing.doc)}</desc>"] if drawing.doc else ()),
        f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="{drawing.paper}"/>',
        *(line for group in drawing.groups for line in _group(group, is_part=is_part)),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def _group(group: Group, *, is_part: bool) -> list[str]:
    shapes = [_path(shape) if isinstance(shape, Path) else _line_of_text(shape) for shape in group.shapes]
    inner = [*([f"<title>{_text(group.title)}</title>"] if group.title else ()), *shapes]
    about = f'class="{group.kind}"' + (_relations(group) if is_part else "")
    if group.href:
        return [f"<a {about} href={quoteattr(_NOT_XML.sub('', group.href))}>", *inner, "</a>"]
    return [f"<g {about}>", *inner, "</g>"]


def _relations(group: Group) -> str:
    names = {"data-key": group.key} if group.key else {}
    names |= dict(zip(("data-from", "data-to"), group.ends, strict=False))
    words = "".join(f" {name}={quoteattr(_NOT_XML.sub('', value))}" for name, value in names.items())
    return words + (' tabindex="-1" aria-hidden="true"' if group.is_echo else "")


def _path(path: Path) -> str:
    way = "".join(letter + " ".join(map(_number, numbers)) for letter, numbers in path.steps)
    paint = f' fill="{path.fill or "none"}"'
    if path.stroke:
        paint += f' stroke="{path.stroke}" stroke-width="{_number(path.width)}" stroke-linejoin="round"'
        paint += ' stroke-linecap="round"' if not path.dash or path.dash[0] < path.width else ""
    if path.dash:
        paint += f' stroke-dasharray="{" ".join(map(_number, path.dash))}"'
    return f'<path d="{way}"{paint}/>'


def _line_of_text(text: Text) -> str:
    letters = text.letters
    # dominant-baseline is not understood everywhere; a shift down is.
    foot = text.y + letters.size * _MIDDLE
    weight = ' font-weight="600"' if letters.bold else ""
    anchor = ' text-anchor="middle"' if text.is_centred else ""
    strike = ' text-decoration="line-through"' if text.is_struck else ""
    look = f'font-size="{_number(letters.size)}"{weight}{anchor}{strike} fill={quoteattr(text.fill)}'
    place = f'x="{_number(text.x)}" y="{_number(foot)}"'
    return f'<text {place} {look} xml:space="preserve">{_text(text.text)}</text>'


def _text(text: str) -> str:
    return escape(_NOT_XML.sub("\ufffd", text))


def _number(value: float) -> str:
    return f"{value:.1f}".removesuffix(".0")
