"""The command line: one module a command, imported light; what is heavy is imported when a command runs."""

from vicode.cli.entry_point import main

__all__ = ["main"]
