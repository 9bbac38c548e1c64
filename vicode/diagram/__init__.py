"""Diagrams of designs: layout, rendering and export."""

from vicode.diagram.layered_layout import NodeLayout, complete_layout

__all__ = ["NodeLayout", "complete_layout"]
