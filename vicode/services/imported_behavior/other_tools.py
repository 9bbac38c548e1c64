"""Behaviors of other tools: reads VICODE's XML, `.bica` files of rqt, behaviors of FlexBE and machines of YASMIN."""

import re
from collections.abc import Sequence
from pathlib import Path

from vicode.findings import Finding
from vicode.importers import ImportedDesign, ImportResult
from vicode.importers.bica import BicaReader
from vicode.importers.design_names import design_files
from vicode.importers.outcomes import convert_machines
from vicode.importers.outcomes.flexbe import FlexbeReader, contains_behavior
from vicode.importers.outcomes.yasmin import YasminReader
from vicode.importers.sources import Sources

_ROOT = re.compile(rb"<(component|StateMachine)\b")
_BICA, _YASMIN, _FLEXBE = "component", "StateMachine", "Behavior"


def find_other_files(path: Path) -> tuple[Path, ...]:
    """The files at a path that are of one of the tools, without links that lead out of a folder.

    Raises:
        OSError: A file cannot be read.
    """
    inside = Sources(folder=path).contains
    found = [path] if path.is_file() else sorted(each for each in path.rglob("*") if inside(each) and each.is_file())
    return tuple(each for each in found if _tool(each))


def load_other(files: Sequence[Path], folder: Path, name: str) -> tuple[ImportResult, tuple[Finding, ...]]:
    """Import files; those that they name are searched in `folder`. The findings are files that cannot be read.

    Raises:
        OSError: A file cannot be read, or they are of tools that do not fit together.
    """
    sources = Sources(folder=folder)
    bica, yasmin, flexbe = BicaReader(sources), YasminReader(sources), FlexbeReader(sources)
    readers = {_BICA: bica.read, _YASMIN: yasmin.read, _FLEXBE: flexbe.read}
    for file in files:
        sources.load(file, readers[_tool(file)])
    machines = yasmin.machines | flexbe.machines
    if machines and bica.designs:
        raise OSError(f"{folder} contains files of several tools; import one of them")
    project = bica.project(name) if bica.designs else convert_machines(machines, name, sources)
    paths = [path for _design, path in bica.designs] or [each.place[0] for each in machines.values()]
    names = design_files(each.component for each in project.designs)
    designs = (
        ImportedDesign(component=each.component, path=path, comments=(), file=file, anchors=())
        for each, file, path in zip(project.designs, paths, names, strict=True)
    )
    notes = sorted(dict.fromkeys(sources.notes), key=lambda note: (str(note.file), note.line, note.text))
    result = ImportResult(project=project, designs=tuple(designs), comments=(), notes=tuple(notes))
    return result, tuple(sources.errors)


def _tool(file: Path) -> str:
    if file.suffix == ".bica":
        return _BICA
    if file.suffix == ".py":
        return _FLEXBE if contains_behavior(file.read_bytes().decode("utf-8", errors="replace")) else ""
    found = _ROOT.search(file.read_bytes()) if file.suffix == ".xml" else None
    return found[1].decode() if found else ""
