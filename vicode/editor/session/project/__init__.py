"""Edits of the project and its files: renames, interfaces, trash."""
