"""The colors of pages and canvas: every pair that is read on each other has enough contrast, light and dark."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2] / "vicode" / "editor"
PAGES = (ROOT / "pages" / "theme.css").read_text(encoding="utf-8")
CANVAS = (ROOT / "canvas" / "js" / "canvas.css").read_text(encoding="utf-8")
TEXT, SIGN = 4.5, 3.0

READ = [
    (front, back, TEXT)
    for back in ("paper", "panel", "faint", "accent-soft")
    for front in ("text", "muted", "accent", "error", "warning", "note", "good")
]
READ += [("on-accent", "accent", TEXT), ("on-error", "error", TEXT), ("panel", "text", TEXT)]
DRAWN = [
    (front, back, TEXT)
    for front, back in (
        ("text", "paper"),
        ("text", "box"),
        ("text", "plate"),
        ("text", "active-fill"),
        ("text", "common-fill"),
        ("text", "accent-soft"),
        ("muted", "paper"),
        ("muted", "box"),
        ("muted", "plate"),
        ("component-text", "component"),
        ("requires", "box"),
        ("modulates", "box"),
        ("on-badge", "error"),
        ("on-badge", "warning"),
        ("on-badge", "note"),
        ("on-badge", "muted"),
    )
]
DRAWN += [
    (front, "paper", SIGN)
    for front in ("edge", "box-line", "accent", "requires", "modulates", "common", "component-line", "active", "start")
]


def tokens(sheet: str, selector: str) -> dict[str, str]:
    """The colors that a rule gives."""
    body = re.search(re.escape(selector) + r"\s*\{(.*?)\}", sheet, re.DOTALL)
    assert body is not None
    return dict(re.findall(r"--([\w-]+):\s*(#[0-9a-f]{6})", body.group(1)))


def contrast(one: str, other: str) -> float:
    """WCAG 2.2, success criterion 1.4.3."""
    darker, lighter = sorted((luminance(one), luminance(other)))
    return (lighter + 0.05) / (darker + 0.05)


def luminance(color: str) -> float:
    parts = [int(color[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    red, green, blue = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def themes(sheet: str, light: str, dark: str) -> dict[str, dict[str, str]]:
    return {"light": tokens(sheet, light), "dark": {**tokens(sheet, light), **tokens(sheet, dark)}}


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_pages_can_be_read(theme: str) -> None:
    assert too_pale(themes(PAGES, ":root", "body.body--dark")[theme], READ) == []


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_canvas_can_be_read(theme: str) -> None:
    assert too_pale(themes(CANVAS, ".stage", '.stage[data-theme="dark"]')[theme], DRAWN) == []


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_pages_and_canvas_share_their_colors(theme: str) -> None:
    page = themes(PAGES, ":root", "body.body--dark")[theme]
    canvas = themes(CANVAS, ".stage", '.stage[data-theme="dark"]')[theme]
    shared = ("paper", "text", "muted", "accent")
    assert {name: canvas[name] for name in shared} == {name: page[name] for name in shared}


def test_the_first_paint_has_the_color_of_the_page() -> None:
    look = (ROOT / "pages" / "theme.py").read_text(encoding="utf-8")
    for theme in themes(PAGES, ":root", "body.body--dark").values():
        assert f"background: {theme['paper']};" in look


def too_pale(colors: dict[str, str], pairs: list[tuple[str, str, float]]) -> list[str]:
    measured = [(front, back, contrast(colors[front], colors[back]), least) for front, back, least in pairs]
    return [f"{front} on {back}: {ratio:.2f} < {least}" for front, back, ratio, least in measured if ratio < least]
