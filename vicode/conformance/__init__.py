"""Runs one design in every language on the same inputs, and compares the traces."""
