"""Why a state is not active: the conditions that fail on the way to it, since when, and by how much."""

import math
from collections import deque
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

from vicode.model.decision_keys import transition_key
from vicode.model.design import COMMON, Design, Guard, Stay, Transition
from vicode.model.disabled import disabled_states, is_enabled
from vicode.model.expressions import BOOL, Comparison, Expr, Logic, Scope, parse_expression
from vicode.model.project import Project
from vicode.model.traversal import LocatedDecision, iter_decisions
from vicode.runs.guard_values import GuardValues, Steps, format_value, guard_values
from vicode.runs.recording import Recording

_TOO = {"<": "too large", "<=": "too large", ">": "too small", ">=": "too small"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """A part of a guard. `holds` is None if that is not known; `false_for_s` is how long it has been false.

    It `was_false_before` if the search ended there, so that it may have been false for longer.
    """

    text: str
    holds: bool | None
    detail: str = ""
    false_for_s: float | None = None
    was_false_before: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class TransitionState:
    """A transition with its conditions. `earlier` are the decisions before it that hold, and so are taken first."""

    key: str
    source: str
    target: str
    conditions: tuple[Condition, ...]
    earlier: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class WhyNot:
    """The shortest way to a state: the transitions of its first step, and one for each later step.

    `first` is empty if no transitions lead there.
    """

    target: str
    first: tuple[TransitionState, ...] = ()
    later: tuple[TransitionState, ...] = ()


class PastConditions:
    """How long conditions have been false, so that the next iteration does not search the same past again.

    One object belongs to one design, its constants, and one recording; `truncations` of the recording clear it.

    Args:
        lookback: How many earlier iterations are read at most.
    """

    def __init__(self, lookback: int = 2000) -> None:
        self.lookback = lookback
        self._truncations = 0
        self._known: dict[tuple[str, str], tuple[int, _Since]] = {}

    def find(self, recording: Recording, key: tuple[str, str]) -> "tuple[int, _Since]":
        """The number of the iteration that was looked at last, 0 if none, and since when the condition was false."""
        if recording.truncations != self._truncations:
            self._truncations = recording.truncations
            self._known.clear()
        number, since = self._known.get(key, (0, _Since(time_ns=0, is_earlier=False)))
        return number - recording.dropped, since

    def remember(self, recording: Recording, key: tuple[str, str], number: int, since: "_Since") -> None:
        self._known[key] = (number + recording.dropped, since)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Since:
    time_ns: int
    is_earlier: bool
    """Whether the search ended there."""


def explain(
    project: Project,
    design: Design,
    recording: Recording,
    number: int,
    *,
    target: str,
    latest: Steps,
    tuned: Mapping[str, Any] | None = None,
    past: PastConditions | None = None,
) -> WhyNot:
    """Explain why a state is not active in an iteration.

    Args:
        project: The project of the design.
        design: The design that ran.
        recording: What it did, with values.
        number: The iteration.
        target: The state in question.
        latest: The latest steps of the components, as `latest_steps` finds them.
        tuned: Values of constants that differ from the project.
        past: What was found for earlier iterations of the recording; it is extended.
    """
    iteration = recording.iteration(number)
    if iteration is None:
        return WhyNot(target=target)
    look = _Look(
        project=project,
        design=design,
        recording=recording,
        number=number,
        tuned=tuned or {},
        past=past or PastConditions(),
    )
    look.values[number] = guard_values(project, design, iteration, latest, tuned)
    steps = _shortest_way(look.enabled, iteration.state, target)
    if not steps:
        return WhyNot(target=target)
    return WhyNot(
        target=target,
        first=tuple(look.describe(located, with_past=True) for located in steps[0]),
        later=tuple(look.describe(parallel[0], with_past=False) for parallel in steps[1:]),
    )


def _shortest_way(
    decisions: tuple[LocatedDecision, ...], start: str, target: str
) -> tuple[tuple[LocatedDecision, ...], ...]:
    """For each step the transitions between its two states, in the order of evaluation."""
    before: dict[str, str] = {}
    waiting = deque([start])
    pairs = [(each.source, each.decision.to) for each in decisions if isinstance(each.decision, Transition)]
    while waiting and target not in before:
        state = waiting.popleft()
        for source, to in pairs:
            if source in (state, COMMON) and to != start and to not in before:
                before[to] = state
                waiting.append(to)
    states = [target]
    while states[0] != start:
        if states[0] not in before:
            return ()
        states.insert(0, before[states[0]])
    return tuple(
        tuple(
            each
            for each in decisions
            if isinstance(each.decision, Transition) and each.decision.to == to and each.source in (source, COMMON)
        )
        for source, to in pairwise(states)
    )


@dataclass(kw_only=True)
class _Look:
    """Evaluates conditions at an iteration and before it."""

    project: Project
    design: Design
    recording: Recording
    number: int
    tuned: Mapping[str, Any]
    past: PastConditions
    values: dict[int, GuardValues | None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        off = disabled_states(self.design)
        self.enabled = tuple(each for each in iter_decisions(self.design) if is_enabled(each, off))

    def describe(self, located: LocatedDecision, *, with_past: bool) -> TransitionState:
        assert isinstance(located.decision, Transition)
        now = self._values(self.number)
        state = self.recording.states[self.number - 1]
        source = state if located.source == COMMON and with_past else located.source
        return TransitionState(
            key=transition_key(located.path),
            source=source,
            target=located.decision.to,
            conditions=tuple(self._condition(part, now, with_past=with_past) for part in self._parts(located, now)),
            earlier=tuple(self._earlier(located, state, now)) if with_past else (),
        )

    def _earlier(self, located: LocatedDecision, state: str, now: "GuardValues | None") -> Iterator[str]:
        for each in self.enabled:
            if each.path == located.path:
                return
            if each.source in (COMMON, state) and isinstance(each.decision, Transition | Stay):
                parts = list(self._parts(each, now))
                if now is not None and all(part.holds(now) for part in parts):
                    yield f"→ {each.decision.to}" if isinstance(each.decision, Transition) else "stay"

    def _condition(self, part: "_Part", now: "GuardValues | None", *, with_past: bool) -> Condition:
        # The time in a state says nothing about guards of another one.
        holds = part.holds(now) if now is not None and (with_past or not part.is_time) else None
        detail = part.detail(now) if now is not None and holds is False else ""
        if not with_past or holds is not False or part.is_time:
            return Condition(text=part.text, holds=holds, detail=detail)
        since = self._find_since(part)
        return Condition(
            text=part.text,
            holds=holds,
            detail=detail,
            false_for_s=(self.recording.times_ns[self.number - 1] - since.time_ns) / 1e9,
            was_false_before=since.is_earlier,
        )

    def _parts(self, located: LocatedDecision, values: GuardValues | None) -> Iterator["_Part"]:
        return _parts(located, values, self.design.time_unit or "s")

    def _find_since(self, part: "_Part") -> _Since:
        times, states = self.recording.times_ns, self.recording.states
        key = (states[self.number - 1], part.text)
        last, since = self.past.find(self.recording, key)
        first, end = self.number, max(1, self.number - self.past.lookback)
        while first != last and first > end and self._was_false(part, first - 1):
            first -= 1
        if first != last:
            is_earlier = first == end > 1 and self._was_false(part, end - 1)
            since = _Since(time_ns=times[first - 1], is_earlier=is_earlier)
        self.past.remember(self.recording, key, self.number, since)
        return since

    def _was_false(self, part: "_Part", number: int) -> bool:
        """Whether a condition was false in an earlier iteration in the same state."""
        states = self.recording.states
        if states[number - 1] != states[self.number - 1]:
            return False
        values = self._values(number)
        return values is not None and part.holds(values) is False

    def _values(self, number: int) -> "GuardValues | None":
        if number not in self.values:
            iteration = self.recording.iteration(number)
            steps = {str(step["component"]): step for step in iteration.tree} if iteration else {}
            found = guard_values(self.project, self.design, iteration, steps, self.tuned) if iteration else None
            self.values[number] = found
        return self.values[number]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Part:
    """One of the conditions that must hold together; its negation for the `else` of a group."""

    text: str
    after: str = ""
    tree: Expr | None = None
    guards: tuple["_Part", ...] = ()
    """The parts of the guard of a group that must not hold all."""

    @property
    def is_time(self) -> bool:
        return bool(self.after)

    def holds(self, values: GuardValues) -> bool | None:
        if self.guards:
            held = [part.holds(values) for part in self.guards]
            return True if False in held else None if None in held else False
        if self.after:
            left = values.time_left_s(self.after)
            return None if left is None else left <= 0
        found = values.evaluate(self.tree) if self.tree is not None else None
        return None if found is None else bool(found)

    def detail(self, values: GuardValues) -> str:
        """What is missing, for a condition that is false."""
        if self.after:
            return f"{format_value(values.time_left_s(self.after))} s to go"
        return _describe(self.tree, values) if self.tree is not None else ""


def _parts(located: LocatedDecision, values: GuardValues | None, unit: str) -> Iterator[_Part]:
    scope = values.scope if values is not None else None
    for group, is_then in located.groups:
        parts = tuple(_guard_parts(group.guard, scope, unit))
        if is_then:
            yield from parts
        elif parts:
            yield _Part(text=f"not ({' and '.join(part.text for part in parts)})", guards=parts)
    yield from _guard_parts(located.decision.guard, scope, unit)


def _guard_parts(guard: Guard, scope: Scope | None, unit: str) -> Iterator[_Part]:
    if guard.after:
        yield _Part(text=f"after {guard.after} {unit}", after=guard.after)
    if guard.when:
        parsed = parse_expression(guard.when, scope, BOOL) if scope is not None else None
        tree = parsed.tree if parsed is not None and not parsed.diagnostics else None
        is_all = isinstance(tree, Logic) and tree.operator == "and"
        if isinstance(tree, Logic) and is_all:
            yield from (_Part(text=_source(guard.when, each), tree=each) for each in tree.operands)
        else:
            yield _Part(text=guard.when, tree=tree)
    if guard.code is not None:
        yield _Part(text="code")


def _source(text: str, node: Expr) -> str:
    start, end = node.span
    return text[start:end]


def _describe(tree: Expr, values: GuardValues) -> str:
    """The value that fails: `0.8, 0.3 too large`; the values that are read for other conditions."""
    if isinstance(tree, Comparison):
        held = [values.evaluate(each) for each in tree.operands]
        for operator, left, right in zip(tree.operators, held, held[1:], strict=False):
            if left is None or right is None:
                continue
            if operator in _TOO and not _compare(operator, left, right):
                distance = abs(float(left) - float(right))
                is_number = math.isfinite(distance)
                return format_value(left) + (f", {format_value(distance)} {_TOO[operator]}" if is_number else "")
            if operator == "==" and left != right:
                return f"{format_value(left)}, must be {format_value(right)}"
    return _reads(tree, values)


def _compare(operator: str, left: Any, right: Any) -> bool:
    return bool({"<": left < right, "<=": left <= right, ">": left > right, ">=": left >= right}[operator])


def _reads(tree: Expr, values: GuardValues) -> str:
    return ", ".join(f"{name} = {format_value(value)}" for name, value in values.read_by(tree).items())
