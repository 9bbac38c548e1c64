"""What the button Generate does: checks, generates, shows what would change, guards what was edited by hand, writes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from vicode.check import check_project
from vicode.findings import Finding, Severity
from vicode.model.project import Project
from vicode.output import FileDiff, FileStatus, apply_diffs, back_up_edited, compare_files
from vicode.regions import has_header
from vicode.sync import find_hand_edits_by_file


@dataclass(frozen=True, slots=True, kw_only=True)
class GenerationResult:
    """What came of it, in words; `files` were written."""

    message: str
    is_complete: bool
    files: tuple[Path, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class GenerationInput:
    """What to generate from: a project, its files by component, and what was wrong with them when they were read."""

    project: Project
    source_paths: Mapping[str, str]
    parse_findings: Mapping[str, tuple[Finding, ...]]


@dataclass(frozen=True, slots=True, kw_only=True)
class PendingOutput:
    """What would be written into a folder; `error` says why nothing would, `manual_edits` what a person edited there.

    `skipped` says why a language is left out where others are not.
    """

    folder: Path
    error: str = ""
    skipped: str = ""
    differences: tuple[FileDiff, ...] = ()
    manual_edits: Mapping[str, tuple[Finding, ...]]

    @property
    def changes(self) -> tuple[FileDiff, ...]:
        """The files that are not yet as they should be."""
        return tuple(each for each in self.differences if each.status is not FileStatus.UNCHANGED)


def prepare_output(folder: Path, job: GenerationInput, component: str) -> PendingOutput:
    """Find out what generating a component, and all it uses, would write into a folder; nothing is written.

    Raises:
        OSError: A file cannot be read.
    """
    from vicode.generators import GENERATORS, collect_components, generate, list_outputs  # noqa: PLC0415 - later

    project = job.project
    wanted = collect_components(project, (component,))
    read = [finding for name in ("", *wanted) for finding in job.parse_findings.get(name, ())]
    errors = [each for each in (*read, *check_project(project, wanted)) if each.severity is Severity.ERROR]
    languages = [each for each in GENERATORS if each in project.languages]
    sound = [each for each in languages if not any(error.applies_to(each) for error in errors)]
    reason = _reason(errors, component) if errors else ""
    if errors and not sound:
        return PendingOutput(folder=folder, error=f"Nothing generated. {reason}", manual_edits={})
    files = generate(project, components=(component,), languages=sound, sources=job.source_paths)
    differences = compare_files(files, folder, kept_paths=list_outputs(project), is_generated=has_header)
    left_out = [each for each in languages if each not in sound]
    spared = f"Nothing generated for {' and '.join(left_out)}. {reason}" if left_out else ""
    return PendingOutput(
        folder=folder, skipped=spared, differences=differences, manual_edits=find_hand_edits_by_file(differences)
    )


def _reason(errors: Sequence[Finding], component: str) -> str:
    first = errors[0]
    where = f"{first.subject.component}: " if first.subject and first.subject.component != component else ""
    more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
    return f"{where}{first.message}{more}"


def write_output(prepared: PendingOutput, *, is_forced: bool = False) -> GenerationResult:
    """Write all of it, or nothing if a person's edits would be lost; with force those are set aside first.

    Raises:
        OSError: A file cannot be written.
    """
    if prepared.error:
        return GenerationResult(message=prepared.error, is_complete=False)
    if prepared.manual_edits and not is_forced:
        first = next(iter(prepared.manual_edits.values()))[0]
        return GenerationResult(message=f"Nothing generated. {first.message}: {first.fix}", is_complete=False)
    for path in prepared.manual_edits:
        back_up_edited(prepared.folder / path)
    touched = apply_diffs(prepared.differences, prepared.folder)
    words = f"Generated code in {prepared.folder.name} is up to date"
    if touched:
        names = ", ".join(path.name for path in touched[:4]) + (", …" if len(touched) > 4 else "")
        words = f"Generated {names} in {touched[0].parent}"
    words = f"{words}. {prepared.skipped}" if prepared.skipped else words
    return GenerationResult(message=words, is_complete=not prepared.skipped, files=touched)
