"""Checks the properties of designs, and what is assumed of components, in recorded or running iterations."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from vicode.analysis.property_monitor import ObservedStep, PropertyMonitor, create_monitors
from vicode.model.design import Design, InvariantProperty, RecoveryProperty
from vicode.model.expressions import BOOL, Expr, build_interface_scope, evaluate, parse_expression
from vicode.model.project import Interface, Project
from vicode.model.words import describe_property
from vicode.runs.guard_values import guard_values, read_recorded
from vicode.simulation import IterationResult


@dataclass(slots=True, kw_only=True)
class PropertyResult:
    """What a run says about a property, or about the assumption about a component.

    Attributes:
        component: The component.
        phrase: The property in words.
        kept: How often its state was reached, or in how many steps its condition held.
        broken_ns: The times at which it was broken.
        unknown: In how many steps a condition read values that are not known.
    """

    component: str
    phrase: str
    kept: int = 0
    broken_ns: list[int] = field(default_factory=list)
    unknown: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class _Assumed:
    interface: Interface
    tree: Expr
    result: PropertyResult


class PropertyCheck:
    """Follows a run of a project.

    Args:
        project: The project, with all designs.
    """

    def __init__(self, project: Project) -> None:
        self._project = project
        self._monitors: dict[str, list[tuple[PropertyMonitor, PropertyResult]]] = {}
        for design in project.designs:
            monitors = create_monitors(project, design)
            self._monitors[design.component] = [
                (each, PropertyResult(component=design.component, phrase=describe_property(each.promised)))
                for each in monitors
                # Whether there is a way back shows in no single run.
                if not isinstance(each.promised, RecoveryProperty)
            ]
        self._assumed = list(_list_assumptions(project))
        self._states: dict[str, str] = {}
        self._latest: dict[str, Mapping[str, Any]] = {}

    @property
    def results(self) -> list[PropertyResult]:
        """What is known so far, for each property and assumption."""
        return [result for monitors in self._monitors.values() for _monitor, result in monitors] + [
            each.result for each in self._assumed
        ]

    def observe(self, iteration: IterationResult) -> list[PropertyResult]:
        """Follow an iteration; the properties that are broken in it."""
        broken: list[PropertyResult] = []
        self._latest |= {str(step["component"]): step for step in iteration.tree}
        active = {str(step["component"]) for step in iteration.tree}
        self._states = {name: state for name, state in self._states.items() if name in active}
        for step in iteration.tree:
            design = self._project.design(str(step["component"]))
            if design is not None and step.get("state") and self._monitors[design.component]:
                broken += self._observe_step(design, step, iteration)
        for each in self._assumed:
            if self._observe_assumption(each, iteration):
                broken.append(each.result)
        return broken

    def _observe_step(
        self, design: Design, step: Mapping[str, Any], iteration: IterationResult
    ) -> Iterator[PropertyResult]:
        was_away = design.component not in self._states
        observed = list(self._observed(design.component, step, iteration.time_ns))
        self._states[design.component] = str(step["state"])
        holds = partial(self._holds, design, iteration)
        if was_away and not observed[0].is_start:
            # What was expected ended when the caller left.
            for monitor, _result in self._monitors[design.component]:
                monitor.since_ns = None
        for monitor, result in self._monitors[design.component]:
            # A condition is one on the values after the step.
            seen = observed[-1:] if isinstance(monitor.promised, InvariantProperty) else observed
            broken = [each for each in seen if monitor.observe(each, holds)]
            result.kept, result.unknown = monitor.fulfilled, monitor.unknown
            if broken:
                result.broken_ns.append(iteration.time_ns)
                yield result

    def _observed(self, component: str, step: Mapping[str, Any], time_ns: int) -> Iterator[ObservedStep]:
        state, left, known = str(step["state"]), step.get("changed_from"), self._states.get(component)
        passed_ns = step.get("component_time_ns")
        is_start = known is None if passed_ns is None else passed_ns == 0
        if is_start and left:
            # The initial state was left in the first step.
            yield ObservedStep(time_ns=time_ns, state=str(left), is_start=True, is_entered=True)
            is_start = False
        is_entered = is_start or bool(left) or (known is not None and known != state)
        yield ObservedStep(time_ns=time_ns, state=state, is_start=is_start, is_entered=is_entered)

    def _holds(self, design: Design, iteration: IterationResult, condition: str) -> bool | None:
        focused = replace(iteration, component=design.component)
        values = guard_values(self._project, design, focused, self._latest)
        tree = parse_expression(condition, values.scope, BOOL).tree
        value = values.evaluate(tree) if tree is not None else None
        return None if value is None else bool(value)

    def _observe_assumption(self, assumed: _Assumed, iteration: IterationResult) -> bool:
        values = read_recorded(iteration, assumed.interface.component, self._project)
        holds = evaluate(assumed.tree, values)
        assumed.result.kept += holds is True
        assumed.result.unknown += holds is None
        if holds is False:
            assumed.result.broken_ns.append(iteration.time_ns)
        return holds is False and len(assumed.result.broken_ns) == 1


def _list_assumptions(project: Project) -> Iterator[_Assumed]:
    for interface in project.components:
        if interface.assume:
            tree = parse_expression(interface.assume, build_interface_scope(project, interface), BOOL).tree
            phrase = " ".join(f"assumed {interface.assume}".split())
            if tree is not None:
                result = PropertyResult(component=interface.component, phrase=phrase)
                yield _Assumed(interface=interface, tree=tree, result=result)
