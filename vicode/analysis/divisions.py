"""Divisions by zero, for values that the declarations allow.

A division is evaluated under conditions: the parts of its expression before it, and for a guard the earlier decisions,
for an action the transitions to its state. A divisor that can be zero by its type alone is not reported, as nearly
every one can: it has a declared range with zero, or the conditions leave nothing else.
"""

from collections.abc import Iterator, Mapping, Set
from dataclasses import replace
from functools import cached_property

from vicode.analysis.choices import lower_to_choices
from vicode.analysis.conditions import STATE_TIME
from vicode.analysis.examples import Example, find_example
from vicode.analysis.interval_diagrams import FALSE, TRUE, Node, TooLargeError
from vicode.analysis.machines import MachineAnalysis
from vicode.findings import DesignPath
from vicode.model import expressions as ex
from vicode.model.design import Guard
from vicode.model.expressions import Binary, Expr


class DivisionSearch:
    """Finds divisions by zero in the expressions of a design.

    Args:
        machine: The design.
        assigned: Names that are set in it; their values may depend on what was tested before.
    """

    def __init__(self, machine: MachineAnalysis, assigned: Set[str]) -> None:
        self._machine, self._assigned = machine, assigned
        self._conditions = machine.guards.conditions
        self._diagrams = self._conditions.diagrams
        self._decisions = {each.path: each for each in machine.guards.listed}

    def find(self, tree: Expr, path: DesignPath) -> Iterator[tuple[Binary, Example]]:
        """Yield the divisions by zero in the expression at a path, which has no errors.

        Each has values for which its divisor is zero; none if it always is.
        """
        if not any(_is_division(node) for node in ex.walk(tree)):
            return
        self._diagrams.begin_question()
        try:
            for division, condition in self._iterate(tree, self._condition_of(path)):
                example = self._find_example(division.right, condition)
                if example is not None:
                    yield division, example
        except (TooLargeError, RecursionError):
            return

    def _find_example(self, divisor: Expr, condition: Node) -> Example | None:
        value = self._conditions.table.value_of(divisor)
        if value is not None:
            return {} if value == 0 and self._machine.guards.is_possible(condition) else None
        zero = ex.Number(value=0, type=ex.INT, span=divisor.span)
        is_zero = self._conditions.of_condition(
            ex.Comparison(operators=("==",), operands=(divisor, zero), span=divisor.span)
        )
        others = self._diagrams.without(condition, is_zero)
        if self._machine.guards.is_possible(others) and not self._has_ranges(divisor):
            return None
        example = find_example(self._conditions, self._diagrams.both(condition, is_zero))
        return None if not example or self._assigned & example.keys() else example

    def _has_ranges(self, divisor: Expr) -> bool:
        """Whether a divisor is a value with a declared range, or a choice of such values.

        A difference of floats is hardly ever exactly zero.
        """
        table, divisor = self._conditions.table, lower_to_choices(divisor)
        if table.value_of(divisor) is not None or table.quantity(divisor).has_range:
            return True
        match divisor:
            case ex.Minus() | ex.FunctionCall(function="abs" | "float") | Binary(type="int"):
                return all(map(self._has_ranges, ex.children(divisor)))
            case ex.Ternary(then=then, otherwise=otherwise):
                return self._has_ranges(then) and self._has_ranges(otherwise)
            case _:
                return False

    # The conditions under which an expression, and a part of it, is evaluated

    def _condition_of(self, path: DesignPath) -> Node:
        match path:
            case (*_, "when") if tested := self._decisions.get(path[:-1]):
                after = self._conditions.of_guard(Guard(after=tested.decision.guard.after))
                return self._diagrams.both(self._diagrams.both(tested.within, tested.reached), after)
            case (*_, "when" | "after"):
                # Disabled.
                return FALSE
            case ("states", str(state), str(phase), *_):
                return self._condition_of_phase(state, phase)
            case _:
                return TRUE

    def _condition_of_phase(self, state: str, phase: str) -> Node:
        if state not in self._machine.reachable:
            return FALSE
        if phase == "leave":
            return self._diagrams.negate(self._machine.staying(state))
        if phase == "enter" and state == self._machine.design.initial:
            return TRUE
        entered = FALSE
        for taken in self._entries.get(state, ()):
            entered = self._diagrams.either(entered, self._diagrams.exists(taken, (STATE_TIME,)))
        entered = self._diagrams.both(entered, self._diagrams.test(STATE_TIME, (((0, 0), (1, 0)),)))
        # A restart enters the initial state and tests it at once.
        return entered if phase == "enter" else self._diagrams.either(self._machine.staying(state), entered)

    @cached_property
    def _entries(self) -> Mapping[str, list[Node]]:
        """The values for which transitions to each state are taken."""
        entries: dict[str, list[Node]] = {}
        for edge in (each for source in self._machine.reachable for each in self._machine.live[source]):
            entries.setdefault(edge.target, []).append(edge.taken)
        return entries

    def _iterate(self, node: Expr, condition: Node) -> Iterator[tuple[Binary, Node]]:
        """Yield the divisions with their conditions; an operand may be evaluated only if those before it allow it."""
        if isinstance(node, Binary) and _is_division(node):
            yield node, condition
        match node:
            case ex.Logic(operator=operator, operands=operands):
                combine = self._diagrams.both if operator == "and" else self._diagrams.without
                for operand in operands:
                    yield from self._iterate(operand, condition)
                    condition = combine(condition, self._conditions.of_condition(operand))
            case ex.Ternary(test=test, then=then, otherwise=otherwise):
                holds = self._conditions.of_condition(test)
                yield from self._iterate(test, condition)
                yield from self._iterate(then, self._diagrams.both(condition, holds))
                yield from self._iterate(otherwise, self._diagrams.without(condition, holds))
            case ex.Comparison(operators=operators, operands=operands):
                for index, operand in enumerate(operands):
                    if index > 1:
                        before = replace(node, operators=operators[: index - 1], operands=operands[:index])
                        condition = self._diagrams.both(condition, self._conditions.of_condition(before))
                    yield from self._iterate(operand, condition)
            case _:
                for child in ex.children(node):
                    yield from self._iterate(child, condition)


def _is_division(node: Expr) -> bool:
    return isinstance(node, Binary) and node.operator in ("/", "//", "%")
