"""Chooses inputs that reach the parts of a design, by a search with the reference interpreter.

A point of the search is an iteration of a run with the state of the robots after it. From a point, some iterations with
drawn inputs are tried; if they reach a goal that nothing reached before, their end becomes another point. So a later
attempt continues where an earlier one came in. The inputs are drawn at the numbers that the design mentions, at values
that make both sides of a comparison equal, at the ends of timers and periods, and from unusual ones. The runs are the
paths to points that together reach all goals, or most of them. Iterations that are left continue them with drawn
inputs, and with unusual ones for an iteration: each input gets each unusual value in turn.

The search depends on the design, the number of iterations and the seed only.
"""

import math
import random
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from vicode.conformance.coverage import CoverageRecorder, DesignGoals, Goal
from vicode.conformance.input_values import MS, ValueDrawer, deal_unusual, known_numbers, mentioned_inputs
from vicode.conformance.inputs import ConformanceRun, InputKey, RunInput, RunStep
from vicode.conformance.reference import ReferenceState
from vicode.model.expressions import FLOAT, INT
from vicode.model.project import Project
from vicode.model.traversal import iter_decisions
from vicode.semantics import ComponentStep, Interpreter, Machine, NotInterpretableError, build_machines

_TRIES_PER_ITERATION = 24
_LONGEST_ATTEMPT = 6
_LONGEST_TAIL = 20
_MOST_ROBOTS, _TEAM_TICKS = 6, 2
_AIMED, _MOST_VARIED, _SECANTS = 0.15, 4, 3
_WITH_UNUSUAL = 0.35
_BESIDE = (1.0, -1.0, 0.5, -0.5, 0.05, -0.05)
_LARGE, _LONGEST_NS = 1e15, 10**15
_TIME: InputKey = ("", "@time")
"""The time of an iteration, where inputs are varied."""


def choose_runs(
    project: Project, root: str, *, iterations: int, seed: int, in_xabsl: bool = False
) -> tuple[ConformanceRun, ...]:
    """Runs of together at most `iterations` iterations that reach as much of a design as was found.

    Args:
        project: The project.
        root: The root component.
        iterations: The number of iterations of all runs.
        seed: The seed of the search.
        in_xabsl: Whether half of the iterations have times in whole milliseconds.

    Raises:
        NotInterpretableError: A design has errors, or code that is not portable.
    """
    machines = build_machines(project, root)
    goals = DesignGoals(machines, root)
    empty = ConformanceRun(project=project, root=root, steps=())
    settings = [(empty, False), *([(empty, True)] if in_xabsl else [])]
    settings += [(replace(empty, robots=robots, team_ticks=_TEAM_TICKS), in_xabsl) for robots in _team_sizes(machines)]
    rng, runs = random.Random(seed), list[ConformanceRun]()
    mentioned = mentioned_inputs(project, root)
    unusual = deal_unusual(rng, [each for each in empty.inputs if each.key in mentioned])
    for index, (setting, whole_ms) in enumerate(settings):
        share = iterations * (index + 1) // len(settings) - iterations * index // len(settings)
        drawer = ValueDrawer(rng, known_numbers(project, root), whole_ms)
        runs += _Search(goals, setting, drawer, unusual).find(share)
    return tuple(runs)


def choose_missing(
    recorder: CoverageRecorder, setting: ConformanceRun, *, wanted: frozenset[Goal], iterations: int
) -> Iterator[ConformanceRun]:
    """Runs of one robot that reach goals which a recorder has not seen.

    Args:
        recorder: What was seen.
        setting: A run without iterations.
        wanted: The goals that count.
        iterations: The number of iterations that the search may use.
    """
    project, root = setting.project, setting.root
    drawer = ValueDrawer(random.Random(0), known_numbers(project, root))
    yield from _Search(recorder.goals, setting, drawer, iter(()), recorder).find_wanted(wanted, iterations)


