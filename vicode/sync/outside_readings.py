"""Reads edits outside regions back as edits of designs."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from vicode.model.design import Design
from vicode.model.project import Project
from vicode.sync.file_edits import FileEdits, History
from vicode.sync.interpret import INTERPRETERS, InterpretedEdit
from vicode.sync.outside_edits import rebase_outside_edits


@dataclass(frozen=True, slots=True, kw_only=True)
class OutsideReading:
    """The edits outside regions of one file; `leftover` is a patch of what the design cannot express."""

    file: FileEdits
    edits: tuple[InterpretedEdit, ...]
    leftover: str


def interpret_files(
    project: Project, files: Iterable[FileEdits], texts: Mapping[str, str], history: History
) -> tuple[dict[str, Design], tuple[OutsideReading, ...]]:
    """Interpret all files with edits outside regions.

    Args:
        project: The project.
        files: The edited files.
        texts: The texts generated from the project, by path.
        history: Returns earlier generated texts.

    Returns:
        The changed designs by component, and the edits.
    """
    designs: dict[str, Design] = {}
    found: list[OutsideReading] = []
    for file in files:
        generated = texts.get(file.path)
        if not file.is_edited_outside or generated is None:
            continue
        edited = rebase_outside_edits(replace(file, new=generated), next(iter(history(file.path)), None))
        if edited is None or not (file.component and file.language in INTERPRETERS):
            found.append(OutsideReading(file=file, edits=(), leftover=""))
            continue
        interpret = INTERPRETERS[file.language]
        result = interpret(project, file.component, generated=generated, edited=edited, file=file.path)
        found.append(OutsideReading(file=file, edits=result.edits, leftover=result.leftover))
        if result.edits:
            designs[file.component] = result.design
            project = replace(
                project,
                designs=tuple(
                    result.design if design.component == file.component else design for design in project.designs
                ),
            )
    return designs, tuple(found)
