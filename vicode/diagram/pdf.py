"""Writes a vector image as a PDF page of its size, with lines as lines and text as text."""

from collections.abc import Iterator
from functools import lru_cache
from io import BytesIO
from itertools import groupby
from pathlib import Path as File
from typing import Any

from vicode.diagram.primitives import PathShape, TextShape, VectorImage

_POINTS_PER_PIXEL = 0.75
# The largest page size of PDF.
_MAX_SIDE = 14_400.0
_BASELINE_SHIFT = 0.36
_STANDARD, _STANDARD_BOLD, _FALLBACK, _CHINESE = "Helvetica", "Helvetica-Bold", "VicodeMore", "STSong-Light"
_FIRST_CHINESE_CODE_POINT = 0x2E80
# Fonts with many glyphs and their usual paths; Helvetica covers Western Europe.
_FONT_FOLDERS = ("/usr/share/fonts", "/usr/local/share/fonts", "/Library/Fonts", "C:/Windows/Fonts")
_FONT_FILES = ("DejaVuSans.ttf", "NotoSans-Regular.ttf", "FreeSans.ttf", "Arial Unicode.ttf", "arial.ttf")


def write_pdf(image: VectorImage) -> bytes:
    """The content of the file; deterministic."""
    from reportlab.pdfgen.canvas import Canvas  # noqa: PLC0415 - it loads slowly

    longest = max(image.width, image.height)
    scale = min(_POINTS_PER_PIXEL, _MAX_SIDE / longest)
    file = BytesIO()
    page = Canvas(file, pagesize=(image.width * scale, image.height * scale), invariant=1, pageCompression=1)
    page.setTitle(image.title)
    page.setSubject(image.doc)
    page.setCreator("vicode")
    page.scale(scale, scale)
    # From here on in pixels of the image with y downwards, except that coordinates are flipped by `flip`.
    pen = _PdfPainter(page, left=image.left, bottom=image.top + image.height)
    pen.fill_page(image)
    for group in image.groups:
        for shape in group.shapes:
            pen.path(shape) if isinstance(shape, PathShape) else pen.text(shape)
    page.save()
    return file.getvalue()


class _PdfPainter:
    """Draws on a page whose y axis points up."""

    def __init__(self, page: Any, *, left: float, bottom: float) -> None:
        self.page, self.left, self.bottom = page, left, bottom

    def fill_page(self, drawing: VectorImage) -> None:
        self.page.setFillColor(drawing.background)
        self.page.rect(0, 0, drawing.width, drawing.height, stroke=0, fill=1)

    def path(self, path: PathShape) -> None:
        page = self.page
        drawn = page.beginPath()
        for letter, numbers in path.commands:
            points = [self._to_page(numbers[at], numbers[at + 1]) for at in range(0, len(numbers), 2)]
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

    def text(self, text: TextShape) -> None:
        page, size = self.page, text.font.size
        parts = [(font, part, page.stringWidth(part, font, size)) for font, part in _font_runs(text)]
        x, y = self._to_page(text.x, text.y + size * _BASELINE_SHIFT)
        whole = sum(width for _font, _part, width in parts)
        x -= whole / 2 if text.is_centered else 0
        page.setFillColor(text.fill)
        for font, part, width in parts:
            page.setFont(font, size)
            page.drawString(x, y, part)
            x += width
        if text.is_struck_through:
            page.setStrokeColor(text.fill)
            page.setDash([])
            page.setLineWidth(1)
            page.line(x - whole, y + size * 0.3, x, y + size * 0.3)

    def _to_page(self, x: float, y: float) -> tuple[float, float]:
        return (x - self.left, self.bottom - y)


def _font_runs(text: TextShape) -> Iterator[tuple[str, str]]:
    """The text in runs of one font each."""
    standard = _STANDARD_BOLD if text.font.bold else _STANDARD
    more = _fallback_glyphs()
    printable = "".join(letter if letter.isprintable() else "\ufffd" for letter in text.text)

    def font_of(letter: str) -> str:
        if _is_western(letter):
            return standard
        if ord(letter) in more:
            return _FALLBACK
        return _CHINESE if _FIRST_CHINESE_CODE_POINT <= ord(letter) < 0xD800 else standard

    for font, letters in groupby(printable, font_of):
        run = "".join(letters)
        # A character without a glyph is shown as a placeholder instead of being omitted.
        yield font, run if font in (_FALLBACK, _CHINESE) else run.encode("cp1252", "replace").decode("cp1252")


def _is_western(letter: str) -> bool:
    try:
        letter.encode("cp1252")
    except UnicodeEncodeError:
        return False
    return True


@lru_cache(maxsize=1)
def _fallback_glyphs() -> frozenset[int]:
    """Register the fallback fonts; returns the characters covered by the first one."""
    import reportlab  # noqa: PLC0415
    from reportlab.pdfbase import pdfmetrics  # noqa: PLC0415
    from reportlab.pdfbase.cidfonts import UnicodeCIDFont  # noqa: PLC0415
    from reportlab.pdfbase.ttfonts import TTFont  # noqa: PLC0415

    pdfmetrics.registerFont(UnicodeCIDFont(_CHINESE))
    own = File(reportlab.__file__).parent / "fonts" / "Vera.ttf"
    font = TTFont(_FALLBACK, str(_find_font() or own))
    pdfmetrics.registerFont(font)
    return frozenset(font.face.charToGlyph)


def _find_font() -> File | None:
    for name in _FONT_FILES:
        for folder in _FONT_FOLDERS:
            found = next(File(folder).rglob(name), None)
            if found is not None:
                return found
    return None
