"""Interrupts: transitions from each interrupted state to the state that handles it, and back.

The first ones of the list are the most urgent: the states of earlier interrupts are not interrupted by later ones. To
resume, each state sets a number, by which the handling state finds the way back.
"""

import re
from collections.abc import Iterable
from dataclasses import replace

from vicode.model.design import (
    Assign,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    Interrupt,
    State,
    Transition,
)
from vicode.model.disabled import disabled_states, is_enabled
from vicode.model.lowering.additions import (
    NOW,
    add_first_action,
    add_time,
    add_variables,
    change_state,
    names_of,
    negated,
    since_restart,
)
from vicode.model.names import snake_case
from vicode.model.traversal import iter_state_decisions

_END = r"(done\s*\(\s*\w+\s*\)|action_done)"
_ENDS = re.compile(rf"{_END}(\s+and\s+{_END})*")


def fits_pattern(name: str, pattern: str) -> bool:
    """Whether a name fits a pattern, in which `*` stands for any text."""
    return re.fullmatch(".*".join(map(re.escape, pattern.split("*"))), name, re.DOTALL) is not None


def lower_interrupts(design: Design) -> Design:
    """Add the transitions of all interrupts, those of the most urgent one first."""
    design = _add_variables(design)
    for number in reversed(range(len(design.interrupts))):
        interrupt = design.interrupts[number]
        states = interrupted_states(design, number)
        if states and interrupt.when:
            design = _lower_interrupt(design, number, states)
    return design


def interrupted_states(design: Design, number: int) -> tuple[State, ...]:
    """The states that an interrupt leaves; none if the state that handles it is missing or handles another one."""
    interrupt = design.interrupts[number]
    if design.state(interrupt.do) is None or is_handled_before(design, number):
        return ()
    urgent = {each.do for each in design.interrupts[: number + 1]}
    candidates = (each for each in design.states if each.name not in urgent and not each.disabled)
    if not interrupt.during:
        return tuple(each for each in candidates if not each.final)
    return tuple(each for each in candidates if any(fits_pattern(each.name, name) for name in interrupt.during))


def is_handled_before(design: Design, number: int) -> bool:
    """Whether the state of an interrupt handles an earlier one: it would not be clear which of them has ended."""
    return design.interrupts[number].do in {each.do for each in design.interrupts[:number]}


def find_target(design: Design, interrupt: Interrupt, state: State) -> str:
    """The state that follows an interrupt of a state; empty if there is not exactly one."""
    match interrupt.then or "resume":
        case "resume":
            return state.name
        case "restart":
            return design.initial
        case "skip":
            return _next_state(design, state)
        case "done":
            return _single(each.name for each in design.states if each.final and not each.failed and not each.disabled)
        case "fail":
            return _single(each.name for each in design.states if each.failed and not each.disabled)
        case name:
            return name if design.state(name) is not None else ""


def interrupt_names(design: Design) -> tuple[tuple[str, int], ...]:
    """The names of the variables that interrupts need, each with the number of its interrupt."""
    found: list[tuple[str, int]] = []
    for number, interrupt in enumerate(design.interrupts):
        if is_handled_before(design, number):
            continue
        found += [(_from_name(interrupt), number)] if _remembers(interrupt) else []
        found += [(_again_name(interrupt), number)] if interrupt.every else []
    return tuple(found)


def _add_variables(design: Design) -> Design:
    for name, number in interrupt_names(design):
        if name in names_of(design) or not interrupted_states(design, number):
            continue
        interrupt, origin = design.interrupts[number], ("interrupts", number)
        if name == _again_name(interrupt):
            # It is -1 during the interruption, and counts from the iteration that ends it.
            design = add_time(design, name, origin)
            value = since_restart(f"(component_time + {interrupt.every} if {name} < 0 else {name})")
            design = add_first_action(design, Assign(values=((name, value),), origin=origin))
            design = _add_state_action(design, interrupt.do, Assign(values=((name, "-1"),), origin=origin))
        else:
            design = add_variables(design, Declaration(name=name, type="int", initial="0", origin=origin))
            # The initial state may be interrupted before it acts.
            first = next((i for i, each in enumerate(design.states, start=1) if each.name == design.initial), 0)
            reset = Assign(values=((name, f"{first} if component_time <= 0 else {name}"),), origin=origin)
            design = _remember_source(add_first_action(design, reset), name, number)
    return design


