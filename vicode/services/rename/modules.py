"""Renames constants, enumerations and elements in the hand-written modules of a project."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from vicode.model.names import package_name
from vicode.model.project import Project
from vicode.model.rename import ReferenceKind, ReferenceRename, SymbolRef
from vicode.model.rename.modules import find_unrenamed_lines, rename_in_module
from vicode.services import messages
from vicode.services.rename.component import FileChange
from vicode.store import is_read_only

_KINDS = {
    "components": None,
    "constants": ReferenceKind.CONSTANT,
    "enumerations": ReferenceKind.ENUMERATION,
    "elements": ReferenceKind.ELEMENT,
}
_SUFFIXES = (".py", ".cpp", ".hpp", ".cc", ".h")


@dataclass(frozen=True, slots=True, kw_only=True)
class ModuleRenames:
    """The modules to write; `remaining` are lines that still contain the name, `locked` the read-only files."""

    changes: tuple[FileChange, ...] = ()
    remaining: tuple[str, ...] = ()
    locked: tuple[str, ...] = ()


def plan_module_renames(folder: Path, project: Project, symbol: SymbolRef, new: str) -> ModuleRenames:
    """Plan the rename of a symbol in the modules of a project folder.

    The names of components, which may be those of classes, are only listed; their members are left to P212.
    """
    if symbol.section not in _KINDS:
        return ModuleRenames()
    kind = _KINDS[symbol.section]
    rename = ReferenceRename(kind=kind or ReferenceKind.CONSTANT, old=symbol.name, new=new, owner=symbol.owner)
    changes: list[FileChange] = []
    remaining: list[str] = []
    for file in _hand_written_files(folder, project):
        try:
            text = file.read_bytes().decode("utf-8")
        except (OSError, UnicodeDecodeError):
            continue
        is_sure = kind is not None and file.suffix == ".py"
        renamed = rename_in_module(text, package_name(project.name), rename) if is_sure else text
        shown = file.relative_to(folder).as_posix()
        if renamed != text:
            before, after = text.splitlines(), renamed.splitlines()
            count = sum(old != now for old, now in zip(before, after, strict=True))
            changes.append(FileChange(file=file, old=text, new=renamed, summary=messages.line_summary(shown, count)))
        remaining += [f"{shown}:{line}" for line in find_unrenamed_lines(renamed, rename)]
    locked = tuple(change.file.name for change in changes if is_read_only(change.file))
    return ModuleRenames(changes=tuple(changes), remaining=tuple(remaining), locked=locked)


def _hand_written_files(folder: Path, project: Project) -> Iterator[Path]:
    """The sources in a folder, without generated ones, hidden folders and virtual environments."""
    output = (folder / project.generated).resolve()
    pending = [folder]
    while pending:
        current = pending.pop()
        for path in sorted(current.iterdir()):
            if path.is_dir() and not path.is_symlink():
                is_left_out = path.name.startswith(".") or path.resolve() == output or (path / "pyvenv.cfg").exists()
                pending += [] if is_left_out else [path]
            elif path.suffix in _SUFFIXES and path.is_file():
                yield path
