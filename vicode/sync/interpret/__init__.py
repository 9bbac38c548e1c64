"""Reads edits outside regions of a generated Python file back as edits of its design."""

from vicode.sync.interpret.interpretation import Interpretation, InterpretedEdit, interpret_edits

__all__ = ["Interpretation", "InterpretedEdit", "interpret_edits"]
