"""What the home page shows of a project: its designs with their findings, broken files, components written by hand."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from vicode.check import check_design
from vicode.editor.session.workspace import Workspace
from vicode.findings import Finding, Severity
from vicode.model.design import Design
from vicode.model.project import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class Card:
    """One design; `counts` are its findings by severity, those it has any of."""

    component: str
    doc: str
    file: str
    states: int
    counts: Mapping[Severity, int]
    is_unsaved: bool
    is_root: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Broken:
    """A file that holds no design that can be read; `why` in words, `line` 0 when no line is to blame."""

    file: str
    why: str
    line: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class HandWritten:
    """A component without a design."""

    component: str
    doc: str
    implementation: str
    used_by: tuple[str, ...]


@dataclass(eq=False)
class Overview:
    """Of one project; designs are checked again only after something in the project has changed."""

    workspace: Workspace
    _project: Project | None = field(init=False, default=None)
    _findings: dict[str, tuple[Finding, ...]] = field(init=False, default_factory=dict)

    def cards(self) -> tuple[Card, ...]:
        """The designs by name."""
        project = self.workspace.project
        if project is not self._project:
            self._findings, self._project = {}, project
        roots = {agent.root for agent in project.agents}
        return tuple(
            self._card(design, is_root=design.component in roots)
            for design in sorted(project.designs, key=lambda each: each.component.casefold())
        )

    def broken(self) -> tuple[Broken, ...]:
        """The files that cannot be read, each with what is wrong first."""
        return tuple(self._broken(name) for name in self.workspace.broken)

    def hand_written(self) -> tuple[HandWritten, ...]:
        """The components declared in project.yaml, by name."""
        project = self.workspace.project
        return tuple(
            HandWritten(
                component=each.component,
                doc=each.doc,
                implementation=each.implementation,
                used_by=tuple(
                    design.component
                    for design in project.designs
                    if any(use.component == each.component for use in design.uses)
                ),
            )
            for each in sorted(project.components, key=lambda each: each.component.casefold())
        )

    def _card(self, design: Design, *, is_root: bool) -> Card:
        workspace, name = self.workspace, design.component
        if name not in self._findings:
            checked = check_design(workspace.project, design)
            self._findings[name] = tuple(dict.fromkeys((*workspace.reading.get(name, ()), *checked)))
        found = self._findings[name]
        counts = {severity: sum(each.severity is severity for each in found) for severity in Severity}
        return Card(
            component=name,
            doc=" ".join(design.doc.split()),
            file=workspace.sources.get(name, workspace.files[name].name),
            states=len(design.states),
            counts={severity: count for severity, count in counts.items() if count},
            is_unsaved=name in workspace.unsaved,
            is_root=is_root,
        )

    def _broken(self, file: str) -> Broken:
        every = (finding for findings in self.workspace.reading.values() for finding in findings)
        for finding in every:
            if finding.place is not None and finding.place.file.endswith(file):
                return Broken(file=file, why=finding.message, line=finding.place.line)
        return Broken(file=file, why="it holds no design that can be read")
