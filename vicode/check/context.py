"""What every rule is handed: the design, its project, and the walks that several rules need, done once."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

from vicode.check.graphs import ComponentGraphs, StepSite, build_graphs, iter_steps
from vicode.check.identifiers_in_text import find_identifiers
from vicode.check.typed_expressions import TypedExpression, build_expression_parser, parse_expressions
from vicode.findings import DesignPath, Finding, FindingSubject, Note, Span, get_rule
from vicode.model.design import Design
from vicode.model.disabled import disabled_states
from vicode.model.expressions import Scope
from vicode.model.project import Project
from vicode.model.traversal import LocatedAction, LocatedCode, LocatedDecision, iter_actions, iter_code, iter_decisions


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleContext:
    """A design within its project, read once for all rules."""

    project: Project
    design: Design
    scope: Scope
    graphs: ComponentGraphs
    decisions: tuple[LocatedDecision, ...]
    actions: tuple[LocatedAction, ...]
    code_blocks: tuple[LocatedCode, ...]
    expressions: tuple[TypedExpression, ...]
    steps: tuple[StepSite, ...]
    disabled_states: frozenset[str]
    """The disabled states."""
    code_identifiers: frozenset[str]
    """All names in hand-written code."""

    def make_subject(self, path: DesignPath, span: Span | None = None, *, is_key: bool = False) -> FindingSubject:
        """A thing of this design."""
        return FindingSubject(component=self.design.component, path=path, span=span, is_key=is_key)

    def make_finding(
        self,
        code: str,
        path: DesignPath,
        message: str,
        fix: str = "",
        *,
        span: Span | None = None,
        is_key: bool = False,
        notes: Iterable[Note] = (),
        languages: tuple[str, ...] = (),
    ) -> Finding:
        """A finding about a thing of this design, in the way of all languages or of these."""
        thing = self.make_subject(path, span, is_key=is_key)
        finding = Finding(rule=get_rule(code), message=message, fix=fix, subject=thing, notes=tuple(notes))
        return replace(finding, languages=languages) if languages else finding


def build_context(project: Project, design: Design) -> RuleContext:
    """Read a design; it takes the place of the one of the same name in the project."""
    if not any(each is design for each in project.designs):
        project = _with_design(project, design)
    return build_context_with_graphs(project, design, build_graphs(project))


def build_context_with_graphs(project: Project, design: Design, graphs: ComponentGraphs) -> RuleContext:
    """Read a design within a project, whose graphs are given."""
    reader = build_expression_parser(project, design)
    decisions, actions, codes = tuple(iter_decisions(design)), tuple(iter_actions(design)), tuple(iter_code(design))
    return RuleContext(
        project=project,
        design=design,
        scope=reader.scope,
        graphs=graphs,
        decisions=decisions,
        actions=actions,
        code_blocks=codes,
        expressions=tuple(parse_expressions(design, reader, decisions, actions)),
        steps=tuple(iter_steps(design)),
        disabled_states=disabled_states(design),
        code_identifiers=find_identifiers("\n".join(text for placed in codes for _language, text in placed.code.texts)),
    )


def _with_design(project: Project, design: Design) -> Project:
    others = tuple(each for each in project.designs if each.component != design.component)
    return replace(project, designs=(*others, design))
