"""Classes for what the shapes of all drawings have in common: attributes would be a third of a drawing."""

import re
from dataclasses import astuple
from functools import cache, lru_cache

from vicode.diagram.palettes import css_variable_palette

_PATH = re.compile(r'(<path d="[^"]*")([^>]*)(?=/>)')
_TEXT = re.compile(r'(<text x="[^"]*" y="[^"]*"(?: textLength="[^"]*" lengthAdjust="[^"]*")?)([^>]*)(?=>)')
_ATTRIBUTE = re.compile(r' ([a-z-]+)="([^"]*)"')
_FONT_SIZES = (10, 10.5, 11, 11.5, 12, 12.5, 13, 14, 15, 16)
_DASHES = ("1.5 4", "9 4", "4 4", "6 3", "6 4", "3 3", "2 4", "5 4", "7 5", "4 3", "5 5")


def shorten_shapes(html: str) -> str:
    """Replace attributes of the paths and texts of drawings by the classes of `shape_rules`."""
    for shape in (_PATH, _TEXT):
        html = shape.sub(lambda found: found[1] + _with_classes(found[2]), html)
    return html


def shape_rules() -> str:
    """The rules of the style sheet for the classes."""
    rules = (
        f"svg .{css_class} {{ {name}: {value}{'px' if name == 'font-size' else ''}; }}"
        for (name, value), css_class in _classes().items()
    )
    return "\n/* The shapes of diagrams. */\n" + "\n".join(rules) + "\n"


@lru_cache(maxsize=4096)
def _with_classes(attributes: str) -> str:
    classes, rest = [], []
    for match in _ATTRIBUTE.finditer(attributes):
        css_class = _classes().get((match[1], match[2]))
        if css_class:
            classes.append(css_class)
        else:
            rest.append(match[0])
    return (f' class="{" ".join(classes)}"' if classes else "") + "".join(rest)


@cache
def _classes() -> dict[tuple[str, str], str]:
    colors = dict.fromkeys(["none", *(value for value in astuple(css_variable_palette()) if isinstance(value, str))])
    found: dict[tuple[str, str], str] = {}
    for number, color in enumerate(colors):
        found["fill", color] = f"f{number}"
        found["stroke", color] = f"s{number}"
    found |= {("stroke-width", f"{tenths / 10:g}"): f"w{tenths}" for tenths in range(10, 31)}
    found |= {("stroke-dasharray", dash): f"d{number}" for number, dash in enumerate(_DASHES)}
    found |= {("font-size", f"{size:g}"): f"t{size * 10:g}" for size in _FONT_SIZES}
    found |= {
        ("stroke-linecap", "round"): "r",
        ("text-anchor", "middle"): "a",
        ("font-weight", "600"): "b",
        ("text-decoration", "line-through"): "l",
    }
    return found
