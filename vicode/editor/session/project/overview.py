"""The overview of a project on the home page: designs with findings, broken files, hand-written components."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from vicode.check import check_design
from vicode.editor.session.workspace import Workspace
from vicode.findings import Finding, Severity
from vicode.model.design import Design
from vicode.model.project import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignCard:
    """One design; `counts` are the numbers of its findings by severity, without zeros."""

    component: str
    doc: str
    file: str
    states: int
    counts: Mapping[Severity, int]
    is_unsaved: bool
    is_root: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class BrokenFile:
    """A design file that cannot be parsed; `line` is 0 if the error has no location."""

    file: str
    reason: str
    line: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class HandWrittenComponent:
    """A component without a design."""

    component: str
    doc: str
    implementation: str
    used_by: tuple[str, ...]


@dataclass(eq=False)
class ProjectOverview:
    """The overview of one project; a design is checked again only when it or one of its dependencies has changed."""

    workspace: Workspace
    _checked: dict[str, tuple[object, tuple[Finding, ...]]] = field(init=False, default_factory=dict)

    def cards(self) -> tuple[DesignCard, ...]:
        """All designs, sorted by component."""
        project, sources, unsaved = (
            self.workspace.project,
            self.workspace.source_paths,
            self.workspace.unsaved_components,
        )
        roots = {agent.root for agent in project.agents}
        dependencies = _check_dependencies(project)
        return tuple(
            DesignCard(
                component=design.component,
                doc=" ".join(design.doc.split()),
                file=sources.get(design.component, ""),
                states=len(design.states),
                counts=_count(self._findings(design, dependencies)),
                is_unsaved=design.component in unsaved,
                is_root=design.component in roots,
            )
            for design in sorted(project.designs, key=lambda described: described.component.casefold())
        )

    def broken_files(self) -> tuple[BrokenFile, ...]:
        """The files that cannot be parsed, each with its first error."""
        return tuple(self._broken(name) for name in self.workspace.broken_file_names)

    def hand_written_components(self) -> tuple[HandWrittenComponent, ...]:
        """The components declared in project.yaml, sorted by name."""
        project = self.workspace.project
        return tuple(
            HandWrittenComponent(
                component=interface.component,
                doc=interface.doc,
                implementation=interface.implementation,
                used_by=tuple(
                    design.component
                    for design in project.designs
                    if any(use.component == interface.component for use in design.uses)
                ),
            )
            for interface in sorted(project.components, key=lambda interface: interface.component.casefold())
        )

    def _findings(self, design: Design, dependencies: object) -> tuple[Finding, ...]:
        workspace, name = self.workspace, design.component
        known = workspace.findings_if_open(name)
        if known is not None:
            return known
        interfaces = tuple(workspace.project.interface(use.component) for use in design.uses)
        seen = (dependencies, interfaces, workspace.parse_findings.get(name, ()))
        cached = self._checked.get(name)
        if cached is None or cached[0] != (id(design), seen):
            checked = check_design(workspace.project, design)
            cached = (id(design), seen), tuple(dict.fromkeys((*workspace.parse_findings.get(name, ()), *checked)))
            self._checked[name] = cached
        return cached[1]

    def _broken(self, file: str) -> BrokenFile:
        every = (finding for findings in self.workspace.parse_findings.values() for finding in findings)
        for finding in every:
            if finding.location is not None and finding.location.file.endswith(file):
                return BrokenFile(file=file, reason=finding.message, line=finding.location.line)
        return BrokenFile(file=file, reason="the file contains no readable design")


def _check_dependencies(project: Project) -> object:
    """The parts of a project on which the findings of every design depend."""
    uses = tuple((design.component, design.uses) for design in project.designs)
    return (project.enumerations, project.constants, uses)


def _count(findings: tuple[Finding, ...]) -> Mapping[Severity, int]:
    counts = {severity: sum(finding.severity is severity for finding in findings) for severity in Severity}
    return {severity: count for severity, count in counts.items() if count}
