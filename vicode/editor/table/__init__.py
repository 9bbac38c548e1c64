"""A NiceGUI element that shows a design as an editable table; the design stays in Python."""

from vicode.editor.table.element import TableGrid

__all__ = ["TableGrid"]
