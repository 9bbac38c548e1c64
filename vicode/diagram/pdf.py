"""A drawing as PDF: one page of its size, lines as lines and texts as texts."""

from collections.abc import Iterator
from functools import lru_cache
from io import BytesIO
from itertools import groupby
from pathlib import Path as File
from typing import Any

from vicode.diagram.shapes import Drawing, Path, Text

_POINTS_PER_PIXEL = 0.75
# PDF knows no larger pages.
_LONGEST_SIDE = 14_400.0
_MIDDLE = 0.36
_STANDARD, _STANDARD_BOLD, _MORE, _CHINESE = "Helvetica", "Helvetica-Bold", "VicodeMore", "STSong-Light"
_CHINESE_FROM = 0x2E80
# Fonts with many letters, where systems keep them; Helvetica has those of Western Europe.
_FONT_FOLDERS = ("/usr/share/fonts", "/usr/local/share/fonts", "/Library/Fonts", "C:/Windows/Fonts")
_FONT_FILES = ("DejaVuSans.ttf", "NotoSans-Regular.ttf", "FreeSans.ttf", "Arial Unicode.ttf", "arial.ttf")


def write_pdf(drawing: Drawing) -> bytes:
    """The bytes of the file; the same drawing gives the same."""
    from reportlab.pdfgen.canvas import Canvas  # noqa: PLC0415 - it loads slowly

    longest = max(drawing.width, drawing.height)
    scale = min(_POINTS_PER_PIXEL, _LONGEST_SIDE / longest)
    file = BytesIO()
    page = Canvas(file, pagesize=(drawing.width * scale, drawing.height * scale), invariant=1, pageCompression=1)
    page.setTitle(drawing.title)
    page.setSubject(drawing.doc)
    page.setCreator("vicode")
    page.scale(scale, scale)
    # From here on in pixels of the drawing, y downwards as far as numbers go: every y is turned by `flip`.
    pen = _Pen(page, left=drawing.left, bottom=drawing.top + drawing.height)
    pen.fill_page(drawing)
    for group in drawing.groups:
        for shape in group.shapes:
            pen.path(shape) if isinstance(shape, Path) else pen.text(shape)
    page.save()
    return file.getvalue()


class _Pen:
    """Draws on a page whose y goes upwards."""

    def __init__(self, page: Any, *, left: float, bottom: float) -> None:
        self.page, self.left, self.bottom = page, left, bottom

    def fill_page(self, drawing: Drawing) -> None:
        self.page.setFillColor(drawing.paper)
        self.page.rect(0, 0, drawing.width, drawing.height, stroke=0, fill=1)

    def path(self, path: Path) -> None:
        page = self.page
        drawn = page.beginPath()
        for letter, numbers in path.steps:
            points = [self._turned(numbers[at], numbers[at + 1]) for at in range(0, len(numbers), 2)]
            flat = [value for point in points for value in point]
            {"M": drawn.moveTo, "L": drawn.lineTo, "C": drawn.curveTo, "Z": drawn.close}[letter](*flat)
        if path.fill:
            page.setFillColor(path.fill)
        if path.stroke:
            page.setStrokeColor(path.stroke)
            page.setLineWidth(path.width)
            page.setLineJoin(1)
            page.setLineCap(0 if path.dash and path.dash[0] >= path.width else 1)
            page.setDash(list(path.dash))
        page.drawPath(drawn, stroke=int(bool(path.stroke)), fill=int(bool(path.fill)))

    def text(self, text: Text) -> None:
        page, size = self.page, text.letters.size
        parts = [(font, part, page.stringWidth(part, font, size)) for font, part in _parts(text)]
        x, y = self._turned(text.x, text.y + size * _MIDDLE)
        whole = sum(width for _font, _part, width in parts)
        x -= whole / 2 if text.is_centred else 0
        page.setFillColor(text.fill)
        for font, part, width in parts:
            page.setFont(font, size)
            page.drawString(x, y, part)
            x += width
        if text.is_struck:
            page.setStrokeColor(text.fill)
            page.setDash([])
            page.setLineWidth(1)
            page.line(x - whole, y + size * 0.3, x, y + size * 0.3)

    def _turned(self, x: float, y: float) -> tuple[float, float]:
        return (x - self.left, self.bottom - y)


def _parts(text: Text) -> Iterator[tuple[str, str]]:
    """The text in runs of one font each."""
    standard = _STANDARD_BOLD if text.letters.bold else _STANDARD
    more = _glyphs_of_more()
    printable = "".join(letter if letter.isprintable() else "\ufffd" for letter in text.text)

    def font_of(letter: str) -> str:
        if _is_western(letter):
            return standard
        if ord(letter) in more:
            return _MORE
        return _CHINESE if _CHINESE_FROM <= ord(letter) < 0xD800 else standard

    for font, letters in groupby(printable, font_of):
        run = "".join(letters)
        # What no font has is shown as that, instead of not at all.
        yield font, run if font in (_MORE, _CHINESE) else run.encode("cp1252", "replace").decode("cp1252")


def _is_western(letter: str) -> bool:
    try:
        letter.encode("cp1252")
    except UnicodeEncodeError:
        return False
    return True


@lru_cache(maxsize=1)
def _glyphs_of_more() -> frozenset[int]:
    """Makes the further fonts known; answers which letters the first of them has."""
    import reportlab  # noqa: PLC0415
    from reportlab.pdfbase import pdfmetrics  # noqa: PLC0415
    from reportlab.pdfbase.cidfonts import UnicodeCIDFont  # noqa: PLC0415
    from reportlab.pdfbase.ttfonts import TTFont  # noqa: PLC0415

    pdfmetrics.registerFont(UnicodeCIDFont(_CHINESE))
    own = File(reportlab.__file__).parent / "fonts" / "Vera.ttf"
    font = TTFont(_MORE, str(_find_font() or own))
    pdfmetrics.registerFont(font)
    return frozenset(font.face.charToGlyph)


def _find_font() -> File | None:
    for name in _FONT_FILES:
        for folder in _FONT_FOLDERS:
            found = next(File(folder).rglob(name), None)
            if found is not None:
                return found
    return None
