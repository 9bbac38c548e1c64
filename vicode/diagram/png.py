"""A drawing as PNG, painted from its SVG by resvg with the fonts of this machine."""

from pathlib import Path

from vicode.diagram.primitives import VectorImage
from vicode.diagram.svg import write_svg

# So many pixels take about 200 MB while they are painted; a larger drawing is painted smaller.
_MAX_PIXELS = 50_000_000.0


def write_png(image: VectorImage, *, scale: float = 2.0) -> bytes:
    """The bytes of the file, `scale` pixels to a pixel of the drawing as far as memory allows."""
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
            # A server may have no fonts at all.
            font_files=[str(fonts / "Vera.ttf"), str(fonts / "VeraBd.ttf")],
            sans_serif_family="Bitstream Vera Sans",
        )
    )