def _team_sizes(machines: dict[str, Machine]) -> tuple[int, ...]:
    """The numbers of robots that show what states coordinate: enough to fill them, and one more for a capacity."""
    designs = [machine.design for machine in machines.values() if machine.design is not None]
    states = [state for design in designs for state in design.states]
    numbers = {each.synchronized or 0 for each in states} | {each.capacity + 1 for each in states if each.capacity}
    return tuple(sorted({min(each, _MOST_ROBOTS) for each in numbers if each > 1}))


@dataclass(eq=False)
class _Point:
    """The end of a run: the iterations since `start`, the state after them, and the goals that they reached first."""

    start: "_Point | None"
    steps: tuple[RunStep, ...]
    state: ReferenceState
    goals: frozenset[Goal] = frozenset()

    @property
    def time_ns(self) -> int:
        """What the clock shows."""
        if self.steps:
            return self.steps[-1].time_ns
        return self.start.time_ns if self.start else 0

    @property
    def run(self) -> tuple[RunStep, ...]:
        """All iterations from the first one."""
        return (*(self.start.run if self.start else ()), *self.steps)

    @property
    def starts(self) -> "Iterator[_Point]":
        """The points on the way here."""
        if self.start is not None:
            yield self.start
            yield from self.start.starts

    @property
    def all_goals(self) -> frozenset[Goal]:
        """The goals that were reached first on the way here."""
        return self.goals | (self.start.all_goals if self.start else frozenset())


