"""Writes changes of a program into its original files: what did not change keeps each character."""
