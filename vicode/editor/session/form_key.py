"""Structure keys: the parts of an item that determine which fields its form has."""

from collections.abc import Iterable

from vicode.editor.view import ItemRef, parse_transition_key
from vicode.findings import DesignPath
from vicode.model.design import Action, Call, Decision, DecisionGroup, Design
from vicode.model.traversal import find_decision, iter_decisions

MAX_STATES_IN_MENU = 60
"""With more states, the target of a transition is a text field with completion instead of a menu."""


def form_structure_key(design: Design, item: ItemRef | None) -> object:
    """A value that changes exactly when the form of `item` must be rebuilt (None: the form of the design)."""
    uses = tuple((use.alias, use.component) for use in design.uses)
    is_crowded = len(design.states) > MAX_STATES_IN_MENU
    match item:
        case ItemRef(kind="states", id=name):
            state = design.state(name)
            if state is None:
                return None
            phases = (_actions(state.enter), _actions(state.actions), _actions(state.leave))
            calls = tuple(call.alias for call in state.modulates)
            return (uses, is_crowded, phases, calls, state.transitions)
        case ItemRef(kind="transitions", id=key):
            located = find_decision(design, parse_transition_key(key))
            return located and (located.source, _decision(located.decision))
        case ItemRef(kind="components" | "links", id=key):
            return (uses, key)
        case ItemRef(kind="common"):
            return (uses, is_crowded, _actions(design.common.actions), design.common.transitions)
        case _:
            return (uses, is_crowded, _declarations(design), _actions(design.common.actions), design.common.transitions)


def has_same_structure(before: Design, now: Design, path: DesignPath) -> bool:
    """Whether nothing was added, removed or moved at a path; one declaration may have been renamed."""
    match path:
        case (("parameters" | "outputs" | "variables") as section, *_):
            old, new = ([declaration.name for declaration in getattr(design, section)] for design in (before, now))
            return len(old) == len(new) and sum(was != name for was, name in zip(old, new, strict=True)) <= 1
        case _:
            return _order_around(before, path) == _order_around(now, path)


def _order_around(design: Design, path: DesignPath) -> object:
    """The lists that the indices in a path refer to."""
    match path:
        case ("states", name, ("enter" | "actions" | "leave") as phase, *_):
            state = design.state(str(name))
            return state and _actions(getattr(state, phase))
        case ("common", "actions", *_):
            return _actions(design.common.actions)
        case ("states" | "common", *_):
            located = ((at.path, type(at.decision), getattr(at.decision, "to", "")) for at in iter_decisions(design))
            return tuple(decision for decision in located if decision[0][:2] == path[:2])
        case _:
            return None


def _actions(actions: Iterable[Action]) -> tuple[tuple[type, str], ...]:
    return tuple((type(action), action.alias if isinstance(action, Call) else "") for action in actions)


def _decision(decision: Decision) -> object:
    has_code = decision.guard.code is not None
    if isinstance(decision, DecisionGroup):
        return (has_code, decision.then, decision.otherwise)
    return (type(decision), has_code)


def _declarations(design: Design) -> tuple[object, ...]:
    """The number of declarations and of function arguments; their names and values do not affect the fields."""
    functions = (None if output.arguments is None else len(output.arguments) for output in design.outputs)
    return (len(design.parameters), tuple(functions), len(design.variables))
