"""The folders whose Python code the user trusts, remembered in the user's state folder."""

import json
import os
from collections.abc import Collection
from importlib.machinery import all_suffixes
from pathlib import Path

from vicode.model.project import Project
from vicode.model.traversal import iter_code
from vicode.output import write_atomically

_FILE = "trusted"
# Modules of this interpreter, and of others: compiled files are imported without their source.
_MODULE_SUFFIXES = (*all_suffixes(), ".py", ".pyc", ".pyd", ".so")


def is_trusted(state: Path, folder: Path) -> bool:
    """Whether the user trusts a folder or a parent of it."""
    own = folder.resolve()
    return any(parent in _trusted(state) for parent in (own, *own.parents))


def trust_folder(state: Path, folder: Path) -> None:
    """Remember that the user trusts a folder.

    Raises:
        OSError: The state folder cannot be written.
    """
    state.mkdir(parents=True, exist_ok=True, mode=0o700)
    folders = _trusted(state) | {folder.resolve()}
    # As JSON: a line break in a name must not trust another folder.
    write_atomically(state / _FILE, "".join(f"{json.dumps(str(path))}\n" for path in sorted(folders)))


def contains_code(folder: Path, project: Project, languages: Collection[str] = ("python",)) -> bool:
    """Whether a run may execute code that stands in the folder; by default a simulation, which runs Python."""
    in_designs = (located for design in project.designs for located in iter_code(design))
    return any(located.code.in_language(each) for located in in_designs for each in languages) or any(
        path.name.endswith(_MODULE_SUFFIXES) or _leads_outside(path, folder) for path in folder.rglob("*")
    )


def _leads_outside(path: Path, folder: Path) -> bool:
    """Whether a path is a link to a folder elsewhere: modules are imported from there, too."""
    return path.is_symlink() and path.is_dir() and not path.resolve().is_relative_to(os.path.realpath(folder))


def _trusted(state: Path) -> frozenset[Path]:
    try:
        lines = (state / _FILE).read_text(encoding="utf-8").splitlines()
        # Earlier versions wrote plain paths.
        return frozenset(Path(json.loads(line)) if line.startswith('"') else Path(line) for line in lines)
    except (OSError, ValueError):
        return frozenset()
