"""What sites are about, read from disk: projects of designs, and behaviors in XABSL."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.opening import BEHAVIORS, DESIGNS, Opened, open_paths
from vicode.findings import Finding, Severity

if TYPE_CHECKING:
    from vicode.docsite import SourceText, Subject
    from vicode.findings import Path as ThingPath
    from vicode.importers import Imported
    from vicode.xabsl.compiler import Compiled
    from vicode.xabsl.parser import Parsed
    from vicode.xabsl.sources import Source


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """One project or behavior as it stands on disk.

    `unread` is what stands in the way of reading it; `is_broken` says that something is missing because of it, and
    without a subject all is. `folders` are those that hold its files.
    """

    name: str
    subject: "Subject | None"
    unread: tuple[Finding, ...]
    is_broken: bool
    folders: tuple[Path, ...]


def read_subjects(paths: Sequence[Path]) -> tuple[Reading, ...]:
    """Read all that paths name, each once.

    Raises:
        OSError: A path does not exist or cannot be read.
    """
    readings: list[Reading] = []
    for path in dict.fromkeys(_behavior_in(each) or each for each in paths):
        if path.suffix in BEHAVIORS:
            readings.append(_read_behavior(path))
        elif path.is_file() and path.suffix not in DESIGNS:
            raise OSError(
                f"{path} is neither a design nor an XABSL behavior; "
                "name a design (.yaml), a folder with designs, or the .xabsl file with the agents"
            )
        else:
            readings += [_reading_of(opened) for opened in open_paths([str(path)])]
    return tuple(readings)


def _behavior_in(folder: Path) -> Path | None:
    """The file with the agents, of a folder without designs that holds one behavior."""
    from vicode.store import find_projects
    from vicode.xabsl.sources import files_with_agents

    if not folder.is_dir() or find_projects(folder):
        return None
    found = tuple(files_with_agents(folder))
    if len(found) > 1:
        more = f" and {len(found) - 2} more" if len(found) > 2 else ""
        raise OSError(f"{folder} holds several behaviors; name one of {found[0]}, {found[1]}{more}")
    return found[0] if found else None


def _reading_of(opened: Opened) -> Reading:
    folder = opened.opened.folder.resolve()
    # Where nothing can be read, nothing is told of it: pages of a better time are worth more.
    is_readable = bool(opened.meant) or not opened.opened.broken
    return Reading(
        name=folder.name,
        subject=_subject_of_project(opened) if is_readable else None,
        unread=tuple(each for each in opened.findings if each.severity is Severity.ERROR),
        is_broken=bool(opened.opened.broken),
        folders=(folder,),
    )


def _subject_of_project(opened: Opened) -> "Subject":
    from vicode.docsite import subject_of

    project = opened.opened.project
    meant = set(opened.meant)
    part = replace(project, designs=tuple(each for each in project.designs if each.component in meant))
    faulty = {language: opened.faulty_in(language) for language in project.languages}
    return subject_of(opened.opened, part, opened.findings, faulty)


def _read_behavior(agents: Path) -> Reading:
    """A behavior as a project, with its files of XABSL as sources."""
    from vicode.cli.behaviors import load_behavior, shown
    from vicode.xabsl.compiler import compile_source

    source = load_behavior(agents, _parsed)
    compiled = compile_source(source)
    errors = [each for each in compiled.findings if each.severity is Severity.ERROR]
    is_broken = compiled.program is None
    return Reading(
        name=agents.resolve().parent.name,
        subject=None if is_broken else _subject_of_behavior(agents, source, compiled),
        unread=shown(errors, agents) if is_broken else (),
        is_broken=is_broken,
        folders=tuple(sorted({path.resolve().parent for path in (agents, *source.files)})),
    )


# While a behavior is watched, an edit leaves all other files as they were.
@lru_cache(maxsize=2000)
def _parsed(text: str, name: str) -> "Parsed":
    from vicode.xabsl.parser import parse

    return parse(text, name)


def _subject_of_behavior(agents: Path, source: "Source", compiled: "Compiled") -> "Subject":
    from vicode.check import check_project
    from vicode.docsite import OwnFinding, Subject
    from vicode.importers import import_behavior
    from vicode.store.documents import default_name

    imported = import_behavior(source, compiled, default_name(agents.resolve().parent.name))
    project = imported.project
    found = [
        OwnFinding(component=each.thing.component if each.thing else "", line=0, finding=each)
        for each in check_project(project)
    ]
    errors = [each for each in found if each.finding.severity is Severity.ERROR]
    faulty = {
        language: frozenset(each.component for each in errors if each.finding.concerns(language))
        for language in project.languages
    }
    # The only thing in XABSL that has a title.
    title = project.agents[0].title if len(project.agents) == 1 else ""
    return Subject(
        project=project, findings=tuple(found), sources=_sources(source, imported), faulty=faulty, title=title
    )


def _sources(source: "Source", imported: "Imported") -> "dict[str, SourceText]":
    """The files of a behavior by component, each with the lines of its option's states, decisions and parameters."""
    from vicode.docsite import SourceText, described_paths
    from vicode.xabsl.sources import read_text

    def text_of(path: Path, lines: "dict[ThingPath, int]") -> SourceText:
        folder = source.main.parent
        shown = path.relative_to(folder).as_posix() if path.is_relative_to(folder) else path.name
        return SourceText(path=shown, text=read_text(path), language="xabsl", lines=lines)

    sources = {"": text_of(source.main, {})}
    for made, design in zip(imported.designs, imported.project.designs, strict=True):
        tokens, described = source.files[made.file].tokens, set(described_paths(design))
        lines: dict[ThingPath, int] = {}
        for token, path in made.anchors:
            if path in described:
                lines.setdefault(path, tokens.line_at(tokens.starts[token]))
        sources[made.component] = text_of(made.file, lines)
    return sources
