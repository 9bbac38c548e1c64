"""The list of findings, and the way to what they name."""
