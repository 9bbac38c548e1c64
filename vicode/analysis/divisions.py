"""Divisions by zero, for values that the declarations allow.

A division is evaluated under conditions: the parts of its expression before it, and for a guard the earlier decisions,
for an action the transitions to its state. A divisor that can be zero by its type alone is not reported, as nearly
every one can: it has a declared range with zero, or the conditions leave nothing else.
"""

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from vicode.analysis.choices import lower_to_choices
from vicode.analysis.conditions import STATE_TIME
from vicode.analysis.examples import Example, find_example
from vicode.analysis.interval_diagrams import FALSE, TRUE, Node, TooLargeError
from vicode.analysis.machines import MachineAnalysis
from vicode.findings import DesignPath
from vicode.model.design import Guard
from vicode.model.expressions import (
    INT,
    Binary,
    Comparison,
    Expr,
    FunctionCall,
    Logic,
    Minus,
    Number,
    Ternary,
    children,
    walk,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ZeroDivision:
    """A division, and values for which its divisor is zero; none if it always is."""

    division: Binary
    example: Example


class DivisionSearch:
    """Finds divisions by zero in the expressions of a design.

    Args:
        machine: The design.
        assigned: Names that are set in it; their values may depend on what was tested before.
    """

    def __init__(self, machine: MachineAnalysis, assigned: Collection[str]) -> None:
        self._machine, self._assigned = machine, assigned
        self._conditions = machine.guards.conditions
        self._diagrams = self._conditions.diagrams
        decisions = (*machine.guards.common, *(each for found in machine.guards.states.values() for each in found))
        self._decisions = {each.path: each for each in decisions}

    def find(self, tree: Expr, path: DesignPath) -> Iterator[ZeroDivision]:
        """Yield the divisions by zero in the expression at a path, which has no errors."""
        if not any(_is_division(node) for node in walk(tree)):
            return
        self._diagrams.begin_question()
        try:
            for division, condition in self._iterate(tree, self._condition_of(path)):
                found = self._judge(division, condition)
                if found is not None:
                    yield found
        except (TooLargeError, RecursionError):
            return

    def _judge(self, division: Binary, condition: Node) -> ZeroDivision | None:
        divisor = division.right
        value = self._conditions.table.value_of(divisor)
        if value is not None:
            is_reached = value == 0 and self._machine.guards.is_possible(condition)
            return ZeroDivision(division=division, example={}) if is_reached else None
        zero = self._conditions.compare(divisor, "==", Number(value=0, type=INT, span=divisor.span))
        case = self._diagrams.both(condition, zero)
        others = self._diagrams.without(condition, zero)
        if case == FALSE or (self._machine.guards.is_possible(others) and not self._has_ranges(divisor)):
            return None
        example = find_example(self._conditions, case)
        if not example or any(name in self._assigned for name in example):
            return None
        return ZeroDivision(division=division, example=example)

    def _has_ranges(self, divisor: Expr) -> bool:
        """Whether a divisor is a value with a declared range, or a choice of such values.

        A difference of floats is hardly ever exactly zero.
        """
        table, divisor = self._conditions.table, lower_to_choices(divisor)
        if table.value_of(divisor) is not None or table.quantity(divisor).has_range:
            return True
        match divisor:
            case Minus(operand=operand) | FunctionCall(function="abs" | "float", arguments=(operand,)):
                return self._has_ranges(operand)
            case Ternary(then=then, otherwise=otherwise):
                return self._has_ranges(then) and self._has_ranges(otherwise)
            case Binary(type="int", left=left, right=right):
                return self._has_ranges(left) and self._has_ranges(right)
            case _:
                return False

    # The conditions under which an expression, and a part of it, is evaluated

    def _condition_of(self, path: DesignPath) -> Node:
        match path:
            case (*_, "when") if tested := self._decisions.get(path[:-1]):
                after = self._conditions.of_guard(Guard(after=tested.decision.guard.after))
                return self._diagrams.both(self._diagrams.both(tested.within, tested.reached), after)
            case (*_, "when") | (*_, "after"):
                # Disabled.
                return FALSE
            case ("states", str(state), str(phase), *_):
                return self._condition_of_phase(state, phase)
            case _:
                return TRUE

    def _condition_of_phase(self, state: str, phase: str) -> Node:
        if state not in self._machine.reachable:
            return FALSE
        is_initial, left = state == self._machine.design.initial, FALSE
        for edge in self._machine.live[state]:
            left = self._diagrams.either(left, edge.taken)
        if phase == "leave":
            return left
        if phase == "enter":
            return TRUE if is_initial else self._find_entry(state)
        # A state that a restart enters is tested at once.
        return self._diagrams.either(self._machine.staying(state), self._find_entry(state))

    def _find_entry(self, state: str) -> Node:
        """The values for which a transition to a state is taken, at the time zero in it."""
        entered = FALSE
        for source in self._machine.reachable:
            for edge in self._machine.live[source]:
                if edge.target == state:
                    entered = self._diagrams.either(entered, self._diagrams.exists(edge.taken, (STATE_TIME,)))
        return self._diagrams.both(entered, self._diagrams.test(STATE_TIME, (((0, 0), (1, 0)),)))

    def _iterate(self, node: Expr, condition: Node) -> Iterator[tuple[Binary, Node]]:
        """Yield the divisions with their conditions; an operand may be evaluated only if those before it allow it."""
        if isinstance(node, Binary) and _is_division(node):
            yield node, condition
        match node:
            case Logic(operator=operator, operands=operands):
                combine = self._diagrams.both if operator == "and" else self._diagrams.without
                for operand in operands:
                    yield from self._iterate(operand, condition)
                    condition = combine(condition, self._conditions.of_tree(operand))
            case Ternary(test=test, then=then, otherwise=otherwise):
                holds = self._conditions.of_tree(test)
                yield from self._iterate(test, condition)
                yield from self._iterate(then, self._diagrams.both(condition, holds))
                yield from self._iterate(otherwise, self._diagrams.without(condition, holds))
            case Comparison(operators=operators, operands=operands):
                for index, operand in enumerate(operands):
                    yield from self._iterate(operand, condition)
                    if 0 < index < len(operators):
                        before = self._conditions.compare(operands[index - 1], operators[index - 1], operand)
                        condition = self._diagrams.both(condition, before)
            case _:
                for child in children(node):
                    yield from self._iterate(child, condition)


def _is_division(node: Expr) -> bool:
    return isinstance(node, Binary) and node.operator in ("/", "//", "%")
