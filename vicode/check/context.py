"""The input of design rules: the design, its project, and traversals that several rules share."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from vicode.check.graphs import ComponentGraphs, StepSite, build_graphs, iter_steps
from vicode.check.identifiers_in_text import find_identifiers
from vicode.check.typed_expressions import TypedExpression, parse_expressions
from vicode.findings import DesignPath, Finding, FindingSubject, Note, Span, get_rule
from vicode.model.design import Design
from vicode.model.disabled import disabled_states
from vicode.model.expressions import Scope, build_scope
from vicode.model.project import Project
from vicode.model.traversal import LocatedAction, LocatedCode, LocatedDecision, iter_actions, iter_code, iter_decisions

if TYPE_CHECKING:
    from vicode.analysis.machines import MachineAnalysis


@dataclass(frozen=True, kw_only=True)
class RuleContext:
    """A design and its project, traversed once for all rules."""

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
    code_identifiers: frozenset[str]
    """All identifiers in hand-written code."""

    @cached_property
    def machine(self) -> "MachineAnalysis":
        """What is proved about the states and decisions."""
        from vicode.analysis.machines import MachineAnalysis  # noqa: PLC0415 - only warnings need it

        return MachineAnalysis(self.project, self.design)

    def make_subject(self, path: DesignPath, span: Span | None = None, *, is_key: bool = False) -> FindingSubject:
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
        """Create a finding about this design. Without `languages` it applies to all languages."""
        subject = self.make_subject(path, span, is_key=is_key)
        finding = Finding(rule=get_rule(code), message=message, fix=fix, subject=subject, notes=tuple(notes))
        return replace(finding, languages=languages) if languages else finding


def build_context(project: Project, design: Design) -> RuleContext:
    """Build the context of a design, which replaces the design with the same name in the project."""
    if not any(other is design for other in project.designs):
        project = _with_design(project, design)
    return build_context_with_graphs(project, design, build_graphs(project))


def build_context_with_graphs(project: Project, design: Design, graphs: ComponentGraphs) -> RuleContext:
    scope = build_scope(project, design)
    decisions, actions, codes = tuple(iter_decisions(design)), tuple(iter_actions(design)), tuple(iter_code(design))
    return RuleContext(
        project=project,
        design=design,
        scope=scope,
        graphs=graphs,
        decisions=decisions,
        actions=actions,
        code_blocks=codes,
        expressions=tuple(parse_expressions(design, scope, decisions, actions)),
        steps=tuple(iter_steps(design)),
        disabled_states=disabled_states(design),
        code_identifiers=find_identifiers("\n".join(text for placed in codes for _language, text in placed.code.texts)),
    )


def _with_design(project: Project, design: Design) -> Project:
    others = tuple(other for other in project.designs if other.component != design.component)
    return replace(project, designs=(*others, design))
