"""Merges a changed behavior into its designs: the base is the behavior as it was imported before."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from vicode.importers import import_behavior
from vicode.model.design import Design
from vicode.services.imported_behavior.design_files import design_paths, format_files
from vicode.services.imported_behavior.import_record import RECORD_FILE, ImportRecord, format_record
from vicode.store import merge_comments, merge_file_texts, open_project, read_design
from vicode.transactions import replace_files
from vicode.xabsl.compiler import compile_source
from vicode.xabsl.source_loader import ProgramSource

_PROJECT_FILE = "project.yaml"


@dataclass(slots=True)
class ImportMerge:
    """The files to write (None to delete) by path relative to the project, and the conflicts."""

    texts: dict[str, str | None] = field(default_factory=dict)
    conflicts: list[str] = field(default_factory=list)


def merge_behavior(
    folder: Path, record: ImportRecord, source: ProgramSource, *, name: str | None = None, encoding: str = ""
) -> ImportMerge:
    """Merge the changes of a behavior since its last import into the designs of a project, and write the files.

    Args:
        folder: The folder of the project.
        record: The behavior as it was imported.
        source: The behavior now; it compiles.
        name: A new name of the project.
        encoding: The encoding of XABSL files that are not UTF-8.

    Raises:
        OSError: A file cannot be read or written, or has errors; or the recorded behavior does not compile.
    """
    opened = open_project(folder)
    known = opened.project
    versions = []
    for version, title, chosen in (
        (record.source(), known.name, known.xabsl_encoding),
        (source, name or known.name, encoding),
    ):
        compiled = compile_source(version)
        if compiled.program is None:
            raise OSError(f"the record of the import of {folder} does not compile; import again with --force")
        imported = import_behavior(version, compiled, title)
        versions.append(replace(imported, project=replace(imported.project, xabsl_encoding=chosen)))
    before, after = (design_paths(version) for version in versions)
    files = {component: os.path.relpath(file, folder) for component, file in opened.files.items()}
    moved = {
        path: Path(files[component]).as_posix()
        for component, path in after.items()
        if before.get(component) == path and component in files
    }
    merge = merge_import(folder, format_files(versions[0]), format_files(versions[1]), moved)
    # A design that the user moved since the last update keeps the path that it had then.
    kept = {name: path for name, path in record.designs.items() if name in after and before.get(name) == after[name]}
    entry = format_record(folder, source, {**after, **kept}, has_comments=record.has_comments)
    replace_files(folder, {**merge.texts, RECORD_FILE: entry})
    return merge


def merge_import(
    folder: Path, base: Mapping[str, str], theirs: Mapping[str, str], moved: Mapping[str, str]
) -> ImportMerge:
    """Merge the changes of a behavior into the files of a project.

    Args:
        folder: The folder of the project.
        base: The files that an import of the old behavior writes.
        theirs: The files that an import of the new behavior writes.
        moved: The paths of designs in the project that an import writes elsewhere, by that path.

    Raises:
        OSError: A file cannot be read, or has errors.
    """
    merge = ImportMerge()
    for path in {**base, **theirs}:
        place = moved.get(path, path)
        old, new, ours = base.get(path), theirs.get(path), _read(folder / place)
        if new in (old, ours):
            continue
        if new is None:
            _remove(merge, place, old or "", ours or "")
        elif ours is None:
            if old is None:
                merge.texts[place] = new
            else:
                merge.conflicts.append(f"{place}: deleted here, changed in the behavior")
        else:
            _merge_file(merge, place, (old or "", ours, new), folder)
    return merge


def _merge_file(merge: ImportMerge, path: str, texts: tuple[str, str, str], folder: Path) -> None:
    is_project_file = path == _PROJECT_FILE
    merged = merge_file_texts(*texts, is_project_file=is_project_file)
    if merged is None:
        raise OSError(f"{folder / path} has errors, so it cannot be merged; correct them ('vicode check')")
    text = merge_comments(texts[0], merged.text, texts[2], is_project_file=is_project_file)
    if text != texts[1]:
        merge.texts[path] = text
    merge.conflicts += [f"{path}: conflict in {name}" for name in merged.conflicts]


def _remove(merge: ImportMerge, path: str, base: str, ours: str) -> None:
    """Delete a design whose option was removed, unless it was edited."""
    if ours and _content(ours) == _content(base):
        merge.texts[path] = None
    elif ours:
        merge.conflicts.append(f"{path}: changed here, deleted in the behavior")


def _content(text: str) -> Design | None:
    """A design without its layout."""
    design = read_design(text).design
    if design is None:
        return None
    return replace(
        design,
        states=tuple(replace(state, at=None, color="") for state in design.states),
        uses=tuple(replace(use, at=None) for use in design.uses),
        common=replace(design.common, at=None),
    )


def _read(path: Path) -> str | None:
    try:
        return path.read_text("utf-8")
    except FileNotFoundError:
        return None
    except UnicodeDecodeError as error:
        raise OSError(f"{path} is not UTF-8") from error