class _Search:
    """The search with one number of robots and one kind of times.

    Args:
        goals: What may happen.
        setting: A run without iterations.
        draw: Draws values and times.
        unusual: Inputs with unusual values.
        recorder: What was seen before; None: nothing.
    """

    def __init__(
        self,
        goals: DesignGoals,
        setting: ConformanceRun,
        draw: ValueDrawer,
        unusual: Iterator[tuple[RunInput, float]],
        recorder: CoverageRecorder | None = None,
    ) -> None:
        self._goals, self._setting, self._draw, self._rng = goals, setting, draw, draw.rng
        self._recorder = recorder or CoverageRecorder(goals)
        self._robots = self._recorder.make_robots(setting)
        self._points = [_Point(None, (), self._robots.save())]
        self._unusual = unusual

    def find(self, iterations: int) -> Iterator[ConformanceRun]:
        """Search, and return the runs."""
        self._explore(iterations)
        ends = self._select(frozenset(self._recorder.seen), iterations)
        spare = iterations - sum(len(point.run) for point in ends)
        for point in ends:
            tail = tuple(self._continue(point, min(spare, _LONGEST_TAIL)))
            spare -= len(tail)
            yield replace(self._setting, steps=(*point.run, *tail))
        # The points that were reached last may be in a state that is never left: others are continued, too.
        while spare > 0:
            point = self._rng.choice([point for point in self._points if len(point.run) < spare])
            tail = tuple(self._continue(point, min(spare - len(point.run), _LONGEST_TAIL)))
            steps = (*point.run, *tail)
            spare -= max(1, len(steps))
            if steps:
                yield replace(self._setting, steps=steps)

    def find_wanted(self, wanted: frozenset[Goal], iterations: int) -> Iterator[ConformanceRun]:
        """Search, and return the runs that reach some goals first."""
        wanted -= self._recorder.seen
        self._explore(iterations)
        for point in self._select(wanted & self._recorder.seen, iterations):
            yield replace(self._setting, steps=point.run)

    def _explore(self, iterations: int) -> None:
        tries = iterations * _TRIES_PER_ITERATION
        while tries > 0:
            tries -= self._attempt(self._choose_point())

    def _select(self, missing: frozenset[Goal], iterations: int) -> list[_Point]:
        """The points whose runs reach all goals, or most of them; first those with the most goals per iteration."""
        rest = {point: (point.all_goals, len(point.run)) for point in self._points if point.steps}
        chosen = list[_Point]()
        while rest:
            point, (goals, length) = max(rest.items(), key=lambda pair: len(pair[1][0] & missing) / pair[1][1])
            if not goals & missing:
                break
            if length <= iterations:
                chosen.append(point)
                iterations -= length
                missing -= goals
            del rest[point]
        # A run that another one continues adds nothing.
        continued = {id(start) for point in chosen for start in point.starts}
        return [point for point in chosen if id(point) not in continued]

    def _choose_point(self) -> _Point:
        """The newest point, one of the last ones, or any."""
        kind = self._rng.random()
        if kind < 0.4:
            return self._points[-1]
        return self._rng.choice(self._points[-8:] if kind < 0.7 else self._points)

    def _attempt(self, point: _Point) -> int:
        """Try some iterations; return how many were run."""
        self._robots.restore(point.state)
        steps, time_ns, count = list[RunStep](), point.time_ns, 0
        seen = reached = set(self._recorder.seen)
        kept, kept_state = 0, point.state
        for _index in range(self._rng.randint(1, _LONGEST_ATTEMPT)):
            step = self._draw_step(time_ns, is_first=not point.start and not point.steps and not steps)
            if self._rng.random() < _AIMED:
                step, tried = self._aim(step, time_ns, only_unmet=True)
                count += tried
            count += 1
            if not self._follow(step):
                self._recorder.seen = reached
                break
            steps.append(step)
            time_ns = step.time_ns
            if len(self._recorder.seen) > len(reached):
                kept, kept_state, reached = len(steps), self._robots.save(), set(self._recorder.seen)
        if kept:
            self._points.append(_Point(point, tuple(steps[:kept]), kept_state, frozenset(reached - seen)))
        return count

    def _aim(self, step: RunStep, time_ns: int, *, only_unmet: bool) -> tuple[RunStep, int]:
        """Change an iteration so that both sides of a comparison become equal, or almost; return it and the tries.

        One input, or the time, is varied as if the difference of both sides were linear in it.
        """
        state = self._robots.save()
        gaps, tries = self._find_gaps(step, state), 1
        found = [goal for goal, gap in gaps.items() if math.isfinite(gap)]
        unmet = [goal for goal in found if goal not in self._recorder.seen]
        found = unmet if unmet or only_unmet else found
        if not found:
            return step, tries
        goal = self._rng.choice(found)
        inputs = [each.key for each in self._setting.inputs if each.type in (INT, FLOAT)]
        for key in self._rng.sample([*inputs, _TIME], min(len(inputs) + 1, _MOST_VARIED)):
            at, gap = self._read(step, key), gaps[goal]
            other = at + (MS if key == _TIME else 1)
            for _round in range(_SECANTS):
                changed = self._vary(step, key, other)
                new = self._find_gaps(changed, state).get(goal, math.nan)
                tries += 1
                slope = (new - gap) / (other - at) if other != at else 0.0
                if new == 0:
                    if goal in self._recorder.seen and key != _TIME and self._rng.random() < 0.7:
                        changed = self._vary(step, key, other + self._rng.choice(_BESIDE))
                    return changed, tries
                if not math.isfinite(slope) or slope == 0 or not math.isfinite(other - new / slope):
                    break
                step, at, gap, other = changed, other, new, self._limited(key, other - new / slope, time_ns)
        return step, tries

    def _find_gaps(self, step: RunStep, state: ReferenceState) -> dict[Goal, float]:
        """The differences of the compared numbers in an iteration, which is undone."""
        recorder, seen = self._recorder, set(self._recorder.seen)
        recorder.gaps.clear()
        self._follow(step)
        recorder.seen = seen
        self._robots.restore(state)
        return dict(recorder.gaps)

    def _read(self, step: RunStep, key: InputKey) -> float:
        """The value of an input of the first robot, or the time."""
        if key == _TIME:
            return step.time_ns
        value = step.inputs[0].get(key, self._robots.values[0][key])
        return value if math.isfinite(value) and abs(value) < _LARGE else 0.0

    def _vary(self, step: RunStep, key: InputKey, value: float) -> RunStep:
        if key == _TIME:
            return replace(step, time_ns=round(value))
        is_int = next(each.type for each in self._setting.inputs if each.key == key) == INT
        return _with_input(step, key, round(value) if is_int else float(value))

    def _limited(self, key: InputKey, value: float, time_ns: int) -> float:
        if key != _TIME:
            return max(-_LARGE, min(value, _LARGE))
        unit = MS if self._draw.whole_ms else 1
        return max(time_ns, min(round(value / unit) * unit, time_ns + _LONGEST_NS))

    def _continue(self, point: _Point, iterations: int) -> Iterator[RunStep]:
        self._robots.restore(point.state)
        time_ns, state = point.time_ns, point.state
        unusual: RunInput | None = None
        for index in range(iterations):
            step = self._draw_step(time_ns, is_first=not index and not point.run)
            if unusual is not None:
                # Values such as nan would keep guards from holding.
                step, unusual = _with_input(step, unusual.key, self._draw.value(unusual)), None
            kind = self._rng.random()
            if kind < _AIMED:
                step, _tries = self._aim(step, time_ns, only_unmet=False)
            elif kind < _AIMED + _WITH_UNUSUAL and (dealt := next(self._unusual, None)) is not None:
                unusual, value = dealt
                step = _with_input(step, unusual.key, value)
            if not self._follow(step):
                self._robots.restore(state)
                continue
            state, time_ns = self._robots.save(), step.time_ns
            yield step

    def _follow(self, step: RunStep) -> bool:
        """Run an iteration; return False if it is left out, after which the robots must be restored.

        It is left out if it runs code that cannot be interpreted, or if XABSL gets it and its doubles are not exact.
        """
        try:
            self._recorder.follow(self._robots, step)
        except NotInterpretableError:
            return False
        return not (self._draw.whole_ms and any(robot.memory.had_large_ints for robot in self._robots.robots))

    def _draw_step(self, time_ns: int, *, is_first: bool) -> RunStep:
        inputs = tuple(self._draw_inputs(is_first=is_first) for _robot in self._robots.robots)
        if is_first:
            return RunStep(time_ns=self._draw.time_ns() if self._rng.random() < 0.2 else 0, inputs=inputs)
        ends = self._boundaries(self._rng.choice(self._robots.robots))
        boundaries = tuple(ns for ns in ends if ns >= 0)
        return RunStep(time_ns=max(0, time_ns + self._draw.time_ns(boundaries)), inputs=inputs)

    def _draw_inputs(self, *, is_first: bool) -> dict[InputKey, Any]:
        rate = self._rng.choice((0.1, 0.4, 0.4, 0.8))
        inputs = self._setting.inputs
        changed = inputs if is_first else [each for each in inputs if self._rng.random() < rate]
        return {each.key: self._draw.value(each) for each in changed}

    def _boundaries(self, robot: Interpreter) -> Iterator[int]:
        """The times until timers and periods end, and until the time in the state is a number of the design."""
        now_ns = robot.memory.now_ns
        for name, memory in robot.memory.components.items():
            machine = self._goals.machines[name]
            if memory.stepped_in != robot.memory.iteration:
                continue
            if machine.period_ns:
                yield memory.worked_ns + machine.period_ns - now_ns
            if machine.design is None:
                continue
            step, state = _reader(robot, name), machine.state(memory.state)
            for located in iter_decisions(machine.design):
                if located.source in (state.name, "@common") and located.decision.guard.after:
                    limit = step.timer_ns(located.decision.guard.after)
                    if limit < 1e18:
                        yield memory.entered_ns + int(limit) - now_ns
            for limit in self._rng.sample(self._draw.numbers, min(2, len(self._draw.numbers))):
                if 0 < limit < 1e5:
                    yield memory.entered_ns + round(limit * machine.ns_per_unit) - now_ns


def _with_input(step: RunStep, key: InputKey, value: Any) -> RunStep:
    """The iteration with another value of an input of the first robot."""
    return replace(step, inputs=({**step.inputs[0], key: value}, *step.inputs[1:]))


def _reader(robot: Interpreter, component: str) -> ComponentStep:
    return ComponentStep(robot, component, robot.machines[component], robot.memory.components[component])
