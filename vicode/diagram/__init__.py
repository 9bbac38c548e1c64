"""Diagrams of designs: layout, rendering and export."""
