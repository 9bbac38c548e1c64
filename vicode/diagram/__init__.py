"""Pictures of designs: where things stand when the design does not say it."""

from vicode.diagram.layered_layout import NodeLayout, complete_layout

__all__ = ["NodeLayout", "complete_layout"]
