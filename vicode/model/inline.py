"""Puts the states of a component back in place of the state that requires it, the reverse of `vicode.model.extract`.

The inlined design is accepted if extracting the states again gives the caller and the component. The behavior is then
the same by the law of extraction, whatever was edited in the component, and no second analysis is needed.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from vicode.model.decisions import retarget_all
from vicode.model.design import Assign, Call, Design, State, Transition, Use
from vicode.model.edits import replace_in_frames, unique_name
from vicode.model.extract import extract_component
from vicode.model.lowering import is_lowered
from vicode.model.traversal import iter_actions, iter_transitions


@dataclass(frozen=True, slots=True, kw_only=True)
class Inlining:
    """The design with the states of a component, or why there is none; `names` are their names by the old ones."""

    caller: Design
    names: Mapping[str, str] = field(default_factory=dict)
    problem: str = ""


def inlined_use(design: Design, state: str) -> Use | None:
    """The component that `inline_component` would put in place of a state: the last one that it requires."""
    found = design.state(state)
    return design.use(found.requires[-1]) if found is not None and found.requires else None


def inline_component(design: Design, state: str, component: Design) -> Inlining:
    """Replace a state that requires a component by the states of this component."""
    call, use = design.state(state), inlined_use(design, state)
    assert call is not None
    assert use is not None
    problem = _find_problem(design, use.alias, component)
    if problem:
        return Inlining(caller=design, problem=problem)
    targets = _targets(call, use.alias, component)
    has_start = _is_start(component)
    ends = {each.name for each in component.states if each.final}
    first = component.state(component.initial)
    assert first is not None
    entry = _only_target(first) if has_start else first.name
    inside = [each for each in component.states if each.name not in ends and not (has_start and each is first)]
    names: dict[str, str] = {}
    for each in inside:
        names[each.name] = unique_name(
            each.name, {*(other.name for other in design.states if other is not call), *names.values()}
        )
    states = tuple(
        replace(
            each,
            name=names[each.name],
            requires=(*call.requires[:-1], *each.requires),
            transitions=retarget_all(each.transitions, names | targets),
        )
        for each in inside
    )
    inlined = _inlined(design, call, states, component, names[entry])
    again = extract_component(inlined, [each.name for each in states], component.component)
    if again.problems or _canonical(again.caller, again.component, {}) != _canonical(design, component, names):
        more = f"{state} or {component.component} does more than Extract makes"
        return Inlining(caller=design, problem=f"the behavior would change: {(*again.problems, more)[0]}")
    return Inlining(caller=inlined, names=names)


def _find_problem(design: Design, alias: str, component: Design) -> str:
    name = component.component
    users = [each.name for each in design.states if alias in each.requires]
    called = [
        each.state for each in iter_actions(design) if isinstance(each.action, Call) and each.action.alias == alias
    ]
    if len(users) + len(called) > 1:
        return f"{name} is used in several places: {', '.join(dict.fromkeys((*users, *called)))}"
    for key in ("frequency_hz", "resume", "arithmetic", "time_unit"):
        if getattr(design, key) != getattr(component, key):
            return f"{name} and {design.component} differ in '{key.removesuffix('_hz')}'"
    if is_lowered(design) or is_lowered(component):
        whose = name if is_lowered(component) else design.component
        return f"{whose} has latches, interrupts, a competence, layers or failed states"
    if component.common.actions or component.common.transitions:
        return f"{name} has a common section"
    if component.properties or component.parameters:
        return f"{name} has {'properties' if component.properties else 'parameters'}"
    return "" if component.state(component.initial) else f"{name} has no initial state"


def _is_start(component: Design) -> bool:
    """Whether the component begins in a state that only leads to another one."""
    first = component.state(component.initial)
    if first is None or len(first.transitions) != 1:
        return False
    only = Transition(to=_only_target(first))
    return _plain(first) == State(name=first.name, transitions=(only,)) and not any(
        isinstance(each.decision, Transition) and each.decision.to == first.name for each in iter_transitions(component)
    )


def _only_target(state: State) -> str:
    only = state.transitions[0]
    return only.to if isinstance(only, Transition) else ""


def _targets(call: State, alias: str, component: Design) -> dict[str, str]:
    """The states that the calling state enters, by the final states of the component."""
    found: dict[str, str] = {}
    for end in (each for each in component.states if each.final):
        flags = [name for name, text in _assigned(end) if text == "True"]
        wanted = f"done({alias}) and {alias}.{flags[0]}" if flags else f"done({alias})"
        for each in call.transitions:
            if isinstance(each, Transition) and each.guard.when == wanted:
                found[end.name] = each.to
    return found if len(found) == len(call.transitions) else {}


def _assigned(end: State) -> list[tuple[str, str]]:
    return [pair for action in end.enter if isinstance(action, Assign) for pair in action.values]


def _inlined(design: Design, call: State, states: tuple[State, ...], component: Design, entry: str) -> Design:
    others = [replace(each, transitions=retarget_all(each.transitions, {call.name: entry})) for each in design.states]
    place = design.states.index(call)
    known = {each.name for _section, each in design.declarations()}
    flags = {name for end in component.states if end.final for name, _text in _assigned(end)}
    added = (each for _section, each in component.declarations() if each.name not in known | flags)
    alias = call.requires[-1]
    uses = [use for use in design.uses if use.alias != alias]
    uses += [use for use in component.uses if design.use(use.alias) is None]
    return replace(
        design,
        uses=tuple(uses),
        variables=(*design.variables, *added),
        initial=entry if design.initial == call.name else design.initial,
        states=(*others[:place], *states, *others[place + 1 :]),
        frames=(*replace_in_frames(design.frames, {call.name: tuple(each.name for each in states)}), *component.frames),
    )


def _canonical(caller: Design, component: Design, names: Mapping[str, str]) -> tuple[object, ...]:
    """Both designs without layout, orders of declarations, and the names of states that Extract chooses."""
    uses = {each.name: inlined_use(caller, each.name) for each in caller.states}
    call = next(each for each in caller.states if (use := uses[each.name]) and use.component == component.component)
    ends = {end: f"end in {to}" for end, to in _targets(call, call.requires[-1], component).items()}
    start = {component.initial: "start"} if _is_start(component) else {}
    return _behavior(caller, {call.name: "call"}), _behavior(component, {**names, **ends, **start})


def _behavior(design: Design, names: Mapping[str, str]) -> tuple[object, ...]:
    states = {
        names.get(state.name, state.name): replace(
            _plain(state), name="", transitions=retarget_all(state.transitions, names)
        )
        for state in design.states
    }
    components = {use.alias: use.component for use in design.uses}
    declared = {(section, replace(each, doc="", unit="", range=None)) for section, each in design.declarations()}
    return components, declared, names.get(design.initial, design.initial), states


def _plain(state: State) -> State:
    return replace(state, id="", doc="", at=None, color="")
