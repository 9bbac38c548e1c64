"""Takes a drawing of a design out: as a picture, or as text that other tools draw."""

from collections.abc import Callable, Collection

from vicode.diagram.drawing import draw
from vicode.diagram.formats import Format, Wish
from vicode.diagram.graphviz_text import write_graphviz
from vicode.diagram.mermaid import write_mermaid
from vicode.diagram.palettes import DARK, LIGHT
from vicode.diagram.pdf import write_pdf
from vicode.diagram.plantuml import write_plantuml
from vicode.diagram.png import write_png
from vicode.diagram.shapes import Drawing
from vicode.diagram.svg import write_svg
from vicode.model.design import Design
from vicode.model.enabling import enabled_part


def export(design: Design, form: Format, wish: Wish | None = None) -> bytes:
    """The bytes of the file; the same design gives the same, a PNG by the same fonts."""
    chosen = wish or Wish()
    writers: dict[Format, Callable[[Design, Collection[str] | None], str]] = {
        Format.MERMAID: lambda design, only: write_mermaid(design, only=only),
        Format.PLANTUML: lambda design, only: write_plantuml(design, only=only),
        Format.DOT: lambda design, only: write_graphviz(design, only=only, links=chosen.links),
    }
    if form in writers:
        # A text is read as what the machine does; a picture shows what is kept without working as well.
        return writers[form](enabled_part(design), chosen.only).encode()
    drawing = draw(design, only=chosen.only, links=chosen.links, palette=DARK if chosen.dark else LIGHT)
    painters: dict[Format, Callable[[Drawing], bytes]] = {
        Format.SVG: lambda drawing: write_svg(drawing).encode(),
        Format.PDF: write_pdf,
        Format.PNG: lambda drawing: write_png(drawing, scale=chosen.scale),
    }
    return painters[form](drawing)
