"""Reads edits outside regions of a generated file back as edits of its design."""

from vicode.sync.interpret.cpp_interpretation import interpret_cpp_edits
from vicode.sync.interpret.interpretation import Interpretation, InterpretedEdit, interpret_edits

INTERPRETERS = {"python": interpret_edits, "cpp": interpret_cpp_edits}
"""The functions that interpret edits, by language."""

__all__ = ["INTERPRETERS", "Interpretation", "InterpretedEdit", "interpret_cpp_edits", "interpret_edits"]
