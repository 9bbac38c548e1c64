"""States and transitions in one line, as people sketch them: "Idle -order-> Drive -distance < 0.5-> Pour"."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from vicode.model.design import Design, Guard, State, Transition
from vicode.model.edits import add_state, add_transition
from vicode.model.guard_text import parse_guard
from vicode.model.names import is_valid_state_name

MAX_LENGTH = 1000
_ARROW = re.compile(r"->|→")
_NAME = re.compile(r"\s*([^\s-]*)")


@dataclass(frozen=True, slots=True, kw_only=True)
class TransitionLine:
    """The states of a line in their order; the guard at n belongs to the transition from state n to the next."""

    states: tuple[str, ...]
    guards: tuple[Guard, ...]

    def missing_states(self, design: Design) -> tuple[str, ...]:
        return tuple(name for name in dict.fromkeys(self.states) if design.state(name) is None)

    def missing_transitions(self, design: Design) -> tuple[tuple[str, str, Guard], ...]:
        """The transitions that no state has yet: source, target and guard."""
        listed = dict.fromkeys(zip(self.states, self.states[1:], self.guards, strict=False))
        return tuple(each for each in listed if not _has_transition(design, *each))


def is_transition_line(text: str) -> bool:
    """Whether a text is meant as a line of states, with errors or not."""
    return _ARROW.search(text) is not None


def parse_transition_line(text: str, time_unit: str) -> TransitionLine | str:
    """The line in a text, or why it cannot be read."""
    if len(text) > MAX_LENGTH:
        return f"a line has at most {MAX_LENGTH} characters"
    *parts, last = _ARROW.split(text)
    states, guards = [], []
    for part in parts:
        name = _NAME.match(part)
        assert name is not None
        guard = _read_guard(part[name.end() :], time_unit)
        if isinstance(guard, str):
            return guard
        states.append(name[1])
        guards.append(guard)
    states.append(last.strip())
    return _find_wrong_name(states) or TransitionLine(states=tuple(states), guards=tuple(guards))


def add_line(design: Design, line: TransitionLine) -> Design:
    """The design with the states and transitions of a line that it lacks."""
    missing = line.missing_transitions(design)
    for name in line.missing_states(design):
        design = add_state(design, State(name=name))
    for source, target, guard in missing:
        design = add_transition(design, source, target, guard)
    return design


def _read_guard(text: str, time_unit: str) -> Guard | str:
    """The guard between a name and the arrow: "-guard", or "--guard-" of a long arrow."""
    text = text.strip()
    if text in ("", "-"):
        return Guard()
    if not text.startswith("-"):
        return f"'{text}' must stand between '-' and '->', such as -order->"
    inner = text[2:-1] if text.startswith("--") and text.endswith("-") else text[1:]
    guard = parse_guard(inner, time_unit)
    if guard is None or inner.lstrip().startswith("-"):
        return f"'{inner.strip()}' is not a guard: write an expression, a time such as 20 s, or both"
    return guard


def _find_wrong_name(states: Sequence[str]) -> str:
    if "" in states:
        return f"a state is missing {'before' if not states[0] else 'after'} an arrow"
    wrong = next((name for name in states if not is_valid_state_name(name)), None)
    return f"'{wrong}' is not a name of a state: use letters, digits and '_'" if wrong is not None else ""


def _has_transition(design: Design, source: str, target: str, guard: Guard) -> bool:
    state = design.state(source)
    transitions = state.transitions if state is not None else ()
    return any(isinstance(each, Transition) and (each.to, each.guard) == (target, guard) for each in transitions)
