"""Registers the folders with ES modules on each page, so that elements added later can import them."""

from pathlib import Path

from nicegui.dependencies import register_esm


def _register(package: str) -> Path:
    folder = Path(__file__).parent / package / "js"
    # Browsers cache these files for a year under a key derived from this time. The modification time of the folder
    # itself does not change when a file in it is edited.
    register_esm(f"vicode-{package}", folder, max_time=max(path.stat().st_mtime for path in folder.iterdir()))
    return folder


CANVAS_JS, CODE_JS, TABLE_JS = _register("canvas"), _register("code"), _register("table")
INSPECTOR_JS = _register("inspector")
