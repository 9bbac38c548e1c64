"""Proves that a condition holds after each step of a component, by induction.

The condition holds after the entry into the initial state, and a step from which it would not hold is impossible if it
held before: the assignments of the step are substituted into the condition, which turns it into a condition on the
values before the step. What a call may change in between is free.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import count

from vicode.analysis.guards import Basis
from vicode.analysis.interval_diagrams import FALSE, TRUE, Node, TooLargeError
from vicode.analysis.machines import MachineAnalysis
from vicode.analysis.quantities import Value, initial_value
from vicode.model.design import Action, Assign, Call, Design, RunCode, State
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    Boolean,
    Done,
    ElapsedTime,
    EnumElement,
    Expr,
    Minus,
    Not,
    Number,
    OutputRef,
    Scope,
    ScopeSymbolKind,
    StatusFlag,
    Variable,
    map_tree,
    parse_expression,
    walk,
)

_NO_SPAN = (0, 0)
_OWN = (ScopeSymbolKind.VARIABLE, ScopeSymbolKind.OUTPUT)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Step:
    """A step: the values for which it is taken, its actions, whether it enters a state.

    It is disturbed if other components are stepped or set in it, whose outputs then differ from what its guards read.
    """

    taken: Node
    actions: tuple[Action, ...]
    is_entry: bool
    is_disturbed: bool


def prove_invariant(machine: MachineAnalysis, condition: str) -> Basis | None:
    """Prove that a condition holds after each step; None if that was not possible.

    Args:
        machine: The machine of the design.
        condition: An expression in the names of the design.
    """
    conditions = machine.guards.conditions
    parsed = parse_expression(condition, conditions.table.scope, BOOL)
    if parsed.tree is None or parsed.diagnostics or _has_code(machine.design):
        return None
    conditions.diagrams.begin_question()
    try:
        return _Induction(machine, parsed.tree).prove()
    except (TooLargeError, RecursionError):
        return None


def _has_code(design: Design) -> bool:
    """Whether hand-written code may set any value."""
    actions = (*design.common.actions, *(each for state in design.states for each in _all_actions(state)))
    return bool(design.members.texts) or any(isinstance(each, RunCode) for each in actions)


def _all_actions(state: State) -> tuple[Action, ...]:
    return (*state.enter, *state.all_actions, *state.leave)


class _Induction:
    def __init__(self, machine: MachineAnalysis, condition: Expr) -> None:
        self._machine = machine
        self._design = machine.design
        self._guards = machine.guards
        self._condition = condition
        self._steps = count(1)
        # Inputs and times before the step are not those of the step before.
        is_about_own_values = all(
            not isinstance(each, OutputRef | ElapsedTime | StatusFlag | Done)
            and (not isinstance(each, Variable) or each.kind in (*_OWN, ScopeSymbolKind.CONSTANT))
            for each in walk(condition)
        )
        constants = self._guards.conditions.table.constants
        has_tuned = any(
            isinstance(each, Variable) and each.kind == ScopeSymbolKind.CONSTANT and each.name not in constants
            for each in walk(condition)
        )
        self._is_about_own_values = is_about_own_values and not has_tuned
        self._held_before = self._guards.conditions.of_condition(condition) if self._is_about_own_values else TRUE

    def prove(self) -> Basis | None:
        if self._design.frequency_hz and not self._is_about_own_values:
            # Inputs also change in iterations in which the component does not work.
            return None
        facts: dict[str, None] = {}
        no_nan = False
        for node in (self._broken_at_start(), *map(self._broken_by, self._list_steps())):
            basis = self._guards.prove(node)
            if basis is None:
                return None
            facts |= dict.fromkeys(basis.facts)
            no_nan = no_nan or basis.no_nan
        return Basis(facts=tuple(facts), no_nan=no_nan)

    def _list_steps(self) -> Iterator[_Step]:
        """The steps of all states that may be active, and starts after the first one."""
        design = self._design
        initial = design.state(design.initial)
        if initial is not None:
            yield _make_step(TRUE, initial.enter, is_entry=True)
        for state in design.states:
            if state.name not in self._machine.reachable:
                continue
            actions = (*design.common.actions, *state.all_actions)
            yield _make_step(self._machine.staying(state.name), actions, is_entry=False)
            for edge in self._machine.live_in(state.name):
                target = design.state(edge.target)
                if target is not None:
                    actions = (*state.leave, *target.enter, *design.common.actions, *target.all_actions)
                    required = set(target.requires) - set(state.requires)
                    yield _make_step(edge.taken, actions, is_entry=True, required=required)

    def _broken_at_start(self) -> Node:
        """The condition is false after the initial state was entered with the initial values."""
        scope, constants = self._guards.conditions.table.scope, self._guards.conditions.table.constants
        initial = self._design.state(self._design.initial)
        step = _make_step(TRUE, initial.enter if initial else (), is_entry=True)
        values: dict[str, Expr] = {}
        for declaration in (*self._design.variables, *self._design.outputs):
            value = initial_value(declaration, scope, constants)
            if value is not None:
                values[declaration.name] = _literal(value, scope.type_of(declaration))
        return self._of(map_tree(self._before(step), partial(_substituted, values=values)))

    def _broken_by(self, step: _Step) -> Node:
        """The condition held, the step is taken, and the condition is false after it."""
        diagrams = self._guards.conditions.diagrams
        assumed = diagrams.both(step.taken, self._held_before)
        return FALSE if assumed == FALSE else diagrams.both(assumed, self._of(self._before(step)))

    def _of(self, tree: Expr) -> Node:
        return self._guards.conditions.of_condition(Not(operand=tree, span=_NO_SPAN))

    def _before(self, step: _Step) -> Expr:
        """The condition after a step as a condition on the values before it."""
        number = next(self._steps)
        tree = self._condition
        for action in reversed(step.actions):
            if isinstance(action, Assign):
                for name, text in reversed(action.values):
                    value = self._assigned(name, text)
                    if value is not None:
                        tree = map_tree(tree, partial(_substituted, values={name: value}))
        return map_tree(tree, partial(_after_calls, step=step, number=number))

    def _assigned(self, name: str, text: str) -> Expr | None:
        """The tree of an assigned value; None if a variable of another component is set."""
        scope: Scope = self._guards.conditions.table.scope
        symbol = scope.symbols.get(name)
        if symbol is None or symbol.kind not in _OWN:
            return None
        parsed = parse_expression(text, scope, symbol.type)
        if parsed.tree is None or parsed.diagnostics:
            # It may be any value, as the result of an unknown function is.
            return OutputRef(alias="", output=name, arguments=(), type=symbol.type, span=_NO_SPAN)
        return parsed.tree


def _make_step(
    taken: Node, actions: Sequence[Action], *, is_entry: bool, required: Sequence[str] | set[str] = ()
) -> _Step:
    is_disturbed = bool(required) or any(
        isinstance(each, Call) or (isinstance(each, Assign) and any("." in name for name, _text in each.values))
        for each in actions
    )
    return _Step(taken=taken, actions=tuple(actions), is_entry=is_entry, is_disturbed=is_disturbed)


def _substituted(node: Expr, values: dict[str, Expr]) -> Expr:
    return values.get(node.name, node) if isinstance(node, Variable) and node.kind in _OWN else node


def _after_calls(node: Expr, step: _Step, number: int) -> Expr:
    """What a step reads after its actions: outputs may differ from those that its guards read."""
    match node:
        case ElapsedTime(kind="state") if step.is_entry:
            return Number(value=0.0, type=FLOAT, span=_NO_SPAN)
        case OutputRef() if step.is_disturbed:
            marker = ("", Number(value=number, type="int", span=_NO_SPAN))
            return replace(node, arguments=(*(node.arguments or ()), marker))
        case Done() | StatusFlag():
            return OutputRef(
                alias="", output=f"{type(node).__name__}{number}", arguments=(), type=node.type, span=_NO_SPAN
            )
        case _:
            return node


def _literal(value: Value, type_: str) -> Expr:
    if isinstance(value, bool):
        return Boolean(value=value, span=_NO_SPAN)
    if isinstance(value, str):
        return EnumElement(element=value.rpartition(".")[2], type=type_, span=_NO_SPAN)
    number = Number(value=abs(value), type=type_, span=_NO_SPAN)
    return Minus(operand=number, type=type_, span=_NO_SPAN) if value < 0 else number
