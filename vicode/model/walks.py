"""Questions to a design: its decisions, expressions and code, each with the path that leads there."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.findings import Path
from vicode.model.design import (
    COMMON,
    Action,
    Assign,
    Call,
    Code,
    Decision,
    Declaration,
    Design,
    Group,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Located:
    """A decision at its place: `source` is a state's name or COMMON.

    `groups` are the groups around it, outermost first, each with whether the decision is on its `then` side.
    """

    source: str
    path: Path
    decision: Decision
    groups: tuple[tuple[Group, bool], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Text:
    """A piece of text at its place.

    `expected` is the type its place asks for, "" for any; `state` the state it belongs to, "" for none.
    """

    path: Path
    text: str
    expected: str = ""
    state: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlacedAction:
    """An action at its place; `phase` is enter, actions, modulates or leave; `state` a name or COMMON."""

    state: str
    phase: str
    path: Path
    action: Action


@dataclass(frozen=True, slots=True, kw_only=True)
class PlacedCode:
    """Hand-written code at its place; `role` is module, members, action or predicate; `id` if it was given one."""

    path: Path
    role: str
    code: Code
    state: str = ""
    id: str = ""


def walk_decisions(design: Design) -> Iterator[Located]:
    """Every decision, groups before what they hold: the common ones first, then state by state."""
    yield from _walk_items(design.common.transitions, COMMON, ("common", "transitions"), ())
    for state in design.states:
        yield from walk_decisions_of(state)


def walk_decisions_of(state: State) -> Iterator[Located]:
    """The decisions of one state."""
    yield from _walk_items(state.transitions, state.name, ("states", state.name, "transitions"), ())


def walk_transitions(design: Design) -> Iterator[Located]:
    """Only the transitions among the decisions."""
    return (located for located in walk_decisions(design) if isinstance(located.decision, Transition))


def _walk_items(
    items: tuple[Decision, ...], source: str, path: Path, groups: tuple[tuple[Group, bool], ...]
) -> Iterator[Located]:
    for index, item in enumerate(items):
        here = (*path, index)
        yield Located(source=source, path=here, decision=item, groups=groups)
        if isinstance(item, Group):
            yield from _walk_items(item.then, source, (*here, "then"), (*groups, (item, True)))
            yield from _walk_items(item.otherwise, source, (*here, "else"), (*groups, (item, False)))


def decision_at(design: Design, path: Path) -> Located | None:
    """The decision a path leads to."""
    match path:
        case ("states", str(name), "transitions", *_):
            near = (located for state in design.states if state.name == name for located in walk_decisions_of(state))
        case _:
            common = design.common.transitions
            near = (located for located in _walk_items(common, COMMON, ("common", "transitions"), ()))
    return next((located for located in near if located.path == path), None)


def walk_actions(design: Design) -> Iterator[PlacedAction]:
    """Every action: the common ones, then state by state enter, actions, modulates, leave."""
    for index, action in enumerate(design.common.actions):
        yield PlacedAction(state=COMMON, phase="actions", path=("common", "actions", index), action=action)
    for state in design.states:
        for phase in ("enter", "actions", "leave"):
            for index, action in enumerate(getattr(state, phase)):
                path = ("states", state.name, phase, index)
                yield PlacedAction(state=state.name, phase=phase, path=path, action=action)
        for call in state.modulates:
            where: Path = ("states", state.name, "modulates", call.alias)
            yield PlacedAction(state=state.name, phase="modulates", path=where, action=call)


def walk_expressions(design: Design) -> Iterator[Text]:
    """Every expression: initial values, guards, values of `set`, parameters of calls.

    The types of set and with values depend on the declarations: `expected` is "" there.
    """
    for section, declaration in design.declarations():
        yield from _initial(section, declaration)
    for located in walk_decisions(design):
        guard: Guard = located.decision.guard
        state = "" if located.source == COMMON else located.source
        if guard.when:
            yield Text(path=(*located.path, "when"), text=guard.when, expected="bool", state=state)
        if guard.after:
            yield Text(path=(*located.path, "after"), text=guard.after, expected="float", state=state)
    for placed in walk_actions(design):
        yield from _action_texts(placed)


def _initial(section: str, declaration: Declaration) -> Iterator[Text]:
    key = "default" if section == "parameters" else "initial"
    if declaration.initial:
        yield Text(path=(section, declaration.name, key), text=declaration.initial, expected=declaration.type)


def _action_texts(placed: PlacedAction) -> Iterator[Text]:
    state = "" if placed.state == COMMON else placed.state
    match placed.action:
        case Assign(values=values):
            for name, text in values:
                yield Text(path=(*placed.path, "set", name), text=text, state=state)
        case Call(arguments=arguments):
            middle = () if placed.phase == "modulates" else ("with",)
            for name, text in arguments:
                yield Text(path=(*placed.path, *middle, name), text=text, state=state)


def walk_code(design: Design) -> Iterator[PlacedCode]:
    """Every piece of hand-written code."""
    if design.module.texts:
        yield PlacedCode(path=("module",), role="module", code=design.module)
    if design.members.texts:
        yield PlacedCode(path=("members",), role="members", code=design.members)
    for placed in walk_actions(design):
        if isinstance(placed.action, RunCode):
            path = (*placed.path, "code")
            yield PlacedCode(path=path, role="action", code=placed.action.code, state=placed.state, id=placed.action.id)
    for located in walk_decisions(design):
        code = located.decision.guard.code
        if code is not None:
            path = (*located.path, "code")
            yield PlacedCode(path=path, role="predicate", code=code, state=located.source, id=located.decision.id)


def has_code(state: State) -> bool:
    """Whether a state holds hand-written code, in its actions or its guards."""
    actions = (*state.enter, *state.actions, *state.leave)
    return any(isinstance(action, RunCode) for action in actions) or any(
        located.decision.guard.code is not None for located in walk_decisions_of(state)
    )


def always_holds(decision: Decision) -> bool:
    """Whether nothing after it can be reached.

    So it is for a transition or stay without guard, and for a group that ends on every way.
    """
    if isinstance(decision, Transition | Stay):
        return decision.guard.is_empty
    then_ends = any(always_holds(item) for item in decision.then)
    else_ends = any(always_holds(item) for item in decision.otherwise)
    return then_ends and (decision.guard.is_empty or else_ends)
