"""The Generate command: checks and generates, shows the differences, protects hand edits, and writes the files."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from vicode.check import find_errors
from vicode.findings import Finding, Severity
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.output import FileDiff
from vicode.services import messages
from vicode.sync import (
    FileEdits,
    GeneratedHistory,
    GenerationInput,
    GenerationPlan,
    OutsideConflict,
    RebasedFile,
    RecordedEdit,
    RegionKey,
    back_up,
    describe_edits,
    plan_generation,
    rebase_outside_edits,
    write_generated,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class GenerationResult:
    """The message for the user, and the files that were written."""

    message: str
    is_complete: bool
    files: tuple[Path, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class GenerationRequest:
    """A project with its source files and parse findings, both by component.

    `applied` are the edits of generated files that designs contain already.
    """

    project: Project
    source_paths: Mapping[str, str]
    parse_findings: Mapping[str, tuple[Finding, ...]]
    applied: Mapping[RegionKey, RecordedEdit | None]
    project_folder: Path


@dataclass(frozen=True, slots=True, kw_only=True)
class FileReading:
    """The edits outside regions of a file, read back as edits of its design.

    Attributes:
        project: The project with the design that the file was compared with.
        rebased: The text generated now with the edits, and lines that the design changed as well.
        design: The design with the edits.
        words: The edits in words.
        leftover: What was not understood, as a patch.
    """

    file: FileEdits
    project: Project
    rebased: RebasedFile
    design: Design
    words: tuple[str, ...]
    leftover: str

    @property
    def base(self) -> Design:
        design = self.project.design(self.file.component)
        assert design is not None
        return design


@dataclass(frozen=True, slots=True, kw_only=True)
class PendingOutput:
    """The files that Generate would write to a folder.

    `error` is why nothing can be generated; `skipped` why some languages are left out; `manual_edits` are the edits in
    the files on disk, by path, and `readings` those outside regions as edits of designs.
    """

    folder: Path
    error: str = ""
    skipped: str = ""
    plan: GenerationPlan | None = None
    readings: tuple["FileReading", ...] = ()

    @property
    def changes(self) -> tuple[FileDiff, ...]:
        """The files that differ from those on disk."""
        return self.plan.differences if self.plan else ()

    @property
    def unchanged(self) -> int:
        """The number of files that are up to date."""
        changed = {diff.path for diff in self.changes}
        return sum(file.path not in changed for file in self.plan.files) if self.plan else 0

    @property
    def manual_edits(self) -> Mapping[str, tuple[Finding, ...]]:
        edits = self.plan.edits if self.plan else ()
        return {file.path: tuple(describe_edits([file])) for file in edits}


def prepare_output(folder: Path, job: GenerationRequest, component: str) -> PendingOutput:
    """Generate a component and all it uses without writing.

    Raises:
        OSError: A file cannot be read.
    """
    from vicode.generators import GENERATORS, collect_components, generate, list_outputs  # noqa: PLC0415 - later

    project = job.project
    wanted = collect_components(project, (component,))
    parse_findings = [finding for name in ("", *wanted) for finding in job.parse_findings.get(name, ())]
    errors = [*(each for each in parse_findings if each.severity is Severity.ERROR), *find_errors(project, wanted)]
    languages = [language for language in GENERATORS if language in project.languages]
    sound = [language for language in languages if not any(error.applies_to(language) for error in errors)]
    reason = _reason(errors, component) if errors else ""
    if errors and not sound:
        return PendingOutput(folder=folder, error=messages.nothing_generated(reason))
    history = GeneratedHistory(folder=folder, project_folder=job.project_folder)
    plan = plan_generation(
        GenerationInput(
            project=project,
            folder=folder,
            generate=lambda project: generate(
                project, components=(component,), languages=sound, sources=job.source_paths
            ),
            kept_paths=list_outputs(project),
            history=history,
            applied=job.applied,
        )
    )
    skipped = [language for language in languages if language not in sound]
    reason = messages.nothing_generated(reason, skipped) if skipped else ""
    readings = (_read_edits(project, file, next(iter(history(file.path)), None)) for file in plan.edits)
    return PendingOutput(folder=folder, skipped=reason, plan=plan, readings=tuple(filter(None, readings)))


def _read_edits(project: Project, file: FileEdits, generated: str | None) -> FileReading | None:
    """Read the edits of a file since it was generated; None if there are none that a design might express."""
    from vicode.sync.interpret import INTERPRETERS  # noqa: PLC0415 - later

    is_readable = file.is_edited_outside and file.language in INTERPRETERS and project.design(file.component)
    rebased = rebase_outside_edits(file, generated) if is_readable else None
    return None if rebased is None else _interpret(project, file, rebased, lambda conflict: conflict.design_text)


def choose_texts(reading: FileReading, texts: Mapping[OutsideConflict, str]) -> FileReading:
    """Read a file again, with texts for its conflicts."""
    return _interpret(reading.project, reading.file, reading.rebased, texts.__getitem__)


def _interpret(
    project: Project, file: FileEdits, rebased: RebasedFile, choose: Callable[[OutsideConflict], str]
) -> FileReading:
    from vicode.sync.interpret import INTERPRETERS  # noqa: PLC0415 - later

    edited = rebased.resolve(choose)
    generated = file.new or ""
    read = INTERPRETERS[file.language](project, file.component, generated=generated, edited=edited, file=file.path)
    words = tuple(edit.words for edit in read.edits)
    return FileReading(
        file=file, project=project, rebased=rebased, design=read.design, words=words, leftover=read.leftover
    )


def _reason(errors: Sequence[Finding], component: str) -> str:
    first = errors[0]
    where = f"{first.subject.component}: " if first.subject and first.subject.component != component else ""
    more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
    return f"{where}{first.message}{more}"


def write_output(prepared: PendingOutput, *, is_forced: bool = False) -> GenerationResult:
    """Write all files, or none if hand edits would be lost; with `is_forced` edited files are backed up first.

    Raises:
        OSError: A file cannot be written.
    """
    if prepared.error or prepared.plan is None:
        return GenerationResult(message=prepared.error, is_complete=False)
    if prepared.manual_edits and not is_forced:
        first = next(iter(prepared.manual_edits.values()))[0]
        message = messages.nothing_generated(f"{first.message}: {first.fix}")
        return GenerationResult(message=message, is_complete=False)
    back_up(prepared.plan)
    write_generated(prepared.plan)
    files = tuple(prepared.folder / change.path for change in prepared.changes)
    message = f"Generated code in {prepared.folder.name} is up to date"
    if files:
        message = messages.generated([path.name for path in files], files[0].parent)
    if prepared.skipped:
        message = f"{message}. {prepared.skipped}"
    return GenerationResult(message=message, is_complete=not prepared.skipped, files=files)
