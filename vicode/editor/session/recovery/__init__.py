"""Saving by itself, and what is left after a crash."""
