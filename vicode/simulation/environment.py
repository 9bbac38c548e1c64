"""The environment of a new interpreter that imports vicode and user code."""

import os
from pathlib import Path


def fresh_environment(**more: str) -> dict[str, str]:
    """This process's environment with `more` added, and with vicode on the path even if it is not installed."""
    home = str(Path(__file__).parents[2])
    paths = [path for path in os.environ.get("PYTHONPATH", "").split(os.pathsep) if path]
    return {**os.environ, "PYTHONPATH": os.pathsep.join([*paths, home]), "PYTHONIOENCODING": "utf-8", **more}
