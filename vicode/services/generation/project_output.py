"""The generated files of a project: what is generated, where, what is outdated, and saving the designs that change."""

import os
from collections.abc import Collection, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from vicode.findings import Finding, SourceLocation, get_rule
from vicode.generators import GENERATORS, generate, list_outputs
from vicode.model.project import Project
from vicode.output import FileDiff, FileStatus, OutputFile, back_up_edited
from vicode.services.project_loader import LoadedProject
from vicode.store import replace_text, save_design
from vicode.sync import Choices, GeneratedHistory, GenerationInput, GenerationPlan


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputOptions:
    """What is generated, and where.

    Attributes:
        out: The folder; None for that of the project.
        languages: The languages; None for those of the project.
        standalone: Include a copy of the runtime.
    """

    out: str | None = None
    languages: Collection[str] | None = None
    standalone: bool = False


def generation_input(opened: LoadedProject, options: OutputOptions) -> GenerationInput:
    """What the options ask to generate."""
    folder = output_folder(opened, options.out)
    project = opened.open_project.project
    return GenerationInput(
        project=project,
        folder=folder,
        generate=lambda changed: generate_files(opened, changed, options),
        kept_paths=list_outputs(project, languages=options.languages, standalone=options.standalone),
        # The component name of an unreadable design is unknown, so no file is certainly stale.
        may_delete=not opened.open_project.broken_files,
        history=GeneratedHistory(folder=folder, project_folder=opened.open_project.folder),
    )


def output_folder(opened: LoadedProject, out: str | None = None) -> Path:
    folder = Path(out) if out else opened.open_project.folder / opened.open_project.project.generated
    # Shorten paths such as `designs/forward/../../generated`.
    return Path(os.path.relpath(folder)) if not folder.is_absolute() else folder


def generate_files(opened: LoadedProject, project: Project, options: OutputOptions) -> list[OutputFile]:
    """The files of all designs without errors, for each language."""
    files: list[OutputFile] = []
    for language in GENERATORS:
        faulty = opened.components_with_errors(language)
        wanted = [name for name in opened.selected_designs if name not in faulty]
        if wanted and language in (options.languages or project.languages):
            files += generate(
                project,
                components=wanted,
                exclude=faulty,
                languages=(language,),
                standalone=options.standalone,
                sources=opened.open_project.design_paths,
            )
    return files


def back_up_designs(opened: LoadedProject, plan: GenerationPlan) -> Iterator[Path]:
    """Copy the designs of which a conflict drops text to NAME.edited."""
    dropped = {each.path for each in plan.settled if each.side == "file"}
    for component in dict.fromkeys(file.component for file in plan.files if file.path in dropped):
        yield back_up_edited(opened.open_project.files[component])


@contextmanager
def saved_designs(opened: LoadedProject, plan: GenerationPlan) -> Iterator[None]:
    """Save the designs of a plan; restore them on an exception."""
    project = opened.open_project
    texts = {name: save_design(design, project.texts[name]) for name, design in plan.designs.items()}
    with ExitStack() as undo:
        for name, text in texts.items():
            replace_text(project.files[name], project.texts[name], text)
            undo.callback(replace_text, project.files[name], text, project.texts[name])
        yield
        undo.pop_all()


def require_known_items(plan: GenerationPlan, choices: Choices) -> None:
    """Require that each chosen item is a conflict.

    Raises:
        OSError: There is no such conflict.
    """
    unused = choices.list_unused(name for each in plan.settled for name in each.names)
    if unused:
        raise OSError(f"--take: no conflict '{unused[0]}'; 'vicode sync' lists the conflicts")


def list_outdated(plan: GenerationPlan) -> Iterator[Finding]:
    """Findings for outdated files; edited files yield their edits, because generating refuses them."""
    edited = {file.path for file in plan.edits}
    yield from plan.findings
    for difference in plan.differences:
        if difference.path not in edited:
            yield _outdated_finding(difference, plan.folder)


def _outdated_finding(difference: FileDiff, folder: Path) -> Finding:
    problem = {
        FileStatus.NEW: "missing: no such file",
        FileStatus.CHANGED: "changed: differs from the generated code",
        FileStatus.STALE: "stale: no design generates this file",
    }[difference.status]
    place = SourceLocation(file=(folder / difference.path).as_posix(), line=1, column=1)
    return Finding(rule=get_rule("G502"), message=problem, fix="run 'vicode gen'", location=place)
