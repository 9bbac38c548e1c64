"""Formats and options of exported diagrams."""

from dataclasses import dataclass, field
from enum import StrEnum


class ExportFormat(StrEnum):
    """A format that a diagram can be exported as."""

    SVG = "svg"
    PDF = "pdf"
    PNG = "png"
    MERMAID = "mermaid"
    PLANTUML = "plantuml"
    DOT = "dot"

    @property
    def label(self) -> str:
        """The name shown to users."""
        return {ExportFormat.MERMAID: "Mermaid", ExportFormat.PLANTUML: "PlantUML"}.get(self, self.upper())

    @property
    def suffix(self) -> str:
        return {ExportFormat.MERMAID: ".mmd", ExportFormat.PLANTUML: ".puml"}.get(self, f".{self}")

    @property
    def media_type(self) -> str:
        types = {ExportFormat.SVG: "image/svg+xml", ExportFormat.PDF: "application/pdf", ExportFormat.PNG: "image/png"}
        return types.get(self, "text/plain; charset=utf-8")


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportOptions:
    """What to export: `only` names states (None for all); with `links`, the components they use are included."""

    only: frozenset[str] | None = None
    links: bool = True
    dark: bool = False
    scale: float = field(default=2.0)
