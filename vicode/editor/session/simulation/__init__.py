"""What a simulation shows on the canvas: breakpoints, and what recorded traces say of states and transitions."""

from vicode.editor.session.simulation.breakpoints import Breakpoints

__all__ = ["Breakpoints"]
