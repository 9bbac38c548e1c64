"""What a state must be tried with to show that it decides as it should.

A condition of a guard matters where the next state would be another if the condition were always true than if it were
always false (masking MC/DC). Values there, on both sides of each number with which it is compared, show a wrong
operator, a wrong number and a missing condition. The next states of a design are diagrams, so these values are the
difference of two designs.
"""

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import combinations

from vicode.analysis.conditions import Conditions
from vicode.analysis.guards import GuardAnalysis, TestedDecision
from vicode.analysis.interval_diagrams import (
    BEFORE_NAN,
    FALSE,
    Interval,
    IntervalDiagrams,
    Node,
    Position,
    TooLargeError,
)
from vicode.analysis.machines import MachineAnalysis
from vicode.analysis.quantities import NANOSECONDS, Quantity, Value
from vicode.findings import DesignPath
from vicode.model.design import COMMON, DecisionGroup, Design, Guard, Transition
from vicode.model.disabled import disabled_states, is_enabled
from vicode.model.edits import replace_decision
from vicode.model.expressions import BOOL, FLOAT, INT, Comparison, Expr, Logic, Not, Ternary, parse_expression
from vicode.model.traversal import LocatedDecision, iter_decisions

Point = Mapping[int, Position]
"""Where each quantity is: the place just before its value."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionTarget:
    """Values for which the decisions of a state are worth a test.

    Attributes:
        path: The decision that they show; () for staying.
        words: What they show.
        values: The values.
        is_shared: Whether a test in one state is enough, as for the conditions of common transitions.
    """

    path: DesignPath
    words: str
    values: Node
    is_shared: bool = False


def iterate_targets(machine: MachineAnalysis, state: str) -> Iterator[DecisionTarget]:
    """Yield the targets of a state: each decision and staying, conditions with their limits, and the order.

    Raises:
        TooLargeError: A diagram has too many nodes; the following targets are unknown.
    """
    guards, diagrams = machine.guards, machine.guards.conditions.diagrams
    tested = [each for each in (*guards.common, *guards.states[state]) if not isinstance(each.decision, DecisionGroup)]
    for each in tested:
        yield DecisionTarget(path=each.path, words=_describe(each), values=guards.taken(each))
    yield DecisionTarget(path=(), words="no transition is taken", values=machine.staying(state))
    disabled = disabled_states(machine.design)
    for located in iter_decisions(machine.design):
        if located.source in (COMMON, state) and is_enabled(located, disabled):
            yield from _iterate_conditions(machine, state, located)
    for first, second in combinations(tested, 2):
        if _target(first, state) != _target(second, state):
            words = f"{_describe(first)} comes before {_describe(second)}"
            values = diagrams.both(guards.taken(first), second.own)
            yield DecisionTarget(path=first.path, words=words, values=values, is_shared=second.path[0] == "common")


def find_next_states(conditions: Conditions, design: Design, state: str) -> dict[str, Node]:
    """The values for which a state is left, by the next state.

    Raises:
        TooLargeError: A diagram has too many nodes.
    """
    kept = tuple(each for each in design.states if each.name == state or each.disabled)
    guards = GuardAnalysis(replace(design, states=kept), conditions, may_give_up=False)
    found: dict[str, Node] = {}
    for each in (*guards.common, *guards.states[state]):
        if isinstance(each.decision, Transition) and each.decision.to != state:
            taken = guards.taken(each)
            found[each.decision.to] = conditions.diagrams.either(found.get(each.decision.to, FALSE), taken)
    return found


def find_difference(diagrams: IntervalDiagrams, one: Mapping[str, Node], other: Mapping[str, Node]) -> Node:
    """The values for which the next states of two designs differ."""
    found = FALSE
    for state in dict.fromkeys((*one, *other)):
        a, b = one.get(state, FALSE), other.get(state, FALSE)
        found = diagrams.either(found, diagrams.either(diagrams.without(a, b), diagrams.without(b, a)))
    return found


def is_equivalent(machine: MachineAnalysis, changed: Design, path: DesignPath) -> bool:
    """Whether it is proved that a change of one part of a design never leads to another state, nor to other actions."""
    match path:
        case ("states", str(name), *_) if name not in machine.reachable:
            return True
        case ("states", str(name), "transitions", *_):
            states = frozenset({name})
        case ("common", "transitions", *_):
            states = machine.reachable
        case _:
            return changed == machine.design
    guards = machine.guards
    try:
        for state in states:
            one, other = (find_next_states(guards.conditions, each, state) for each in (machine.design, changed))
            difference = find_difference(guards.conditions.diagrams, one, other)
            if guards.prove(difference, may_assume_no_nan=False) is None:
                return False
    except (TooLargeError, RecursionError):
        return False
    return True


def locate(conditions: Conditions, evaluate: Callable[[Expr], Value]) -> Point:
    """Where the quantities are for given values of everything; what is not known is left out."""
    found: dict[int, Position] = {}
    for level, quantity in conditions.quantities.items():
        if quantity.tree is not None:
            value = evaluate(quantity.tree)
            if isinstance(value, str):
                value = conditions.table.elements(quantity.type).index(value.rpartition(".")[2])
            is_ns = quantity.type == NANOSECONDS
            found[level] = _position(round(value * conditions.table.ns_per_unit) if is_ns else value)
        elif len(trees := conditions.computed.trees_of(level)) == 2:
            a, b = map(evaluate, trees)
            assert not isinstance(a, str)
            assert not isinstance(b, str)
            found[level] = _position(math.nan if math.isnan(a) or math.isnan(b) else (a > b) - (a < b))
    return found


def contains(diagrams: IntervalDiagrams, node: Node, point: Point) -> bool:
    """Whether a diagram contains values; False if it tests what is not known."""
    while node > 1:
        level, branches = diagrams.branches(node)
        if level not in point:
            return False
        pieces = list(branches)
        node = pieces[bisect_right([low for (low, _high), _child in pieces], point[level]) - 1][1]
    return node != FALSE


def _position(value: float) -> Position:
    return BEFORE_NAN if math.isnan(value) else (value, 0)


def _describe(each: TestedDecision) -> str:
    return f"to {each.decision.to}" if isinstance(each.decision, Transition) else "stay"


def _target(each: TestedDecision, state: str) -> str:
    return each.decision.to if isinstance(each.decision, Transition) else state


# Conditions


@dataclass(frozen=True, slots=True, kw_only=True)
class _Condition:
    """A condition of a guard: its text and diagram, and the guard in which it is always true and always false."""

    words: str
    values: Node
    always: Guard
    never: Guard


def _iterate_conditions(machine: MachineAnalysis, state: str, located: LocatedDecision) -> Iterator[DecisionTarget]:
    conditions, item = machine.guards.conditions, located.decision
    for condition in _split(conditions, item.guard):
        variants = (
            replace_decision(machine.design, located.path, replace(item, guard=guard))
            for guard in (condition.always, condition.never)
        )
        one, other = (find_next_states(conditions, each, state) for each in variants)
        decisive = find_difference(conditions.diagrams, one, other)
        for words, piece in _pieces(conditions, condition):
            values = conditions.diagrams.both(decisive, piece)
            is_shared = located.source == COMMON
            yield DecisionTarget(path=located.path, words=words, values=values, is_shared=is_shared)


def _split(conditions: Conditions, guard: Guard) -> Iterator[_Condition]:
    if guard.after:
        yield _Condition(
            words=f"after {guard.after}",
            values=conditions.of_guard(Guard(after=guard.after)),
            always=replace(guard, after=""),
            never=replace(guard, after="", when="false"),
        )
    tree = parse_expression(guard.when, conditions.table.scope, BOOL).tree if guard.when else None
    for start, end in _find_atoms(tree) if tree is not None else ():
        text = guard.when[start:end]
        yield _Condition(
            words=text,
            values=conditions.of_guard(Guard(when=text)),
            always=replace(guard, when=f"{guard.when[:start]}true{guard.when[end:]}"),
            never=replace(guard, when=f"{guard.when[:start]}false{guard.when[end:]}"),
        )


def _find_atoms(tree: Expr) -> Iterator[tuple[int, int]]:
    match tree:
        case Not(operand=operand):
            yield from _find_atoms(operand)
        case Logic(operands=operands):
            for each in operands:
                yield from _find_atoms(each)
        case Ternary(test=test, then=then, otherwise=otherwise):
            for each in (test, then, otherwise):
                yield from _find_atoms(each)
        case Comparison(operands=(left, *_)) if left.type == BOOL:
            for each in tree.operands:
                yield from _find_atoms(each)
        case _:
            yield tree.span


def _pieces(conditions: Conditions, condition: _Condition) -> Iterator[tuple[str, Node]]:
    """The limits of a condition, then the cases in which it is true and false."""
    diagrams = conditions.diagrams
    for level, cuts in sorted(diagrams.find_cuts((condition.values,)).items()):
        quantity = conditions.quantities[level]
        if len(conditions.computed.trees_of(level)) == 2:
            # The order of two values.
            yield f"{condition.words}: both are equal", diagrams.test(level, (((0, 0), (0, 1)),))
        if level in conditions.computed or quantity.type not in (INT, FLOAT, NANOSECONDS):
            continue
        for number in sorted({cut for cut, _side in cuts if math.isfinite(cut)}):
            for words, interval in _around(quantity, number):
                yield f"{condition.words}: {words}", diagrams.test(level, (interval,))
    yield f"{condition.words} is true", condition.values
    yield f"{condition.words} is false", diagrams.negate(condition.values)


def _around(quantity: Quantity, number: float) -> Iterator[tuple[str, Interval]]:
    """A number of a comparison and the values next to it; a whole number is the first one after the limit."""
    if quantity.type == FLOAT:
        below, above = math.nextafter(number, -math.inf), math.nextafter(number, math.inf)
        for words, value in (
            (f"just below {number:g}", below),
            (f"{number:g}", number),
            (f"just above {number:g}", above),
        ):
            yield words, ((value, 0), (value, 1))
    elif quantity.type == INT:
        for whole in (int(number) - 1, int(number), int(number) + 1):
            yield f"{whole}", ((whole, 0), (whole + 1, 0))
    else:
        for ns, words in ((int(number) - 1, "1 ns before"), (int(number), "exactly then")):
            yield words, ((ns, 0), (ns + 1, 0))
