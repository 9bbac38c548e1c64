"""What every rule is handed: the design, its project, and the walks that several rules need, done once."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

from vicode.check.graphs import Graphs, Step, graphs_of, steps_of
from vicode.check.readings import Expression, read_expressions, reader_of
from vicode.check.words import words_of
from vicode.findings import Finding, Note, Path, Span, Thing, rule
from vicode.model.design import Design
from vicode.model.enabling import disabled_states
from vicode.model.expressions import Scope
from vicode.model.project import Project
from vicode.model.walks import Located, PlacedAction, PlacedCode, walk_actions, walk_code, walk_decisions


@dataclass(frozen=True, slots=True, kw_only=True)
class Context:
    """A design within its project, read once for all rules."""

    project: Project
    design: Design
    scope: Scope
    graphs: Graphs
    decisions: tuple[Located, ...]
    actions: tuple[PlacedAction, ...]
    codes: tuple[PlacedCode, ...]
    expressions: tuple[Expression, ...]
    steps: tuple[Step, ...]
    off: frozenset[str]
    """The disabled states."""
    words: frozenset[str]
    """All names in hand-written code."""

    def thing(self, path: Path, span: Span | None = None, *, of_key: bool = False) -> Thing:
        """A thing of this design."""
        return Thing(component=self.design.component, path=path, span=span, of_key=of_key)

    def find(
        self,
        code: str,
        path: Path,
        message: str,
        mend: str = "",
        *,
        span: Span | None = None,
        of_key: bool = False,
        notes: Iterable[Note] = (),
        languages: tuple[str, ...] = (),
    ) -> Finding:
        """A finding about a thing of this design, in the way of all languages or of these."""
        thing = self.thing(path, span, of_key=of_key)
        finding = Finding(rule=rule(code), message=message, mend=mend, thing=thing, notes=tuple(notes))
        return replace(finding, languages=languages) if languages else finding


def context_of(project: Project, design: Design) -> Context:
    """Read a design; it takes the place of the one of the same name in the project."""
    if not any(each is design for each in project.designs):
        project = _put_in(project, design)
    return read_design(project, design, graphs_of(project))


def read_design(project: Project, design: Design, graphs: Graphs) -> Context:
    """Read a design within a project, whose graphs are given."""
    reader = reader_of(project, design)
    decisions, actions, codes = tuple(walk_decisions(design)), tuple(walk_actions(design)), tuple(walk_code(design))
    return Context(
        project=project,
        design=design,
        scope=reader.scope,
        graphs=graphs,
        decisions=decisions,
        actions=actions,
        codes=codes,
        expressions=tuple(read_expressions(design, reader, decisions, actions)),
        steps=tuple(steps_of(design)),
        off=disabled_states(design),
        words=words_of("\n".join(text for placed in codes for _language, text in placed.code.texts)),
    )


def _put_in(project: Project, design: Design) -> Project:
    others = tuple(each for each in project.designs if each.component != design.component)
    return replace(project, designs=(*others, design))
