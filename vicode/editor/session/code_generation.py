"""The Generate command: checks and generates, shows the differences, protects hand edits, and writes the files."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from vicode.check import check_project
from vicode.editor.session import texts
from vicode.findings import Finding, Severity
from vicode.model.project import Project
from vicode.output import FileDiff, FileStatus, apply_diffs, back_up_edited, compare_files
from vicode.regions import has_header
from vicode.sync import find_hand_edits_by_file


@dataclass(frozen=True, slots=True, kw_only=True)
class GenerationResult:
    """The message for the user, and the files that were written."""

    message: str
    is_complete: bool
    files: tuple[Path, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class GenerationInput:
    """A project with its source files and parse findings, both by component."""

    project: Project
    source_paths: Mapping[str, str]
    parse_findings: Mapping[str, tuple[Finding, ...]]


@dataclass(frozen=True, slots=True, kw_only=True)
class PendingOutput:
    """The files that Generate would write to a folder.

    `error` is why nothing can be generated; `skipped` why some languages are left out; `manual_edits` the hand edits in
    the files on disk, by path.
    """

    folder: Path
    error: str = ""
    skipped: str = ""
    differences: tuple[FileDiff, ...] = ()
    manual_edits: Mapping[str, tuple[Finding, ...]]

    @property
    def changes(self) -> tuple[FileDiff, ...]:
        """The files that differ from those on disk."""
        return tuple(diff for diff in self.differences if diff.status is not FileStatus.UNCHANGED)


def prepare_output(folder: Path, job: GenerationInput, component: str) -> PendingOutput:
    """Generate a component and all it uses without writing.

    Raises:
        OSError: A file cannot be read.
    """
    from vicode.generators import GENERATORS, collect_components, generate, list_outputs  # noqa: PLC0415 - later

    project = job.project
    wanted = collect_components(project, (component,))
    parse_findings = [finding for name in ("", *wanted) for finding in job.parse_findings.get(name, ())]
    findings = [*parse_findings, *check_project(project, wanted)]
    errors = [finding for finding in findings if finding.severity is Severity.ERROR]
    languages = [language for language in GENERATORS if language in project.languages]
    sound = [language for language in languages if not any(error.applies_to(language) for error in errors)]
    reason = _reason(errors, component) if errors else ""
    if errors and not sound:
        return PendingOutput(folder=folder, error=texts.nothing_generated(reason), manual_edits={})
    files = generate(project, components=(component,), languages=sound, sources=job.source_paths)
    differences = compare_files(files, folder, kept_paths=list_outputs(project), is_generated=has_header)
    skipped = [language for language in languages if language not in sound]
    return PendingOutput(
        folder=folder,
        skipped=texts.nothing_generated(reason, skipped) if skipped else "",
        differences=differences,
        manual_edits=find_hand_edits_by_file(differences),
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
    if prepared.error:
        return GenerationResult(message=prepared.error, is_complete=False)
    if prepared.manual_edits and not is_forced:
        first = next(iter(prepared.manual_edits.values()))[0]
        message = texts.nothing_generated(f"{first.message}: {first.fix}")
        return GenerationResult(message=message, is_complete=False)
    for path in prepared.manual_edits:
        back_up_edited(prepared.folder / path)
    files = apply_diffs(prepared.differences, prepared.folder)
    message = texts.up_to_date(prepared.folder.name)
    if files:
        message = texts.generated([path.name for path in files], files[0].parent)
    if prepared.skipped:
        message = f"{message}. {prepared.skipped}"
    return GenerationResult(message=message, is_complete=not prepared.skipped, files=files)
