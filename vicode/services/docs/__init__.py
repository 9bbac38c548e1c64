"""Builds documentation sites: loads projects and behaviors, builds their pages, and remembers the last build."""
