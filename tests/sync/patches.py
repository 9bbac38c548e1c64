"""Applies patches with the program `git`."""

import subprocess
from pathlib import Path


def apply_patch(text: str, patch: str, folder: Path) -> str:
    """Return a text after a patch of the file `Player` or of any other one."""
    file = patch.split("\n", 1)[0].removeprefix("--- a/")
    (folder / file).write_text(text, encoding="utf-8")
    (folder / "edit.patch").write_text(patch, encoding="utf-8")
    subprocess.run(["git", "apply", "edit.patch"], cwd=folder, check=True)
    return (folder / file).read_text(encoding="utf-8")
