"""The input of a site: a project, its findings, and its source files."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path as FilePath
from urllib.parse import quote

from vicode.findings import DesignPath, Finding
from vicode.model.design import Assign, Design
from vicode.model.project import Project
from vicode.model.traversal import iter_actions, iter_decisions
from vicode.store import OpenProject, SourceMap


@dataclass(frozen=True, slots=True, kw_only=True)
class SourceText:
    """A source file: `path` is for display, `line_numbers` are 1-based lines of nodes.

    `action_lines` are those of the actions and assignments in states.
    """

    path: str
    text: str
    language: str
    line_numbers: Mapping[DesignPath, int] = field(default_factory=dict)
    action_lines: Mapping[DesignPath, int] = field(default_factory=dict)

    def nearest_line(self, path: DesignPath) -> int:
        """The line of the innermost node at or above a path that has one, else 0."""
        for end in range(len(path), 0, -1):
            line = self.action_lines.get(path[:end]) or self.line_numbers.get(path[:end])
            if line:
                return line
        return 0


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentFinding:
    """A finding with its component ("" for the project) and line (0 if unknown).

    `file` is set if the finding is in a file that is not among the sources, such as an unreadable one.
    """

    component: str
    line: int
    finding: Finding
    file: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class SiteInput:
    """The input of a site.

    `sources` is keyed by component, "" for the project file. `components_with_errors` lists, by language, the
    components for which no code can be generated. `source_url` is the address of a line in a repository, with {path}
    and {line}.
    """

    project: Project
    findings: tuple[ComponentFinding, ...] = ()
    sources: Mapping[str, SourceText] = field(default_factory=dict)
    components_with_errors: Mapping[str, frozenset[str]] = field(default_factory=dict)
    title: str = ""
    source_url: str = ""

    def repository_link(self, path: str, line: int = 1) -> str:
        """The address of a line of a source, "" if there is none."""
        return self.source_url.replace("{path}", quote(path)).replace("{line}", str(line))

    @property
    def name(self) -> str:
        """The title, else the name of the project."""
        return self.title or self.project.name


def make_site_input(
    opened: OpenProject, project: Project, findings: Iterable[Finding], faulty: Mapping[str, frozenset[str]]
) -> SiteInput:
    """The input for a project on disk; `project` may be a part of it."""
    folder = opened.folder.resolve()
    sources = {}
    for name, source in opened.sources.items():
        design = project.design(name)
        if name and design is None:
            continue
        lines = _line_numbers(design, source) if design else {}
        shown = _display_path(opened.files[name], folder)
        actions = _action_lines(design, source) if design else {}
        sources[name] = SourceText(
            path=shown, text=opened.texts[name], language="yaml", line_numbers=lines, action_lines=actions
        )
    owners = {source.file: name for name, source in opened.sources.items()}
    own = (_component_finding(finding, owners, folder) for finding in findings)
    kept = tuple(each for each in own if not each.component or project.design(each.component))
    return SiteInput(project=project, findings=kept, sources=sources, components_with_errors=faulty)


def _component_finding(finding: Finding, owners: Mapping[str, str], folder: FilePath) -> ComponentFinding:
    component, file = finding.subject.component if finding.subject else "", ""
    line = finding.location.line if finding.location else 0
    if finding.location and not finding.subject:
        component = owners.get(finding.location.file, "")
        file = "" if finding.location.file in owners else _display_path(FilePath(finding.location.file), folder)
    return ComponentFinding(component=component, line=line, finding=finding, file=file)


def _display_path(file: FilePath, folder: FilePath) -> str:
    whole = file.resolve()
    return whole.relative_to(folder).as_posix() if whole.is_relative_to(folder) else whole.name


def iter_documented_paths(design: Design) -> Iterator[DesignPath]:
    """The paths of all nodes of a design that have a description on its page."""
    yield ("common",)
    yield from (("states", state.name) for state in design.states)
    yield from ((section, declaration.name) for section, declaration in design.declarations())
    yield from (located.path for located in iter_decisions(design))


def iter_action_paths(design: Design) -> Iterator[DesignPath]:
    """The paths of all actions, each followed by those of its assignments."""
    for located in iter_actions(design):
        yield located.path
        if isinstance(located.action, Assign):
            yield from ((*located.path, "set", name) for name, _value in located.action.values)


def _action_lines(design: Design, source: SourceMap) -> dict[DesignPath, int]:
    return {
        path: source.locate(path, of_key=not isinstance(path[-1], int)).line
        for path in iter_action_paths(design)
        if source.contains(path)
    }


def _line_numbers(design: Design, source: SourceMap) -> dict[DesignPath, int]:
    # A named node starts at its name; the path of a decision ends with an index.
    return {
        path: source.locate(path, of_key=not isinstance(path[-1], int)).line
        for path in iter_documented_paths(design)
        if source.contains(path)
    }
