"""The command line: one module per command; heavy imports are deferred until a command runs."""

from vicode.cli.entry_point import main

__all__ = ["main"]
