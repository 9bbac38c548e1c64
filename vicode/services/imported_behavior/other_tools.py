"""Behaviors of other tools: reads VICODE's XML, `.bica` files of rqt, behaviors of FlexBE and machines of YASMIN."""

import re
from dataclasses import dataclass
from pathlib import Path

from vicode.findings import Finding
from vicode.importers import ImportedDesign, ImportNote, ImportResult
from vicode.importers.bica import BicaReader
from vicode.importers.outcomes import OutcomeMachine, convert_machines
from vicode.importers.outcomes.flexbe import FlexbeReader, contains_behavior
from vicode.importers.outcomes.yasmin import YasminReader
from vicode.importers.xml_reader import SourceError
from vicode.model.project import Project

_ROOT = re.compile(rb"<(component|StateMachine)\b")


@dataclass(frozen=True, slots=True, kw_only=True)
class OtherImport:
    """The project of files of another tool; `errors` are files that cannot be read."""

    result: ImportResult
    errors: tuple[Finding, ...]


def find_other_files(path: Path) -> tuple[Path, ...]:
    """The files at a path that are of one of the tools.

    Raises:
        OSError: A file cannot be read.
    """
    found = [path] if path.is_file() else sorted(each for each in path.rglob("*") if each.is_file())
    return tuple(each for each in found if _tool(each))


def load_other(files: tuple[Path, ...], folder: Path, name: str) -> OtherImport:
    """Import files; those that they name are searched in `folder`.

    Raises:
        OSError: A file cannot be read.
    """
    if len({_tool(each) == "bica" for each in files}) > 1:
        raise OSError(f"{folder} contains files of several tools; import one of them")
    return _load_bica(files, name) if _tool(files[0]) == "bica" else _load_outcomes(files, folder, name)


def _tool(file: Path) -> str:
    if file.suffix == ".bica":
        return "bica"
    if file.suffix == ".py":
        return "flexbe" if contains_behavior(file.read_bytes().decode("utf-8", errors="replace")) else ""
    found = _ROOT.search(file.read_bytes()) if file.suffix == ".xml" else None
    return {b"component": "bica", b"StateMachine": "yasmin"}[found[1]] if found else ""


def _load_bica(files: tuple[Path, ...], name: str) -> OtherImport:
    reader, errors = BicaReader(), list[Finding]()
    for file in files:
        try:
            reader.read_file(file)
        except SourceError as error:
            errors.append(error.finding(file))
    project = reader.project(name)
    return _import(project, reader.files, reader.notes, [*errors, *reader.errors])


def _load_outcomes(files: tuple[Path, ...], folder: Path, name: str) -> OtherImport:
    def find(named: str, user: Path) -> Path | None:
        beside = user.parent / named
        if beside.is_file():
            return beside
        last = Path(named).name
        return next((each for each in sorted(folder.rglob(last)) if each.is_file()), None) if last else None

    readers: dict[str, FlexbeReader | YasminReader] = {"flexbe": FlexbeReader(find), "yasmin": YasminReader(find)}
    errors = list[Finding]()
    for file in files:
        try:
            readers[_tool(file)].read_file(file)
        except SourceError as error:
            errors.append(error.finding(file))
    machines: dict[str, OutcomeMachine] = {}
    for reader in readers.values():
        machines |= {key: each for key, each in reader.machines.items() if each}
        errors += reader.errors
    project, notes = convert_machines(machines, name)
    more = [note for reader in readers.values() for note in reader.notes]
    return _import(project, [each.place[0] for each in machines.values()], [*notes, *more], errors)


def _import(project: Project, files: list[Path], notes: list[ImportNote], errors: list[Finding]) -> OtherImport:
    designs = (
        ImportedDesign(component=each.component, path=f"{each.component}.yaml", comments=(), file=file, anchors=())
        for each, file in zip(project.designs, files, strict=True)
    )
    order = sorted(dict.fromkeys(notes), key=lambda note: (str(note.file), note.line, note.text))
    result = ImportResult(project=project, designs=tuple(designs), comments=(), notes=tuple(order))
    distinct = {(each.location, each.message): each for each in errors}
    return OtherImport(result=result, errors=tuple(distinct.values()))
