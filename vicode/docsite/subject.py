"""What a site is about: a project, what is found in it, and its files as somebody wrote them."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path as FilePath

from vicode.findings import Finding, Path
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.model.walks import walk_decisions
from vicode.store import OpenProject, SourceMap


@dataclass(frozen=True, slots=True, kw_only=True)
class SourceText:
    """A file as it was written: `path` as readers know it, `lines` of the things in it, counted from 1."""

    path: str
    text: str
    language: str
    lines: Mapping[Path, int] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class OwnFinding:
    """A finding with the component it is about, "" for the project, and its line, 0 for none.

    `file` is the file it is in when that is none of the subject's sources, as one that cannot be read.
    """

    component: str
    line: int
    finding: Finding
    file: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Subject:
    """All that a site is made from.

    `sources` are by component, "" is the project's own file; `faulty` names by language the components that nothing
    can be generated for.
    """

    project: Project
    findings: tuple[OwnFinding, ...] = ()
    sources: Mapping[str, SourceText] = field(default_factory=dict)
    faulty: Mapping[str, frozenset[str]] = field(default_factory=dict)
    title: str = ""

    @property
    def name(self) -> str:
        """What readers call it: its title, else the name of the project."""
        return self.title or self.project.name


def subject_of(
    opened: OpenProject, project: Project, findings: Iterable[Finding], faulty: Mapping[str, frozenset[str]]
) -> Subject:
    """The subject of a project on disk; `project` may be a part of it."""
    folder = opened.folder.resolve()
    sources = {}
    for name, source in opened.sources.items():
        design = project.design(name)
        if name and design is None:
            continue
        lines = _lines_of(design, source) if design else {}
        shown = _shown(opened.files[name], folder)
        sources[name] = SourceText(path=shown, text=opened.texts[name], language="yaml", lines=lines)
    owners = {source.file: name for name, source in opened.sources.items()}
    own = (_own(finding, owners, folder) for finding in findings)
    kept = tuple(each for each in own if not each.component or project.design(each.component))
    return Subject(project=project, findings=kept, sources=sources, faulty=faulty)


def _own(finding: Finding, owners: Mapping[str, str], folder: FilePath) -> OwnFinding:
    component, file = finding.thing.component if finding.thing else "", ""
    line = finding.place.line if finding.place else 0
    if finding.place and not finding.thing:
        component = owners.get(finding.place.file, "")
        file = "" if finding.place.file in owners else _shown(FilePath(finding.place.file), folder)
    return OwnFinding(component=component, line=line, finding=finding, file=file)


def _shown(file: FilePath, folder: FilePath) -> str:
    whole = file.resolve()
    return whole.relative_to(folder).as_posix() if whole.is_relative_to(folder) else whole.name


def described_paths(design: Design) -> Iterator[Path]:
    """The paths of all things in a design that a page describes."""
    yield ("common",)
    yield from (("states", state.name) for state in design.states)
    yield from ((section, declaration.name) for section, declaration in design.declarations())
    yield from (located.path for located in walk_decisions(design))


def _lines_of(design: Design, source: SourceMap) -> dict[Path, int]:
    # A thing with a name begins with it; decisions, which end with a number, have none.
    return {
        path: source.place(path, of_key=not isinstance(path[-1], int)).line
        for path in described_paths(design)
        if source.knows(path)
    }
