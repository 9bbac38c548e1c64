"""The ranges of the int variables of a design.

Each `n + 1` could reach 2**53 and would have to be limited, but a counter takes 285 000 years to get there at 1 kHz. So
the ranges are those of the first 2**40 works of a component (35 years at 1 kHz). In one work, each assignment is
executed at most once; it sets a variable to a value of some range, or moves it by a value of some range. A range is an
invariant if it contains what all assignments lead to within these works. Where none is found, the variable may have any
stored value, and its assignments limit it.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping

from vicode.generators.plan.int_assignments import IntAssignment, find_assignments
from vicode.generators.plan.int_ranges import STORED, Interval, IntRanges, limited
from vicode.generators.plan.plan_types import ComponentPlan, ValuePlan
from vicode.model.constant_folding import evaluate_constants
from vicode.model.expressions import INT, Expr, Scope, build_scope
from vicode.model.project import INTERNAL, WORLD, Project

_WORKS = 2**40
_ROUNDS = 4


def constant_ranges(project: Project) -> dict[str, Interval]:
    """The values of the int constants; viewers of a robot may change those that are tunable."""
    values, scope = evaluate_constants(project), build_scope(project, None)
    ints = {
        item.name: values.get(item.name)
        for item in project.constants
        if scope.type_of(item) == INT and not item.tunable
    }
    return {name: (int(value), int(value)) for name, value in ints.items() if value is not None}


def plan_int_ranges(component: ComponentPlan, scope: Scope) -> IntRanges:
    """Analyze the assignments of a component; `component` is complete but for its ranges."""
    own = [value for value in (*component.outputs, *component.variables) if value.type == INT]
    names = constant_ranges(component.project)
    names |= dict.fromkeys((value.name for value in (*component.parameters, *own)), STORED)
    ranges = IntRanges(names, _external_aliases(component))
    if not own:
        return ranges
    found = _Growth(ranges, own, find_assignments(component, scope, {value.name for value in own})).find()
    return IntRanges({**names, **found}, ranges.external)


def _external_aliases(component: ComponentPlan) -> frozenset[str]:
    """Components that the robot program writes. Those of other robots and of the world are limited by the runtime."""
    project, interfaces = component.project, component.project.interfaces()
    return frozenset(
        use.alias
        for use in component.uses
        if project.design(use.component) is None
        and interfaces[use.component].remote is None
        and interfaces[use.component].implementation not in (INTERNAL, WORLD)
    )


class _Growth:
    """Finds invariant ranges of variables."""

    def __init__(self, ranges: IntRanges, values: Iterable[ValuePlan], assigned: Iterable[IntAssignment]) -> None:
        self._external, self._names = ranges.external, dict(ranges.names)
        self._initial = {value.name: limited(ranges.of(value.initial)) for value in values}
        self._assigned = defaultdict[str, list[Expr]](list)
        for name, value in assigned:
            self._assigned[name].append(value)

    def find(self) -> Mapping[str, Interval]:
        self._names |= self._initial
        unstable = set(self._initial)
        rounds = 0
        while unstable:
            # Each pass over this line after the first rounds settles a variable.
            found = {name: self._reached(name) for name in self._initial}
            unstable = {name for name, reached in found.items() if self._names[name] != reached}
            rounds += 1
            self._names |= {name: STORED if rounds > _ROUNDS else found[name] for name in unstable}
        return {name: self._names[name] for name in self._initial}

    def _reached(self, name: str) -> Interval:
        """The range of a variable after the works, if the ranges of all are as they are now."""
        if self._names[name] == STORED:
            return STORED
        ranges = IntRanges(self._names, self._external)
        low, high = self._initial[name]
        down = up = 0
        for value in self._assigned[name]:
            relative, absolute = ranges.offsets(value, name)
            if relative is not None:
                down, up = down + min(relative[0], 0), up + max(relative[1], 0)
            if absolute is not None:
                low, high = min(low, absolute[0]), max(high, absolute[1])
        low, high = low + down * _WORKS, high + up * _WORKS
        low, high = min(low, self._names[name][0]), max(high, self._names[name][1])
        return (low, high) if STORED[0] <= low and high <= STORED[1] else STORED
