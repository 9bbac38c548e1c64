"""Plans what generation writes, with the edits of generated files applied to the designs, and writes it."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field, replace
from pathlib import Path

from vicode.check import find_errors
from vicode.findings import Finding, SourceLocation
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.output import FileDiff, FileStatus, OutputFile, back_up_edited, compare_files, require_unchanged
from vicode.regions import has_header
from vicode.sync.applied_edits import APPLIED_FILE, RecordedEdit, RegionKey, format_applied, read_applied, still_applied
from vicode.sync.apply_regions import AppliedEdit, AppliedEdits, apply_regions
from vicode.sync.choices import NO_CHOICES, Choices, SettledConflict
from vicode.sync.file_edits import FileEdits, find_file_edits
from vicode.sync.findings import describe_conflict, describe_edits, describe_outside_conflict
from vicode.sync.history import GeneratedHistory
from vicode.sync.outside_readings import OutsideReader, OutsideReading
from vicode.sync.patches import format_patch, name_patches, patch_root
from vicode.sync.region_merge import record_edit
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
        applied: The edits of regions in them; with findings, those that could be applied.
        outside_readings: The edits outside regions with their meaning in the design.
        settled: The conflicts for which a side was chosen.
        edits: The edits that would be lost.
        patches: What no design can express of the edits that are overwritten, by the path of the new file.
        findings: Why nothing may be written.
    """

    folder: Path
    files: Sequence[OutputFile]
    differences: tuple[FileDiff, ...]
    designs: Mapping[str, Design]
    applied: tuple[AppliedEdit, ...] = ()
    outside_readings: tuple[OutsideReading, ...] = ()
    settled: tuple[SettledConflict, ...] = ()
    edits: tuple[FileEdits, ...] = ()
    patches: Mapping[str, str] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()


