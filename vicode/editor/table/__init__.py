"""The table: our own NiceGUI element that shows a design as rows and cells; the design stays in Python."""

from vicode.editor.table.element import TableGrid

__all__ = ["TableGrid"]
