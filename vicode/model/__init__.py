"""Designs and projects as frozen values, expressions as typed trees, and pure functions that edit and query them.

The package does not depend on files, YAML or the user interface.
"""
