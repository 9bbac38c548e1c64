"""The folders of our scripts, known to every page from its start, so that what is shown later can be loaded later."""

from pathlib import Path

from nicegui.dependencies import register_esm


def _register(package: str) -> Path:
    folder = Path(__file__).parent / package / "js"
    # NiceGUI lets browsers keep these files for a year under a key made of this time; a folder's own time would
    # not change when one of its files is edited.
    register_esm(f"vicode-{package}", folder, max_time=max(path.stat().st_mtime for path in folder.iterdir()))
    return folder


CANVAS_JS, CODE_JS, TABLE_JS = _register("canvas"), _register("code"), _register("table")
