"""Runs ruff on generated code."""

import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

from vicode.output import OutputFile

_RUFF = [sys.executable, "-m", "ruff"]
_RULES = "E,F,I,UP,B,C4,PIE,RET,W,D2,D3"
_HAND_WRITTEN = 'lint.isort.known-first-party=["field", "parts", "eyes", "legs"]'
# Docs may contain any text, and designs may contain -(-x).
_IGNORED = "B002,B018,D203,D205,D213,D301,D208,D207,D214,RET505"


def write_files(files: Iterable[OutputFile], folder: Path) -> None:
    for file in files:
        path = folder / file.path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(file.text, encoding="utf-8")


def format_diff(folder: Path) -> str:
    """Return the changes of the formatter as a diff."""
    command = [*_RUFF, "format", "--isolated", "--no-cache", "--line-length", "120", "--diff", "."]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False).stdout


def lint_errors(folder: Path) -> str:
    """Return the findings of the linter."""
    command = [*_RUFF, "check", "--isolated", "--no-cache", "--quiet", "--output-format", "concise"]
    command += ["--line-length", "120", "--select", _RULES, "--ignore", _IGNORED, "--config", _HAND_WRITTEN]
    return subprocess.run([*command, "."], cwd=folder, capture_output=True, text=True, check=False).stdout
