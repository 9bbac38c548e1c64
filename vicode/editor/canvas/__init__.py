"""The canvas: our own NiceGUI element that draws a state machine and reports gestures; the design stays in Python."""

from vicode.editor.canvas.element import Canvas

__all__ = ["Canvas"]
