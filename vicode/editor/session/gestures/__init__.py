"""Edits that the canvas, the table and the forms request, and their way to the current design."""
