"""The environment of a fresh interpreter that is to import vicode and a user's code."""

import os
from pathlib import Path


def fresh_environment(**more: str) -> dict[str, str]:
    """Ours, with vicode on the path even where it is not installed, and with `more` set."""
    home = str(Path(__file__).parents[2])
    paths = [path for path in os.environ.get("PYTHONPATH", "").split(os.pathsep) if path]
    return {**os.environ, "PYTHONPATH": os.pathsep.join([*paths, home]), "PYTHONIOENCODING": "utf-8", **more}
