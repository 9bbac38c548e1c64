"""Follows a run and reports where it breaks a property of a design.

The same monitor confirms the counterexamples of the analysis and checks recorded runs.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from vicode.analysis.quantities import QuantityTable, build_quantities, initial_value
from vicode.model.design import Design, InvariantProperty, NeverProperty, Property, ReachProperty
from vicode.model.expressions import FLOAT, Variable, parse_expression
from vicode.model.project import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedStep:
    """A step of a component.

    Attributes:
        time_ns: The time of the iteration.
        state: The state after the step.
        is_start: Whether the component was started in this step.
        is_entered: Whether the state was entered in this step.
    """

    time_ns: int
    state: str
    is_start: bool
    is_entered: bool


@dataclass(slots=True, kw_only=True)
class PropertyMonitor:
    """Follows one property through the steps of its component.

    Attributes:
        promised: The property.
        within_ns: The time of its `within`; None if it has none.
        fulfilled: How often its state was reached; for a condition, in how many steps it held.
        unknown: In how many steps a condition was not known.
        since_ns: Since when `reach` is due, or `never` is watched; None if nothing is expected.
    """

    promised: Property
    within_ns: int | None = None
    fulfilled: int = 0
    unknown: int = 0
    since_ns: int | None = None
    _is_late: bool = False
    _is_broken: bool = False

    def observe(self, step: ObservedStep, holds: Callable[[str], bool | None]) -> bool:
        """Follow a step; whether the property is broken in it. A condition that remains false is broken once.

        Args:
            step: The step.
            holds: Evaluates a condition after the step; None if it is not known.
        """
        match self.promised:
            case ReachProperty():
                return self._observe_reach(self.promised, step)
            case NeverProperty():
                return self._observe_never(self.promised, step)
            case InvariantProperty(holds=condition):
                value = holds(condition)
                self.fulfilled += value is True
                self.unknown += value is None
                was_broken, self._is_broken = self._is_broken, value is False
                return self._is_broken and not was_broken
            case _:
                return False

    def _observe_reach(self, promised: ReachProperty, step: ObservedStep) -> bool:
        if step.is_start:
            self.since_ns, self._is_late = None if promised.after else step.time_ns, False
        is_late = self.since_ns is not None and self.within_ns is not None
        is_late = is_late and step.time_ns - (self.since_ns or 0) > (self.within_ns or 0)
        was_late, self._is_late = self._is_late, is_late
        if step.is_entered and step.state == promised.reach and self.since_ns is not None:
            self.fulfilled += not is_late
            self.since_ns, self._is_late = None, False
        if step.is_entered and step.state == promised.after and self.since_ns is None:
            self.since_ns = step.time_ns
        return is_late and not was_late

    def _observe_never(self, promised: NeverProperty, step: ObservedStep) -> bool:
        if step.is_start:
            self.since_ns = None if promised.after else step.time_ns
        if not step.is_entered:
            return False
        if step.state == promised.before and self.since_ns is not None:
            self.since_ns = None
            self.fulfilled += 1
        is_broken = self.since_ns is not None and step.state == promised.never
        if step.state == promised.after:
            self.since_ns = step.time_ns
        return is_broken


def create_monitors(project: Project, design: Design) -> tuple[PropertyMonitor, ...]:
    """Create a monitor for each property of a design, in their order."""
    table = build_quantities(project, design)
    return tuple(create_monitor(table, each) for each in design.properties)


def create_monitor(table: QuantityTable, promised: Property) -> PropertyMonitor:
    """Create a monitor for a property of the design to which a table belongs."""
    limit_ns = within_ns(table, promised) if isinstance(promised, ReachProperty) else None
    return PropertyMonitor(promised=promised, within_ns=limit_ns)


def within_ns(table: QuantityTable, promised: ReachProperty, *, is_least: bool = False) -> int | None:
    """The time of `within` in nanoseconds; None if there is none, or it has errors.

    That of a tunable constant is its declared value, or the least in its range.
    """
    tree = parse_expression(promised.within, table.scope, FLOAT).tree if promised.within else None
    value = table.value_of(tree) if tree is not None else None
    if value is None and isinstance(tree, Variable):
        symbol = table.scope.symbols[tree.name]
        range_ = symbol.declaration.range
        if is_least:
            value = range_[0] if range_ else None
        else:
            value = initial_value(symbol.declaration, table.scope, table.constants)
    if not isinstance(value, int | float) or not math.isfinite(value * table.ns_per_unit):
        return None
    return round(value * table.ns_per_unit)
