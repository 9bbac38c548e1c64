"""The sample projects: lists them, and copies one to a folder of the user."""

import re
import shutil
import tempfile
from pathlib import Path

_PACKAGE_FOLDER = Path(__file__).parent
_GENERATED = re.compile(r"^generated:.*$", re.MULTILINE)
_IGNORED = shutil.ignore_patterns("__pycache__", ".*")
DEFAULT_SAMPLE = "forward"


def sample_names() -> tuple[str, ...]:
    return tuple(sorted(path.name for path in _folder().iterdir() if path.is_dir()))


def copy_sample(name: str, target: Path) -> None:
    """Copy a sample to a folder that is empty or does not exist. The code of the copy is generated inside the copy.

    Raises:
        FileExistsError: The target exists and is not an empty folder.
        OSError: The target cannot be written; it is as before.
    """
    if target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise FileExistsError(17, "exists and is not an empty folder", str(target))
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=f".{target.name}.", dir=target.parent) as folder:
        copy = Path(folder, "copy")
        shutil.copytree(_folder() / name, copy, ignore=_IGNORED)
        project = copy / "project.yaml"
        if project.exists():
            text = project.read_text(encoding="utf-8")
            project.write_text(_GENERATED.sub("generated: generated", text), encoding="utf-8")
        copy.replace(target)


def _folder() -> Path:
    # An installed package contains the samples; in a checkout they are next to the package.
    installed = _PACKAGE_FOLDER / "_designs"
    return installed if installed.is_dir() else _PACKAGE_FOLDER.parent / "designs"
