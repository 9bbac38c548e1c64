"""Plans what generation writes, with the edits of generated files applied to the designs, and writes it."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from vicode.check import check_project
from vicode.findings import Finding, Severity, SourceLocation
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.output import FileDiff, FileStatus, OutputFile, back_up_edited, compare_files, require_unchanged
from vicode.regions import has_header
from vicode.sync.applied_edits import APPLIED_FILE, RecordedEdit, RegionKey, format_applied, read_applied, without_paths
from vicode.sync.apply_regions import AppliedEdit, Side, apply_regions
from vicode.sync.file_edits import FileEdits, find_file_edits
from vicode.sync.findings import describe_conflict, describe_edits
from vicode.sync.history import GeneratedHistory
from vicode.sync.outside_readings import OutsideReading, interpret_files
from vicode.transactions import STATE_FOLDER, complete_interrupted, replace_files


@dataclass(frozen=True, slots=True, kw_only=True)
class GenerationInput:
    """A project and where its code is generated.

    Attributes:
        project: The project.
        folder: The folder of generated files.
        generate: Generates the selected files of a project.
        kept_paths: Paths of further generated files, which are not stale.
        may_delete: Whether files that no design generates are stale; they are not if a design cannot be read.
        history: Finds texts that were generated before.
        applied: Edits that unsaved designs contain (None: no longer), in addition to those recorded in the folder.
    """

    project: Project
    folder: Path
    generate: Callable[[Project], Sequence[OutputFile]]
    kept_paths: Sequence[str] = ()
    may_delete: bool = True
    history: GeneratedHistory
    applied: Mapping[RegionKey, RecordedEdit | None] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class GenerationPlan:
    """The files to write and the designs to save before, and what prevents it.

    Attributes:
        folder: The folder of generated files.
        files: All generated files.
        differences: The files that differ from those on disk.
        designs: The designs that contain edits of generated files, by component.
        applied: These edits.
        outside_readings: The edits outside regions with their meaning in the design.
        edits: The edits that would be lost.
        findings: Why nothing may be written.
    """

    folder: Path
    files: Sequence[OutputFile]
    differences: tuple[FileDiff, ...]
    designs: Mapping[str, Design]
    applied: tuple[AppliedEdit, ...] = ()
    outside_readings: tuple[OutsideReading, ...] = ()
    edits: tuple[FileEdits, ...] = ()
    findings: tuple[Finding, ...] = ()


def plan_generation(
    job: GenerationInput, *, applies_edits: bool = False, take: Side | None = None, outside_regions: bool = False
) -> GenerationPlan:
    """Generate and compare with the folder, without writing.

    Args:
        job: What to generate.
        applies_edits: Apply edits of regions to the designs.
        take: The side that wins conflicts between an edit and the design; None leaves them.
        outside_regions: With `applies_edits`, also apply edits outside regions that have one meaning in the design;
            otherwise they are listed only.

    Raises:
        OSError: A file cannot be read.
    """
    complete_interrupted(job.folder)
    shown = job.folder.as_posix()
    plan = _compare(job, job.project)
    if not applies_edits or not plan.edits:
        return replace(plan, findings=tuple(describe_edits(plan.edits, shown)))
    outcome = apply_regions(job.project, plan.edits, take)
    if outcome.conflicts:
        conflicts = (describe_conflict(file, region, path, shown) for file, region, path in outcome.conflicts)
        return replace(plan, findings=tuple(conflicts))
    project = _with_designs(job.project, outcome.designs)
    errors = tuple(find_new_errors(job.project, project, outcome.applied, shown))
    if errors:
        return replace(plan, findings=errors)
    settled = {(file.path, region.id) for file in plan.edits for region in file.regions}
    new = _compare(job, project)
    edits = tuple(_without(file, settled) for file in new.edits)
    new = replace(
        new,
        designs=outcome.designs,
        applied=outcome.applied,
        edits=tuple(file for file in edits if not file.is_empty),
    )
    new = _interpret_outside_regions(job, project, new, is_applied=outside_regions)
    return replace(new, findings=tuple(describe_edits(new.edits, shown)))


def _interpret_outside_regions(
    job: GenerationInput, project: Project, plan: GenerationPlan, *, is_applied: bool
) -> GenerationPlan:
    """Add the meaning of edits outside regions, and apply them on request."""
    texts = {file.path: file.text for file in plan.files}
    changed, readings = interpret_files(project, plan.edits, texts, job.history)
    plan = replace(plan, outside_readings=readings)
    if not is_applied:
        return plan
    new = _compare(job, _with_designs(project, changed))
    done = {each.file.path for each in readings if each.edits or each.leftover}
    edits = (replace(file, is_edited_outside=file.is_edited_outside and file.path not in done) for file in plan.edits)
    return replace(
        plan,
        files=new.files,
        differences=new.differences,
        designs={**plan.designs, **changed},
        edits=tuple(file for file in edits if not file.is_empty),
    )


def write_generated(plan: GenerationPlan) -> None:
    """Write and delete the files of a plan, all of them or none, and keep a copy of what was generated.

    Raises:
        OSError: A file cannot be written, or has changed since the plan was made.
    """
    texts = {difference.path: difference.new for difference in plan.differences}
    copies = {f"{STATE_FOLDER}/generated/{path}.base": text for path, text in texts.items()}
    for file in plan.files:
        copies.setdefault(f"{STATE_FOLDER}/generated/{file.path}.base", file.text)
    if applied := read_applied(plan.folder):
        copies[APPLIED_FILE] = format_applied(without_paths(applied, (file.path for file in plan.files)))
    for each in plan.outside_readings:
        if each.leftover and each.file.path not in {file.path for file in plan.edits}:
            copies[f"{each.file.path}.patch"] = each.leftover
    outdated = {path: text for path, text in copies.items() if _read(plan.folder / path) != text}
    if texts or outdated:
        replace_files(plan.folder, texts | outdated, validate=lambda: require_unchanged(plan.differences, plan.folder))


def back_up(plan: GenerationPlan) -> tuple[Path, ...]:
    """Copy the edited files of a plan to NAME.edited."""
    return tuple(back_up_edited(plan.folder / file.path) for file in plan.edits)


def _compare(job: GenerationInput, project: Project) -> GenerationPlan:
    files = job.generate(project)
    compared = compare_files(files, job.folder, kept_paths=job.kept_paths, is_generated=has_header)
    ignored = {FileStatus.UNCHANGED} if job.may_delete else {FileStatus.UNCHANGED, FileStatus.STALE}
    differences = tuple(difference for difference in compared if difference.status not in ignored)
    applied = {**read_applied(job.folder), **job.applied}
    edits = find_file_edits(differences, files, job.history, applied=applied, display_folder=job.folder.as_posix())
    return GenerationPlan(folder=job.folder, files=files, differences=differences, designs={}, edits=edits)


def _with_designs(project: Project, designs: Mapping[str, Design]) -> Project:
    return replace(project, designs=tuple(designs.get(design.component, design) for design in project.designs))


def _without(file: FileEdits, settled: set[tuple[str, str]]) -> FileEdits:
    return replace(file, regions=tuple(each for each in file.regions if (file.path, each.id) not in settled))


def find_new_errors(before: Project, after: Project, applied: Iterable[AppliedEdit], folder: str) -> Iterable[Finding]:
    """The errors that edits bring into designs, located in the generated files."""
    edits = tuple(applied)
    components = {edit.file.component for edit in edits}
    known = {(finding.rule.code, finding.message) for finding in check_project(before, components)}
    for finding in check_project(after, components):
        is_new = finding.severity is Severity.ERROR and (finding.rule.code, finding.message) not in known
        if is_new:
            yield _located(finding, edits, folder)


def _located(finding: Finding, edits: Iterable[AppliedEdit], folder: str) -> Finding:
    subject = finding.subject
    for edit in edits:
        if subject and subject.component == edit.file.component and subject.path[: len(edit.path)] == edit.path:
            text = edit.region.merged or edit.region.file_text
            start, end = subject.span or (0, 0)
            row = text.count("\n", 0, start)
            column = start - (text.rfind("\n", 0, start) + 1)
            location = SourceLocation(
                file=f"{folder}/{edit.file.path}" if folder else edit.file.path,
                line=edit.region.line + 1 + row,
                column=len(edit.region.indent) + column + 1,
                length=max(1, min(end, len(text.split("\n")[row]) + start - column) - start),
            )
            return replace(finding, location=location)
    return finding


def _read(path: Path) -> str | None:
    try:
        return path.read_text("utf-8", errors="backslashreplace")
    except OSError:
        return None
