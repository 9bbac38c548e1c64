"""An XABSL behavior as designs: the record of its import, merges of its changes, and writing edits of designs back."""
