"""A NiceGUI element that shows forms of the items of a design; the browser draws them, the design stays in Python."""

from vicode.editor.inspector.element import FormView

__all__ = ["FormView"]
