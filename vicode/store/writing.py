"""Writes the files of a project so that a crash leaves the old text or the new one, never a half."""

import os
from pathlib import Path

from vicode.output import write_atomically


def write_text(path: Path, text: str) -> None:
    """Replace a file in one step and see it safely on the disk; links are followed, the mode is kept.

    Raises:
        OSError: The folder cannot be written; the old file is as it was.
    """
    write_atomically(path, text)
    folder = os.open(path.resolve().parent, os.O_RDONLY)
    try:
        # The new name is safe only when the folder that holds it is.
        os.fsync(folder)
    finally:
        os.close(folder)
