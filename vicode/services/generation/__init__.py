"""Generates code: plans the files of a project or of one design, and writes them with the designs that change."""
