"""A NiceGUI element that draws a state machine and reports the user's gestures; the design stays in Python."""

from vicode.editor.canvas.element import Canvas

__all__ = ["Canvas"]
