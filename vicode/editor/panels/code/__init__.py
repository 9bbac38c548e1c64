"""Panels and dialogs for generated code and its edits."""
