"""Rasterizes an SVG to PNG with resvg and the fonts of this machine."""

from pathlib import Path

from vicode.diagram.primitives import VectorImage
from vicode.diagram.svg import write_svg

# This many pixels take about 200 MB while rendering; larger images are scaled down.
_MAX_PIXELS = 50_000_000.0


def write_png(image: VectorImage, *, scale: float = 2.0) -> bytes:
    """The content of the file, with up to `scale` pixels per pixel of the image, limited by memory."""
    import reportlab  # noqa: PLC0415 - it and resvg load slowly, and are wanted for files alone
    import resvg_py  # noqa: PLC0415

    pixels = image.width * image.height
    zoom = min(scale, (_MAX_PIXELS / pixels) ** 0.5)
    fonts = Path(reportlab.__file__).parent / "fonts"
    return bytes(
        resvg_py.svg_to_bytes(
            svg_string=write_svg(image),
            width=max(1, round(image.width * zoom)),
            height=max(1, round(image.height * zoom)),
            # A server may have no fonts.
            font_files=[str(fonts / "Vera.ttf"), str(fonts / "VeraBd.ttf")],
            sans_serif_family="Bitstream Vera Sans",
        )
    )
