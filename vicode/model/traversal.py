"""Questions to a design: its decisions, expressions and code, each with the path that leads there."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.findings import DesignPath
from vicode.model.design import (
    COMMON,
    Action,
    Assign,
    Call,
    Code,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class LocatedDecision:
    """A decision at its place: `source` is a state's name or COMMON.

    `groups` are the groups around it, outermost first, each with whether the decision is on its `then` side.
    """

    source: str
    path: DesignPath
    decision: Decision
    groups: tuple[tuple[DecisionGroup, bool], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class LocatedExpression:
    """A piece of text at its place.

    `expected` is the type its place asks for, "" for any; `state` the state it belongs to, "" for none.
    """

    path: DesignPath
    text: str
    expected: str = ""
    state: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class LocatedAction:
    """An action at its place; `phase` is enter, actions, modulates or leave; `state` a name or COMMON."""

    state: str
    phase: str
    path: DesignPath
    action: Action


@dataclass(frozen=True, slots=True, kw_only=True)
class LocatedCode:
    """Hand-written code at its place; `role` is module, members, action or predicate; `id` if it was given one."""

    path: DesignPath
    role: str
    code: Code
    state: str = ""
    id: str = ""


def iter_decisions(design: Design) -> Iterator[LocatedDecision]:
    """Every decision, groups before what they hold: the common ones first, then state by state."""
    yield from _iter_items(design.common.transitions, COMMON, ("common", "transitions"), ())
    for state in design.states:
        yield from iter_state_decisions(state)


def iter_state_decisions(state: State) -> Iterator[LocatedDecision]:
    """The decisions of one state."""
    yield from _iter_items(state.transitions, state.name, ("states", state.name, "transitions"), ())


def iter_transitions(design: Design) -> Iterator[LocatedDecision]:
    """Only the transitions among the decisions."""
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
    """The decision a path leads to."""
    match path:
        case ("states", str(name), "transitions", *_):
            near = (located for state in design.states if state.name == name for located in iter_state_decisions(state))
        case _:
            common = design.common.transitions
            near = (located for located in _iter_items(common, COMMON, ("common", "transitions"), ()))
    return next((located for located in near if located.path == path), None)


def iter_actions(design: Design) -> Iterator[LocatedAction]:
    """Every action: the common ones, then state by state enter, actions, modulates, leave."""
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
    """Every expression: initial values, guards, values of `set`, parameters of calls.

    The types of set and with values depend on the declarations: `expected` is "" there.
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
    """Every piece of hand-written code."""
    if design.module.texts:
        yield LocatedCode(path=("module",), role="module", code=design.module)
    if design.members.texts:
        yield LocatedCode(path=("members",), role="members", code=design.members)
    for placed in iter_actions(design):
        if isinstance(placed.action, RunCode):
            path = (*placed.path, "code")
            yield LocatedCode(
                path=path, role="action", code=placed.action.code, state=placed.state, id=placed.action.id
            )
    for located in iter_decisions(design):
        code = located.decision.guard.code
        if code is not None:
            path = (*located.path, "code")
            yield LocatedCode(path=path, role="predicate", code=code, state=located.source, id=located.decision.id)


def has_code(state: State) -> bool:
    """Whether a state holds hand-written code, in its actions or its guards."""
    actions = (*state.enter, *state.actions, *state.leave)
    return any(isinstance(action, RunCode) for action in actions) or any(
        located.decision.guard.code is not None for located in iter_state_decisions(state)
    )


def is_exhaustive(decision: Decision) -> bool:
    """Whether nothing after it can be reached.

    So it is for a transition or stay without guard, and for a group that ends on every way.
    """
    if isinstance(decision, Transition | Stay):
        return decision.guard.is_empty
    then_ends = any(is_exhaustive(item) for item in decision.then)
    else_ends = any(is_exhaustive(item) for item in decision.otherwise)
    return then_ends and (decision.guard.is_empty or else_ends)
