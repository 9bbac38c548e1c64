"""Exports the diagram of a design as a picture or as text for other tools."""

from collections.abc import Callable, Collection

from vicode.diagram.export_formats import ExportFormat, ExportOptions
from vicode.diagram.graphviz_text import write_graphviz
from vicode.diagram.mermaid import write_mermaid
from vicode.diagram.palettes import DARK, LIGHT
from vicode.diagram.pdf import write_pdf
from vicode.diagram.plantuml import write_plantuml
from vicode.diagram.png import write_png
from vicode.diagram.primitives import VectorImage
from vicode.diagram.render import render_design
from vicode.diagram.svg import write_svg
from vicode.model.design import Design
from vicode.model.disabled import strip_disabled


def export_design(design: Design, export_format: ExportFormat, options: ExportOptions | None = None) -> bytes:
    """Return the content of the file. Equal designs give equal bytes; PNG also depends on the installed fonts."""
    chosen = options or ExportOptions()
    writers: dict[ExportFormat, Callable[[Design, Collection[str] | None], str]] = {
        ExportFormat.MERMAID: lambda design, only: write_mermaid(design, only=only),
        ExportFormat.PLANTUML: lambda design, only: write_plantuml(design, only=only),
        ExportFormat.DOT: lambda design, only: write_graphviz(design, only=only, links=chosen.links),
    }
    if export_format in writers:
        # Text formats describe the behavior; pictures also show disabled elements.
        return writers[export_format](strip_disabled(design), chosen.only).encode()
    drawing = render_design(design, only=chosen.only, links=chosen.links, palette=DARK if chosen.dark else LIGHT)
    painters: dict[ExportFormat, Callable[[VectorImage], bytes]] = {
        ExportFormat.SVG: lambda drawing: write_svg(drawing).encode(),
        ExportFormat.PDF: write_pdf,
        ExportFormat.PNG: lambda drawing: write_png(drawing, scale=chosen.scale),
    }
    return painters[export_format](drawing)
