"""Renames any symbol in the files of a project, outside of an open editor."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from vicode.model.design import Design
from vicode.model.edits import rename_state
from vicode.model.lowering import describe_origin
from vicode.model.project import Project
from vicode.model.rename import SymbolRef
from vicode.services import messages
from vicode.services.rename.component import FileChange, plan_component_rename
from vicode.services.rename.modules import plan_module_renames
from vicode.services.rename.name_errors import state_name_error
from vicode.services.rename.project_files import ProjectFiles, validate_writable
from vicode.services.rename.symbol import derived_names, describe_new_errors, plan_symbol_rename
from vicode.store import replace_text, save_design


@dataclass(frozen=True, slots=True, kw_only=True)
class FileRenamePlan:
    """The files to write and the file that a renamed component leaves, or the error message.

    `notes` say what is left to rename by hand.
    """

    changes: tuple[FileChange, ...] = ()
    removed: Path | None = None
    error: str = ""
    notes: tuple[str, ...] = ()


def plan_rename(project_files: ProjectFiles, symbol: SymbolRef, new: str) -> FileRenamePlan:
    """Plan the rename of a symbol, a state or a component; no file is written.

    Raises:
        ValueError: A file has content that the rename would lose.
    """
    broken = project_files.broken_file_names
    if broken:
        return FileRenamePlan(error=f"{broken[0]} cannot be read; correct it first, as it may contain the name")
    design = project_files.project.design(symbol.component or symbol.name)
    if symbol.section == "components" and design is not None:
        plan = plan_component_rename(project_files, symbol.name, new)
        places = plan_module_renames(project_files.folder, project_files.project, symbol, new).remaining
        return FileRenamePlan(changes=plan.changes, removed=plan.removed, error=plan.error, notes=_notes(places))
    if symbol.section == "states":
        assert design is not None
        error = state_name_error(new, {state.name for state in design.states})
        origin = derived_names(design).get(symbol.name, ())
        error = error or (messages.derived_name(symbol.name, describe_origin(origin)) if origin else "")
        error = error or validate_writable(project_files, [design.component])
        renamed = rename_state(design, symbol.name, new)
        error = error or _describe_new_errors(project_files.project, renamed)
        changes = () if error else _design_changes(project_files, renamed)
        return FileRenamePlan(changes=changes, error=error)
    found = plan_symbol_rename(project_files, symbol, new)
    changes = found.changes if found.design is None else _design_changes(project_files, found.design)
    notes = (*_notes(found.ambiguous_places), *((found.note,) if found.note else ()))
    return FileRenamePlan(changes=changes, error=found.error, notes=notes)


def _describe_new_errors(project: Project, renamed: Design) -> str:
    designs = tuple(renamed if each.component == renamed.component else each for each in project.designs)
    return describe_new_errors(project, replace(project, designs=designs), (renamed.component,))


def write_changes(changes: Sequence[FileChange], removed: Path | None = None) -> None:
    """Write all files, and remove the one that a renamed component leaves, or do nothing.

    Raises:
        OSError: A file cannot be written, or another program has changed it.
    """
    written: list[FileChange] = []
    try:
        for change in changes:
            replace_text(change.file, change.old, change.new)
            written.append(change)
        if removed is not None:
            removed.unlink()
    except OSError:
        _restore(written)
        raise


def _notes(places: Sequence[str]) -> tuple[str, ...]:
    return tuple(f"check by hand: {place}" for place in places)


def _restore(written: Sequence[FileChange]) -> None:
    for change in reversed(written):
        if change.old is None:
            change.file.unlink()
        else:
            replace_text(change.file, change.new, change.old)


def _design_changes(project_files: ProjectFiles, design: Design) -> tuple[FileChange, ...]:
    file = project_files.files[design.component]
    text = file.read_bytes().decode("utf-8")
    summary = messages.line_summary(design.component, 0)
    return (FileChange(file=file, old=text, new=save_design(design, text), summary=summary),)
