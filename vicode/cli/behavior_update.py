"""Writes the edits of imported designs back to the XABSL files of the behavior."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath

from vicode.generators import generate
from vicode.importers import import_behavior
from vicode.model.project import Project
from vicode.model.xabsl.names import component_name, unqualified_name
from vicode.xabsl.compiler import CompileResult, compile_source
from vicode.xabsl.patching.differences import find_differences
from vicode.xabsl.patching.program_patch import FileTexts, ProgramVersion, patch_program
from vicode.xabsl.patching.source_edits import PatchError
from vicode.xabsl.source_loader import ProgramSource, ReadText, load_source

_FOLDER = Path("/generated")


@dataclass(frozen=True, slots=True, kw_only=True)
class UpdateProblem:
    """An edit that cannot be written back; `component` and `state` are names in designs, empty if none is concerned."""

    message: str
    component: str = ""
    state: str = ""


def update_behavior(
    source: ProgramSource, project: Project, folders: Mapping[str, str], read: ReadText
) -> tuple[FileTexts, tuple[UpdateProblem, ...]]:
    """Write the edits of a project to the files of the behavior that it was imported from.

    Args:
        source: The files of the behavior; they compile.
        project: The project, without errors that prevent generating XABSL.
        folders: The folder of each design, relative to the project.
        read: Reads other files of the behavior.

    Returns:
        The changed, added and removed files (None), and the problems; with problems there are no files.
    """
    original = ProgramVersion(source, compile_source(source))
    after = generated_version(project, folders)
    before = generated_version(_imported(original, project.name), {})
    if not any(find_differences(before.source, after.source)) and before.state_orders == after.state_orders:
        return {}, ()
    try:
        texts = patch_program(original, before, after)
    except PatchError as error:
        return {}, (UpdateProblem(message=str(error)),)
    problems = tuple(_verify(source, texts, project, after, read))
    return ({}, problems) if problems else (texts, ())


def generated_version(project: Project, folders: Mapping[str, str]) -> ProgramVersion:
    """Generate the XABSL program of a project."""
    files = generate(replace(project, languages=("xabsl",)))
    root = next(PurePosixPath(file.path).parent for file in files if file.path.endswith("/agents.xabsl"))
    texts = {_FOLDER / PurePosixPath(file.path).relative_to(root): file.text for file in files}
    source = load_source(_FOLDER / "agents.xabsl", texts.__getitem__)
    return ProgramVersion(
        source,
        compile_source(source),
        {component_name(design): [unqualified_name(state) for state in design.states] for design in project.designs},
        {component_name(design): folders.get(design.component, "") for design in project.designs},
    )


def _imported(version: ProgramVersion, name: str) -> Project:
    return import_behavior(version.source, version.compiled, name).project


def _verify(
    source: ProgramSource, texts: FileTexts, project: Project, after: ProgramVersion, read: ReadText
) -> Iterator[UpdateProblem]:
    """Compile and import the new files, and compare the result with the designs."""

    def read_new(path: Path) -> str:
        text = texts[path] if path in texts else read(path)
        if text is None:
            raise FileNotFoundError(2, "removed", str(path))
        return text

    new = load_source(source.main, read_new)
    compiled = compile_source(new)
    if compiled.program is None:
        yield from _compile_problems(compiled)
        return
    again = generated_version(_imported(ProgramVersion(new, compiled), project.name), {})
    components = {component_name(design): design for design in project.designs}
    for option, state in find_differences(after.source, again.source):
        design = components.get(option)
        states = {unqualified_name(each): each.name for each in design.states} if design else {}
        where = f"state {state} of option {option}" if state else option or "the agents"
        yield UpdateProblem(
            message=f"{where} cannot be written so that an import gives the same design",
            component=design.component if design else "",
            state=states.get(state, ""),
        )


def _compile_problems(compiled: CompileResult) -> Iterator[UpdateProblem]:
    errors = [finding for finding in compiled.findings if finding.severity == "error"]
    for finding in errors:
        where = f"{finding.location.file}:{finding.location.line}: " if finding.location else ""
        yield UpdateProblem(message=f"the new files would not compile: {where}{finding.message}")
