"""What the button Generate does: checks, generates, guards what was edited by hand, writes."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from vicode.check import check_project
from vicode.findings import Finding, Severity
from vicode.generators import collect_components, generate, list_outputs
from vicode.model.project import Project
from vicode.output import apply, compare
from vicode.regions import is_sealed
from vicode.sync import find_hand_edits


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


def generate_into(folder: Path, job: Job, component: str) -> Generated:
    """Write the code of a component and of all it uses into a folder; nothing is written if anything is wrong.

    Raises:
        OSError: A file cannot be written.
    """
    project = job.project
    wanted = collect_components(project, (component,))
    read = [finding for name in ("", *wanted) for finding in job.reading.get(name, ())]
    errors = [each for each in (*read, *check_project(project, wanted)) if each.severity is Severity.ERROR]
    if errors:
        first = errors[0]
        where = f"{first.thing.component}: " if first.thing and first.thing.component != component else ""
        more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
        return Generated(words=f"Nothing generated. {where}{first.message}{more}", is_sound=False)
    files = generate(project, components=(component,), sources=job.sources)
    differences = compare(files, folder, keep=list_outputs(project), is_ours=is_sealed)
    edits = find_hand_edits(differences)
    if edits:
        return Generated(words=f"Nothing generated. {edits[0].message}: {edits[0].mend}", is_sound=False)
    touched = apply(differences, folder)
    if not touched:
        return Generated(words=f"Generated code in {folder.name} is up to date", is_sound=True)
    names = ", ".join(path.name for path in touched[:4]) + (", …" if len(touched) > 4 else "")
    return Generated(words=f"Generated {names} in {touched[0].parent}", is_sound=True, files=touched)
