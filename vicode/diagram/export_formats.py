"""The formats of exports: one record each, with a function that imports its writer when it is called."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from vicode.diagram.primitives import VectorImage
    from vicode.model.design import Design
    from vicode.model.project import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportOptions:
    """What to export: `only` names states (None for all); with `links`, the components they use are included.

    The `project` is needed by formats with `needs_project`; without it, the design is alone in one.
    """

    project: Project | None = None
    only: frozenset[str] | None = None
    links: bool = True
    dark: bool = False
    scale: float = 2.0


class NotExportableError(Exception):
    """A format has no counterpart of a part of the design; the message says which."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportFormat:
    """A format of exported diagrams, or of the design itself.

    Attributes:
        name: The name on the command line.
        title: The name shown to users, with the purpose in parentheses.
        suffixes: File name suffixes; new files get the first.
        write: Returns the content of the file; the same design gives the same bytes. PNG depends on installed fonts.
            Raises NotExportableError if the format cannot express the design; SCXML and Promela do.
        needs_project: Whether other designs of the project are part of the content.
    """

    name: str
    title: str
    suffixes: tuple[str, ...]
    write: Callable[[Design, ExportOptions], bytes]
    media_type: str = "text/plain; charset=utf-8"
    needs_project: bool = False

    @property
    def label(self) -> str:
        """The title without the purpose."""
        return self.title.partition(" (")[0]

    @property
    def is_text(self) -> bool:
        """Whether the format describes the behavior as text instead of a picture."""
        return self.media_type.startswith("text/")


def _svg(design: Design, options: ExportOptions) -> bytes:
    from vicode.diagram.svg import write_svg

    return write_svg(_picture(design, options)).encode()


def _pdf(design: Design, options: ExportOptions) -> bytes:
    from vicode.diagram.pdf import write_pdf

    return write_pdf(_picture(design, options))


def _png(design: Design, options: ExportOptions) -> bytes:
    from vicode.diagram.png import write_png

    return write_png(_picture(design, options), scale=options.scale)


def _mermaid(design: Design, options: ExportOptions) -> bytes:
    from vicode.diagram.mermaid import write_mermaid

    return write_mermaid(_behavior(design), only=options.only).encode()


def _plantuml(design: Design, options: ExportOptions) -> bytes:
    from vicode.diagram.plantuml import write_plantuml

    return write_plantuml(_behavior(design), only=options.only).encode()


def _dot(design: Design, options: ExportOptions) -> bytes:
    from vicode.diagram.graphviz_text import write_graphviz

    return write_graphviz(_behavior(design), only=options.only, links=options.links).encode()


def _scxml(design: Design, options: ExportOptions) -> bytes:
    from vicode.diagram.scxml import write_scxml

    if options.only is not None:
        raise NotExportableError("SCXML contains the whole design: leave out the selection of states")
    return write_scxml(design).encode()


def _promela(design: Design, options: ExportOptions) -> bytes:
    from vicode.diagram.promela import write_promela
    from vicode.model.project import Project

    if options.only is not None:
        raise NotExportableError("Promela contains the whole design: leave out the selection of states")
    return write_promela(options.project or Project(name="", designs=(design,)), design).encode()


def _picture(design: Design, options: ExportOptions) -> VectorImage:
    from vicode.diagram.palettes import DARK, LIGHT
    from vicode.diagram.render import render_design

    return render_design(design, only=options.only, links=options.links, palette=DARK if options.dark else LIGHT)


def _behavior(design: Design) -> Design:
    """The design without disabled elements, which only pictures show."""
    from vicode.model.disabled import strip_disabled

    return strip_disabled(design)


_FORMATS = (
    ExportFormat(name="svg", title="SVG (scalable)", suffixes=(".svg",), media_type="image/svg+xml", write=_svg),
    ExportFormat(name="pdf", title="PDF (one page)", suffixes=(".pdf",), media_type="application/pdf", write=_pdf),
    ExportFormat(name="png", title="PNG (for slides)", suffixes=(".png",), media_type="image/png", write=_png),
    ExportFormat(name="mermaid", title="Mermaid (for READMEs)", suffixes=(".mmd", ".mermaid"), write=_mermaid),
    ExportFormat(name="plantuml", title="PlantUML", suffixes=(".puml", ".plantuml"), write=_plantuml),
    ExportFormat(name="dot", title="DOT (Graphviz)", suffixes=(".dot", ".gv"), write=_dot),
    ExportFormat(name="scxml", title="SCXML (for state machine tools)", suffixes=(".scxml",), write=_scxml),
    ExportFormat(
        name="promela", title="Promela (team model for SPIN)", suffixes=(".pml",), write=_promela, needs_project=True
    ),
)
EXPORT_FORMATS = {each.name: each for each in _FORMATS}
"""The formats by name."""
