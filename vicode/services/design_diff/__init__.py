"""Versions of designs: pairs of files or revisions, their differences in words and pictures, and their search."""
