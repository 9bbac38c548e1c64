"""Generated code of an open design, and edits of it."""