def _add_state_action(design: Design, name: str, action: Assign) -> Design:
    state = design.state(name)
    return design if state is None else change_state(design, replace(state, actions=(action, *state.actions)))


def _remember_source(design: Design, variable: str, number: int) -> Design:
    """Let each interrupted state set its number, and the others, from which there is no way back, 0.

    The state itself keeps the number, and those above do: they may interrupt it and come back.
    """
    left = {state.name for state in interrupted_states(design, number)}
    keeping = {each.do for each in design.interrupts[: number + 1]}

    def remember(index: int, state: State) -> State:
        if state.name in keeping:
            return state
        # A state that can be interrupted may also go there by its own transition: then it comes back as well.
        values = ((variable, str(index if state.name in left else 0)),)
        return replace(state, actions=(Assign(values=values, origin=("interrupts", number)), *state.actions))

    return replace(design, states=tuple(remember(index, each) for index, each in enumerate(design.states, start=1)))


def _lower_interrupt(design: Design, number: int, states: tuple[State, ...]) -> Design:
    interrupt, origin = design.interrupts[number], ("interrupts", number)
    way_in: Decision = Transition(to=interrupt.do, guard=Guard(when=interrupt.when), doc=interrupt.doc, origin=origin)
    if interrupt.every:
        allowed = f"component_time <= 0 or {NOW} >= {_again_name(interrupt)}"
        inner = Transition(to=interrupt.do, guard=Guard(when=allowed), doc=interrupt.doc, origin=origin)
        way_in = DecisionGroup(guard=Guard(when=interrupt.when), then=(inner,), origin=origin)
    interrupted = {each.name for each in states}
    back = _ways_back(design, interrupt, states, number)

    def change(state: State) -> State:
        if state.name in interrupted:
            return replace(state, transitions=(way_in, *state.transitions))
        return replace(state, transitions=(*back, *state.transitions)) if state.name == interrupt.do else state

    return replace(design, states=tuple(map(change, design.states)))


def _ways_back(design: Design, interrupt: Interrupt, states: tuple[State, ...], number: int) -> tuple[Decision, ...]:
    origin = ("interrupts", number)
    guard = Guard(when=interrupt.until or negated(interrupt.when))
    targets = {each.name: find_target(design, interrupt, each) for each in states}
    if not _remembers(interrupt):
        return tuple(Transition(to=to, guard=guard, origin=origin) for to in sorted(set(targets.values()) - {""}))
    numbers = {each.name: index for index, each in enumerate(design.states, start=1)}
    variable = _from_name(interrupt)
    choices = tuple(
        Transition(to=to, guard=Guard(when=f"{variable} == {numbers[name]}"), origin=origin)
        for name, to in targets.items()
        if to
    )
    return (DecisionGroup(guard=guard, then=choices, origin=origin),) if choices else ()


def _remembers(interrupt: Interrupt) -> bool:
    """Whether what follows depends on the interrupted state."""
    return (interrupt.then or "resume") in ("resume", "skip")


def _next_state(design: Design, state: State) -> str:
    """The target of the transition that is taken when the work of a state is done, or of its only one."""
    off = disabled_states(design)
    enabled = [each for each in iter_state_decisions(state) if is_enabled(each, off)]
    written = [
        (each.decision, bool(each.groups))
        for each in enabled
        if isinstance(each.decision, Transition) and not each.decision.origin
    ]
    ends = [each.to for each, is_nested in written if not is_nested and _is_end(each.guard)]
    return _single(dict.fromkeys(ends or (each.to for each, _is_nested in written)))


def _is_end(guard: Guard) -> bool:
    """Whether a guard says that the work of the state is done, and nothing else."""
    return not guard.after and guard.code is None and _ENDS.fullmatch(guard.when.strip()) is not None


def _single(names: Iterable[str]) -> str:
    found = list(names)
    return found[0] if len(found) == 1 else ""


def _from_name(interrupt: Interrupt) -> str:
    return f"{snake_case(interrupt.do)}_from"


def _again_name(interrupt: Interrupt) -> str:
    return f"{snake_case(interrupt.do)}_again"
