"""Commands: palette, search, help and the tour."""
