"""What the button Generate does: checks, generates, shows what would change, guards what was edited by hand, writes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from vicode.check import check_project
from vicode.findings import Finding, Severity
from vicode.model.project import Project
from vicode.output import Difference, Status, apply, compare, set_aside
from vicode.regions import is_sealed
from vicode.sync import find_edits_by_file


@dataclass(frozen=True, slots=True, kw_only=True)
class Generated:
    """What came of it, in words; `files` were written."""

    words: str
    is_sound: bool
    files: tuple[Path, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Job:
    """What to generate from: a project, its files by component, and what was wrong with them when they were read."""

    project: Project
    sources: Mapping[str, str]
    reading: Mapping[str, tuple[Finding, ...]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Prepared:
    """What would be written into a folder; `refused` says why nothing would, `edits` what a person edited there.

    `spared` says why a language is left out where others are not.
    """

    folder: Path
    refused: str = ""
    spared: str = ""
    differences: tuple[Difference, ...] = ()
    edits: Mapping[str, tuple[Finding, ...]]

    @property
    def changes(self) -> tuple[Difference, ...]:
        """The files that are not yet as they should be."""
        return tuple(each for each in self.differences if each.status is not Status.UNCHANGED)


def prepare(folder: Path, job: Job, component: str) -> Prepared:
    """Find out what generating a component, and all it uses, would write into a folder; nothing is written.

    Raises:
        OSError: A file cannot be read.
    """
    from vicode.generators import GENERATORS, collect_components, generate, list_outputs  # noqa: PLC0415 - later

    project = job.project
    wanted = collect_components(project, (component,))
    read = [finding for name in ("", *wanted) for finding in job.reading.get(name, ())]
    errors = [each for each in (*read, *check_project(project, wanted)) if each.severity is Severity.ERROR]
    languages = [each for each in GENERATORS if each in project.languages]
    sound = [each for each in languages if not any(error.concerns(each) for error in errors)]
    reason = _reason(errors, component) if errors else ""
    if errors and not sound:
        return Prepared(folder=folder, refused=f"Nothing generated. {reason}", edits={})
    files = generate(project, components=(component,), languages=sound, sources=job.sources)
    differences = compare(files, folder, keep=list_outputs(project), is_ours=is_sealed)
    left_out = [each for each in languages if each not in sound]
    spared = f"Nothing generated for {' and '.join(left_out)}. {reason}" if left_out else ""
    return Prepared(folder=folder, spared=spared, differences=differences, edits=find_edits_by_file(differences))


def _reason(errors: Sequence[Finding], component: str) -> str:
    first = errors[0]
    where = f"{first.thing.component}: " if first.thing and first.thing.component != component else ""
    more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
    return f"{where}{first.message}{more}"


def write(prepared: Prepared, *, is_forced: bool = False) -> Generated:
    """Write all of it, or nothing if a person's edits would be lost; with force those are set aside first.

    Raises:
        OSError: A file cannot be written.
    """
    if prepared.refused:
        return Generated(words=prepared.refused, is_sound=False)
    if prepared.edits and not is_forced:
        first = next(iter(prepared.edits.values()))[0]
        return Generated(words=f"Nothing generated. {first.message}: {first.mend}", is_sound=False)
    for path in prepared.edits:
        set_aside(prepared.folder / path)
    touched = apply(prepared.differences, prepared.folder)
    words = f"Generated code in {prepared.folder.name} is up to date"
    if touched:
        names = ", ".join(path.name for path in touched[:4]) + (", …" if len(touched) > 4 else "")
        words = f"Generated {names} in {touched[0].parent}"
    words = f"{words}. {prepared.spared}" if prepared.spared else words
    return Generated(words=words, is_sound=not prepared.spared, files=touched)
