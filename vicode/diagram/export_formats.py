"""What a drawing can be taken out as."""

from dataclasses import dataclass, field
from enum import StrEnum


class ExportFormat(StrEnum):
    """What a drawing can be written as."""

    SVG = "svg"
    PDF = "pdf"
    PNG = "png"
    MERMAID = "mermaid"
    PLANTUML = "plantuml"
    DOT = "dot"

    @property
    def label(self) -> str:
        """What people call it."""
        return {ExportFormat.MERMAID: "Mermaid", ExportFormat.PLANTUML: "PlantUML"}.get(self, self.upper())

    @property
    def suffix(self) -> str:
        """How the names of its files end."""
        return {ExportFormat.MERMAID: ".mmd", ExportFormat.PLANTUML: ".puml"}.get(self, f".{self}")

    @property
    def media_type(self) -> str:
        """How a browser is told what it is."""
        types = {ExportFormat.SVG: "image/svg+xml", ExportFormat.PDF: "application/pdf", ExportFormat.PNG: "image/png"}
        return types.get(self, "text/plain; charset=utf-8")


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportOptions:
    """What of a design is drawn, and how; `only` names states, None for all, with what they use if `links`."""

    only: frozenset[str] | None = None
    links: bool = True
    dark: bool = False
    scale: float = field(default=2.0)