def plan_generation(
    job: GenerationInput,
    *,
    applies_edits: bool = False,
    choices: Choices = NO_CHOICES,
    outside_regions: bool = False,
) -> GenerationPlan:
    """Generate and compare with the folder, without writing.

    Args:
        job: What to generate.
        applies_edits: Apply edits of regions to the designs.
        choices: The sides that win conflicts between an edit and the design; the others are left.
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
    outcome = apply_regions(job.project, plan.edits, choices)
    project = _with_designs(job.project, outcome.designs)
    findings = [describe_conflict(file, region, path, shown) for file, region, path in outcome.conflicts]
    if errors := tuple(find_new_errors(job.project, project, outcome.applied, shown)):
        return replace(plan, findings=(*findings, *errors))
    unchanged = plan
    plan = _with_regions_applied(_compare(job, project) if outcome.designs else plan, plan.edits, outcome)
    plan = _with_outside_readings(job, project, plan, choices, is_applied=outside_regions)
    findings += [
        describe_outside_conflict(each.file, conflict, shown)
        for each in plan.outside_readings
        for conflict in each.conflicts
    ]
    has_conflicts = bool(findings)
    in_conflict = {each.file.path for each in plan.outside_readings if each.conflicts}
    others = (
        replace(file, regions=(), is_edited_outside=file.is_edited_outside and file.path not in in_conflict)
        for file in plan.edits
    )
    findings += describe_edits(others, shown)
    plan = replace(plan, findings=tuple(findings))
    if not has_conflicts:
        return plan
    return replace(
        plan, files=unchanged.files, differences=unchanged.differences, designs={}, edits=unchanged.edits, patches={}
    )


def _with_regions_applied(plan: GenerationPlan, found: Iterable[FileEdits], outcome: AppliedEdits) -> GenerationPlan:
    """Remove the edits of regions from a plan, except conflicts."""
    conflicts = {(file.path, region.id) for file, region, _path in outcome.conflicts}
    done = {(file.path, region.id) for file in found for region in file.regions} - conflicts
    edits = (
        replace(file, regions=tuple(each for each in file.regions if (file.path, each.id) not in done))
        for file in plan.edits
    )
    return replace(
        plan,
        designs=outcome.designs,
        applied=outcome.applied,
        settled=outcome.settled,
        edits=tuple(file for file in edits if not file.is_empty),
    )


def _with_outside_readings(
    job: GenerationInput, project: Project, plan: GenerationPlan, choices: Choices, *, is_applied: bool
) -> GenerationPlan:
    """Add the meaning of edits outside regions, and apply them on request."""
    root = patch_root(job.folder, job.history.project_folder)
    reader = OutsideReader(
        texts={file.path: file.text for file in plan.files},
        history=job.history,
        choices=choices,
        prefix=job.folder.resolve().relative_to(root.resolve()).as_posix(),
    )
    changed, readings = reader.read_all(project, plan.edits)
    plan = replace(
        plan,
        outside_readings=readings,
        settled=(*plan.settled, *(each for reading in readings for each in reading.settled)),
    )
    files, differences = plan.files, plan.differences
    if is_applied and changed:
        files, differences = _generate(job, _with_designs(project, changed))
    done = {
        each.file.path for each in readings if each.is_empty or (is_applied and each.is_read and not each.conflicts)
    }
    edits = (replace(file, is_edited_outside=file.is_edited_outside and file.path not in done) for file in plan.edits)
    patches = {
        each.file.path: format_patch(each.leftover, each.file.path, each.file.component)
        for each in readings
        if each.leftover and each.file.path in done
    }
    return replace(
        plan,
        files=files,
        differences=differences,
        designs={**plan.designs, **(changed if is_applied else {})},
        patches=name_patches(job.folder, patches),
        edits=tuple(file for file in edits if not file.is_empty),
    )


def write_generated(
    plan: GenerationPlan, save_designs: Callable[[], AbstractContextManager[object]] = nullcontext
) -> None:
    """Write and delete the files of a plan, all of them or none, and keep a copy of what was generated.

    Args:
        plan: The plan.
        save_designs: Returns a context that saves the designs of the plan when it is entered, and restores them if the
            files are not written. It is entered when the files are ready to be moved.

    Raises:
        OSError: A file cannot be written, or has changed since the plan was made.
    """
    texts = {difference.path: difference.new for difference in plan.differences}
    copies = {f"{STATE_FOLDER}/generated/{path}.base": text for path, text in texts.items()}
    for file in plan.files:
        copies.setdefault(f"{STATE_FOLDER}/generated/{file.path}.base", file.text)
    recorded = read_applied(plan.folder)
    new = {(each.file.path, each.region.id): record_edit(each.region) for each in plan.applied}
    applied = still_applied(recorded, new, {file.path: file.text for file in plan.files})
    if applied != recorded:
        copies[APPLIED_FILE] = format_applied(applied)
    copies |= plan.patches
    outdated = {path: text for path, text in copies.items() if _read(plan.folder / path) != text}

    @contextmanager
    def prepare() -> Iterator[None]:
        require_unchanged(plan.differences, plan.folder)
        with save_designs():
            yield

    if texts or outdated:
        replace_files(plan.folder, texts | outdated, prepare=prepare)
    elif plan.designs:
        with save_designs():
            pass


def back_up(plan: GenerationPlan) -> tuple[Path, ...]:
    """Copy the files with edits that a plan drops to NAME.edited."""
    dropped = [*(file.path for file in plan.edits), *(each.path for each in plan.settled if each.side == "design")]
    return tuple(back_up_edited(plan.folder / path) for path in dict.fromkeys(dropped))


def _generate(job: GenerationInput, project: Project) -> tuple[Sequence[OutputFile], tuple[FileDiff, ...]]:
    files = job.generate(project)
    compared = compare_files(files, job.folder, kept_paths=job.kept_paths, is_generated=has_header)
    ignored = {FileStatus.UNCHANGED} if job.may_delete else {FileStatus.UNCHANGED, FileStatus.STALE}
    return files, tuple(difference for difference in compared if difference.status not in ignored)


def _compare(job: GenerationInput, project: Project) -> GenerationPlan:
    files, differences = _generate(job, project)
    applied = {**read_applied(job.folder), **job.applied}
    edits = find_file_edits(differences, files, job.history, applied=applied, display_folder=job.folder.as_posix())
    return GenerationPlan(folder=job.folder, files=files, differences=differences, designs={}, edits=edits)


def _with_designs(project: Project, designs: Mapping[str, Design]) -> Project:
    return replace(project, designs=tuple(designs.get(design.component, design) for design in project.designs))


def find_new_errors(before: Project, after: Project, applied: Iterable[AppliedEdit], folder: str) -> Iterable[Finding]:
    """The errors that edits bring into designs, located in the generated files."""
    edits = tuple(applied)
    components = {edit.file.component for edit in edits}
    known = {(finding.rule.code, finding.message) for finding in find_errors(before, components)}
    for finding in find_errors(after, components):
        if (finding.rule.code, finding.message) not in known:
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
