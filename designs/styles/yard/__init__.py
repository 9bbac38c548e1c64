"""The yard of the rover."""
