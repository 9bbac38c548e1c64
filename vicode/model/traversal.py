"""Traversal of the decisions, actions, expressions and code of a design, with their paths."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from vicode.findings import DesignPath
from vicode.model.design import (
    COMMON,
    Action,
    Assign,
    Call,
    Code,
    Competence,
    CompetenceStep,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    Interrupt,
    InvariantProperty,
    Latch,
    Layer,
    ReachProperty,
    RunCode,
    State,
    Stay,
    Transition,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class LocatedDecision:
    """A decision with its path; `source` is a state name or COMMON.

    `groups` are the enclosing groups, outermost first, each with whether the decision is in its `then` branch.
    """

    source: str
    path: DesignPath
    decision: Decision
    groups: tuple[tuple[DecisionGroup, bool], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class LocatedExpression:
    """An expression with its path.

    `expected` is the expected type, "" for any; `state` the state it belongs to, "" for none.
    """

    path: DesignPath
    text: str
    expected: str = ""
    state: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class LocatedAction:
    """An action with its path; `phase` is enter, actions, modulates or leave; `state` a name or COMMON."""

    state: str
    phase: str
    path: DesignPath
    action: Action


@dataclass(frozen=True, slots=True, kw_only=True)
class LocatedCode:
    """Hand-written code with its path; `role` is module, members, action or predicate."""

    path: DesignPath
    role: str
    code: Code
    state: str = ""


def iter_decisions(design: Design) -> Iterator[LocatedDecision]:
    """Yield all decisions, common ones first. Groups precede their content."""
    yield from _iter_items(design.common.transitions, COMMON, ("common", "transitions"), ())
    for state in design.states:
        yield from iter_state_decisions(state)


def iter_state_decisions(state: State) -> Iterator[LocatedDecision]:
    yield from _iter_items(state.transitions, state.name, ("states", state.name, "transitions"), ())


def iter_transitions(design: Design) -> Iterator[LocatedDecision]:
    return (located for located in iter_decisions(design) if isinstance(located.decision, Transition))


def _iter_items(
    items: tuple[Decision, ...], source: str, path: DesignPath, groups: tuple[tuple[DecisionGroup, bool], ...]
) -> Iterator[LocatedDecision]:
    for index, item in enumerate(items):
        here = (*path, index)
        yield LocatedDecision(source=source, path=here, decision=item, groups=groups)
        if isinstance(item, DecisionGroup):
            yield from _iter_items(item.then, source, (*here, "then"), (*groups, (item, True)))
            yield from _iter_items(item.otherwise, source, (*here, "else"), (*groups, (item, False)))


def find_decision(design: Design, path: DesignPath) -> LocatedDecision | None:
    match path:
        case ("states", str(name), "transitions", *_):
            candidates = (
                located for state in design.states if state.name == name for located in iter_state_decisions(state)
            )
        case _:
            common = design.common.transitions
            candidates = (located for located in _iter_items(common, COMMON, ("common", "transitions"), ()))
    return next((located for located in candidates if located.path == path), None)


def iter_actions(design: Design) -> Iterator[LocatedAction]:
    """Yield all actions: common ones, then enter, actions, leave and modulates of each state."""
    for index, action in enumerate(design.common.actions):
        yield LocatedAction(state=COMMON, phase="actions", path=("common", "actions", index), action=action)
    for state in design.states:
        for phase in ("enter", "actions", "leave"):
            for index, action in enumerate(getattr(state, phase)):
                path = ("states", state.name, phase, index)
                yield LocatedAction(state=state.name, phase=phase, path=path, action=action)
        for call in state.modulates:
            where: DesignPath = ("states", state.name, "modulates", call.alias)
            yield LocatedAction(state=state.name, phase="modulates", path=where, action=call)


def iter_expressions(design: Design) -> Iterator[LocatedExpression]:
    """Yield all expressions: initial values, guards, assigned values, arguments of calls, properties.

    The types of assigned values and arguments depend on declarations, so `expected` is "".
    """
    for section, declaration in design.declarations():
        yield from _iter_initial_values(section, declaration)
    for located in iter_decisions(design):
        guard: Guard = located.decision.guard
        state = "" if located.source == COMMON else located.source
        if guard.when:
            yield LocatedExpression(path=(*located.path, "when"), text=guard.when, expected="bool", state=state)
        if guard.after:
            yield LocatedExpression(path=(*located.path, "after"), text=guard.after, expected="float", state=state)
    for placed in iter_actions(design):
        yield from _iter_action_expressions(placed)
    yield from iter_construct_expressions(design)
    for index, promised in enumerate(design.properties):
        if isinstance(promised, ReachProperty) and promised.within:
            yield LocatedExpression(path=("properties", index, "within"), text=promised.within, expected="float")
        if isinstance(promised, InvariantProperty):
            yield LocatedExpression(path=("properties", index, "holds"), text=promised.holds, expected="bool")


Construct = Latch | Interrupt | Competence | CompetenceStep | Layer
"""What other states, transitions and variables are derived from (`vicode.model.lowering`)."""

_CONSTRUCT_EXPRESSIONS: Mapping[type, Mapping[str, str]] = {
    Latch: {"on": "bool", "off": "bool", "hold": "float"},
    Interrupt: {"when": "bool", "until": "bool", "every": "float"},
    Competence: {"goal": "bool"},
    CompetenceStep: {"when": "bool"},
    Layer: {"when": "bool", "hold": "float"},
}


def iter_constructs(design: Design) -> Iterator[tuple[DesignPath, Construct]]:
    """Yield the latches, interrupts, competence with its steps, and layers with their paths."""
    for latch in design.latches:
        yield ("latches", latch.name), latch
    for index, interrupt in enumerate(design.interrupts):
        yield ("interrupts", index), interrupt
    if design.competence is not None:
        yield ("competence",), design.competence
        for step in design.competence.steps:
            yield ("competence", "steps", step.name), step
    for layer in design.layers:
        yield ("layers", layer.name), layer


def iter_construct_expressions(design: Design) -> Iterator[LocatedExpression]:
    """Yield the conditions and times of constructs."""
    for path, construct in iter_constructs(design):
        for name, expected in _CONSTRUCT_EXPRESSIONS[type(construct)].items():
            text = getattr(construct, name)
            if text:
                key = "for" if isinstance(construct, Layer) and name == "hold" else name
                yield LocatedExpression(path=(*path, key), text=text, expected=expected)


def _iter_initial_values(section: str, declaration: Declaration) -> Iterator[LocatedExpression]:
    key = "default" if section == "parameters" else "initial"
    if declaration.initial:
        yield LocatedExpression(
            path=(section, declaration.name, key), text=declaration.initial, expected=declaration.type
        )


def _iter_action_expressions(placed: LocatedAction) -> Iterator[LocatedExpression]:
    state = "" if placed.state == COMMON else placed.state
    match placed.action:
        case Assign(values=values):
            for name, text in values:
                yield LocatedExpression(path=(*placed.path, "set", name), text=text, state=state)
        case Call(arguments=arguments):
            middle = () if placed.phase == "modulates" else ("with",)
            for name, text in arguments:
                yield LocatedExpression(path=(*placed.path, *middle, name), text=text, state=state)


def iter_code(design: Design) -> Iterator[LocatedCode]:
    if design.module.texts:
        yield LocatedCode(path=("module",), role="module", code=design.module)
    if design.members.texts:
        yield LocatedCode(path=("members",), role="members", code=design.members)
    for placed in iter_actions(design):
        if isinstance(placed.action, RunCode):
            path = (*placed.path, "code")
            yield LocatedCode(path=path, role="action", code=placed.action.code, state=placed.state)
    for located in iter_decisions(design):
        code = located.decision.guard.code
        if code is not None:
            path = (*located.path, "code")
            yield LocatedCode(path=path, role="predicate", code=code, state=located.source)


def has_code(state: State) -> bool:
    """Return whether the actions or guards of a state contain hand-written code."""
    actions = (*state.enter, *state.actions, *state.leave)
    return any(isinstance(action, RunCode) for action in actions) or any(
        located.decision.guard.code is not None for located in iter_state_decisions(state)
    )


def is_exhaustive(decision: Decision) -> bool:
    """Return whether later decisions are never tested.

    This holds for a transition or stay without a guard, and for a group whose branches are all exhaustive.
    """
    if isinstance(decision, Transition | Stay):
        return decision.guard.is_empty
    then_ends = any(is_exhaustive(item) for item in decision.then)
    else_ends = any(is_exhaustive(item) for item in decision.otherwise)
    return then_ends and (decision.guard.is_empty or else_ends)
