"""Which parts of a design the inputs reach, as the reference interpreter shows it.

A goal is something that inputs can make happen: a guard is true, a timer is met exactly, a state is entered. The goals
are listed from the designs; `CoverageRecorder` follows a run and collects those that happened.
"""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import pairwise
from textwrap import shorten
from typing import Any

from vicode.conformance.inputs import ConformanceRun, RunStep
from vicode.conformance.reference import ReferenceRobots
from vicode.conformance.result import CoverageCount, InputCoverage, NeverSeen
from vicode.findings import DesignPath
from vicode.model.design import Decision, DecisionGroup, Guard, Transition
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    INT,
    Boolean,
    Comparison,
    Expr,
    Logic,
    OutputRef,
    Ternary,
    walk,
)
from vicode.model.traversal import is_exhaustive, iter_decisions
from vicode.semantics import ComponentStep, Interpreter, Machine, Outcome, build_machines, evaluate


class GoalKind(StrEnum):
    """What happens; the value is how counts name it."""

    GUARD = "guards true and false"
    TRANSITION = "transitions"
    STATE = "states"
    GROUP = "groups left without a decision"
    OPERAND = "operands of guards true and false"
    LIMIT = "comparisons at their limit"
    PERIOD = "periods elapsed and not"
    TIMER = "timers exactly met and missed by 1 ns"
    ACTIVATION = "components active again"
    TEAM = "states for which robots wait at the same time"


_KEYS = {
    GoalKind.GUARD: ("when",),
    GoalKind.OPERAND: ("when",),
    GoalKind.LIMIT: ("when",),
    GoalKind.TIMER: ("after",),
}
"""The part of a decision that has these goals."""


@dataclass(frozen=True, slots=True)
class Goal:
    """Something that inputs can make happen.

    Attributes:
        subject: The component, and the path of the part of its design.
        part: The number of the part of a guard.
        outcome: What happens, such as "true".
        text: The part in words.
    """

    kind: GoalKind
    subject: tuple[str, DesignPath]
    outcome: str
    part: int = 0
    text: str = field(default="", compare=False)

    @property
    def item(self) -> tuple[GoalKind, tuple[str, DesignPath], int]:
        """What counts as one: a guard, which has two goals."""
        return (self.kind, self.subject, self.part)


@dataclass(frozen=True, slots=True)
class _Condition:
    """A comparison of two numbers in a guard."""

    left: Expr
    right: Expr
    goal: Goal


@dataclass(frozen=True, slots=True)
class _Parts:
    """What a decision shows: its path, the operands of its guard and its comparisons."""

    path: DesignPath
    operands: tuple[tuple[int, Expr], ...]
    limits: tuple[_Condition, ...]


class DesignGoals:
    """The goals of a component and of all that it uses.

    Args:
        machines: The components, by name.
        root: The component that is stepped in each iteration.

    Attributes:
        goals: All goals, in the order of the designs.
    """

    def __init__(self, machines: Mapping[str, Machine], root: str) -> None:
        self.machines = machines
        self._parts: dict[int, _Parts] = {}
        goals: list[Goal] = []
        for name, machine in machines.items():
            if machine.design is not None:
                goals += self._list(name, machine, is_root=name == root)
        self.goals = tuple(dict.fromkeys(goals))

    def parts_of(self, item: Decision) -> _Parts | None:
        return self._parts.get(id(item))

    def _list(self, name: str, machine: Machine, *, is_root: bool) -> Iterator[Goal]:
        assert machine.design is not None
        for located in iter_decisions(machine.design):
            around = (group for group, _then in located.groups)
            source = next((each for each in machine.design.states if each.name == located.source), None)
            if all(map(machine.is_enabled, (located.decision, *around))) and not (source and source.disabled):
                yield from self._list_decision(name, machine, located.path, located.decision, located.source)
        for state in machine.design.states:
            if not state.disabled:
                path: DesignPath = ("states", state.name)
                yield Goal(GoalKind.STATE, (name, path), "active", text=f"state {state.name} of {name}")
                if state.capacity:
                    text = f"room in state {state.name} of {name}"
                    yield from (Goal(GoalKind.TEAM, (name, path), outcome, text=text) for outcome in _TEAM_OUTCOMES)
        if machine.period_ns:
            text = f"period of {name}"
            for outcome in ("elapsed", "not elapsed"):
                yield Goal(GoalKind.PERIOD, (name, ("frequency",)), outcome, text=text)
            for outcome in _TIMER_OUTCOMES:
                yield Goal(GoalKind.TIMER, (name, ("frequency",)), outcome, text=text)
        if not is_root:
            outcome = "resumed" if machine.design.resume else "restarted"
            yield Goal(GoalKind.ACTIVATION, (name, ()), outcome, text=f"{name}")

    def _list_decision(
        self, name: str, machine: Machine, path: DesignPath, item: Decision, source: str
    ) -> Iterator[Goal]:
        guard, subject = item.guard, (name, path)
        place = source if source.startswith("@") is False else "the common transitions"
        shown = shorten(guard.when, _WIDTH, placeholder="…") or ("code" if guard.code else "")
        after = f"after {guard.after}" if guard.after else ""
        text = f"guard {' and '.join(filter(None, (after, shown)))} in {place}" if not guard.is_empty else ""
        if not guard.is_empty:
            for outcome in _guard_outcomes(machine, guard):
                yield Goal(GoalKind.GUARD, subject, outcome, text=text)
        match item:
            case Transition(to=to) if to != source:
                yield Goal(GoalKind.TRANSITION, subject, "taken", text=f"transition from {place} to {to}")
            case DecisionGroup(then=then) if not any(map(is_exhaustive, then)):
                text_of_group = f"group {shown or after} in {place}".replace("  ", " ")
                yield Goal(GoalKind.GROUP, subject, "left without a decision", text=text_of_group)
        if guard.after:
            timer = f"after {guard.after} in {place}"
            yield from (Goal(GoalKind.TIMER, subject, outcome, text=timer) for outcome in _TIMER_OUTCOMES)
        operands, limits = list[tuple[int, Expr]](), list[_Condition]()
        if guard.when:
            tree = machine.tree(guard.when, BOOL)
            for number, operand in enumerate(_operands(tree)):
                operands.append((number, operand))
                words = f"{guard.when[slice(*operand.span)]} in {place}"
                for outcome in ("true", "false"):
                    yield Goal(GoalKind.OPERAND, subject, outcome, number, text=words)
            for number, (left, right) in enumerate(_number_pairs(tree)):
                words = f"{guard.when[left.span[0] : right.span[1]]} in {place}"
                goal = Goal(GoalKind.LIMIT, subject, "at the limit", number, text=words)
                limits.append(_Condition(left, right, goal))
                yield goal
        self._parts[id(item)] = _Parts(path, tuple(operands), tuple(limits))


def _guard_outcomes(machine: Machine, guard: Guard) -> tuple[str, ...]:
    if guard.when and not guard.after:
        tree = machine.tree(guard.when, BOOL)
        if isinstance(tree, Boolean):
            return ("true",) if tree.value else ("false",)
    return ("true", "false")


_WIDTH = 60
_TEAM_OUTCOMES = ("wanted by two robots", "taken while another robot waits")
_TIMER_OUTCOMES = ("met exactly", "missed by 1 ns")


def _operands(tree: Expr) -> Iterator[Expr]:
    """The operands of `and`, `or` and `not`, and the tests of conditional expressions."""
    for node in walk(tree):
        match node:
            case Logic(operands=operands):
                yield from operands
            case Ternary(test=test):
                yield test


def _number_pairs(tree: Expr) -> Iterator[tuple[Expr, Expr]]:
    for node in walk(tree):
        if isinstance(node, Comparison):
            for left, right in pairwise(node.operands):
                if left.type in (INT, FLOAT) and right.type in (INT, FLOAT):
                    yield left, right


@dataclass
class CoverageRecorder:
    """Collects the goals that happen in runs of the reference interpreter.

    Attributes:
        seen: The goals that happened.
        gaps: The differences of both sides of comparisons, when they were tested last.
    """

    goals: DesignGoals
    seen: set[Goal] = field(default_factory=set)
    gaps: dict[Goal, float] = field(default_factory=dict)
    _taken: dict[tuple[int, str], DesignPath] = field(default_factory=dict)

    def make_robots(self, run: ConformanceRun) -> ReferenceRobots:
        """Robots at the start of a run."""
        return ReferenceRobots(
            run.project,
            run.root,
            run.inputs,
            robots=run.robots,
            team_ticks=run.team_ticks,
            on_decision=self.on_decision,
        )

    def follow(self, robots: ReferenceRobots, step: RunStep) -> None:
        """Run an iteration of each robot and collect what happens."""
        worked_ns = [
            {name: each.worked_ns for name, each in robot.memory.components.items()} for robot in robots.robots
        ]
        active = [
            {name for name, each in robot.memory.components.items() if each.stepped_in is not None}
            for robot in robots.robots
        ]
        self._taken.clear()
        records = robots.step(step)
        for number, record in enumerate(records):
            self._end_iteration(robots.robots[number], record, worked_ns[number], active[number])
        self._see_team(robots, records)

    def on_decision(self, step: ComponentStep, item: Decision, outcome: Outcome) -> None:
        """Collect what a decision shows."""
        parts = self.goals.parts_of(item)
        if parts is None:
            return
        subject = (step.name, parts.path)
        if outcome == "passed":
            self.seen.add(Goal(GoalKind.GROUP, subject, "left without a decision"))
            return
        self.seen.add(Goal(GoalKind.GUARD, subject, outcome))
        if outcome == "true" and isinstance(item, Transition):
            self._taken[id(step.robot), step.name] = parts.path
        if item.guard.after:
            self._compare_times(subject, step.timer_ns(item.guard.after), _time_in_state(step))
        self._see_parts(step, subject, parts)

    def _see_parts(self, step: ComponentStep, subject: tuple[str, DesignPath], parts: _Parts) -> None:
        for number, operand in parts.operands:
            if _is_repeatable(step, operand):
                value = evaluate(operand, BOOL, step.memory.values, step)
                self.seen.add(Goal(GoalKind.OPERAND, subject, "true" if value else "false", number))
        for condition in parts.limits:
            self.gaps[condition.goal] = gap = _gap(step, condition)
            if gap == 0:
                self.seen.add(condition.goal)

    def _compare_times(self, subject: tuple[str, DesignPath], limit_ns: float, elapsed_ns: float) -> None:
        if elapsed_ns - limit_ns in (0, -1):
            outcome = _TIMER_OUTCOMES[0 if elapsed_ns == limit_ns else 1]
            self.seen.add(Goal(GoalKind.TIMER, subject, outcome))

    def _end_iteration(
        self, robot: Interpreter, record: Mapping[str, Any], worked_ns: Mapping[str, int], active: set[str]
    ) -> None:
        """Collect what the steps of an iteration show.

        Args:
            robot: The robot.
            record: The iteration.
            worked_ns: When each component had worked last, before the iteration.
            active: The components that had been stepped before.
        """
        for step in record["tree"]:
            name = step["component"]
            machine, memory = self.goals.machines[name], robot.memory.components[name]
            if machine.design is None:
                continue
            self.seen.add(Goal(GoalKind.STATE, (name, ("states", step["state"])), "active"))
            taken = self._taken.get((id(robot), name))
            if step["changed_from"] and taken is not None:
                self.seen.add(Goal(GoalKind.TRANSITION, (name, taken), "taken"))
            is_restart = memory.restarted_in == robot.memory.iteration
            if is_restart and name in active:
                outcome = "resumed" if machine.design.resume else "restarted"
                self.seen.add(Goal(GoalKind.ACTIVATION, (name, ()), outcome))
            if machine.period_ns and name in active and (machine.design.resume or not is_restart):
                self._see_period(name, machine, robot.memory.now_ns - worked_ns[name], worked=step["worked"])

    def _see_team(self, robots: ReferenceRobots, records: Sequence[Mapping[str, Any]]) -> None:
        entered = {
            (each["component"], each["state"]) for one in records for each in one["tree"] if each["changed_from"]
        }
        waiting = Counter(place for robot in robots.robots for place in robot.memory.team.waiting)
        for (name, state), count in waiting.items():
            subject: tuple[str, DesignPath] = (name, ("states", state))
            if count > 1:
                self.seen.add(Goal(GoalKind.TEAM, subject, _TEAM_OUTCOMES[0]))
            if (name, state) in entered:
                self.seen.add(Goal(GoalKind.TEAM, subject, _TEAM_OUTCOMES[1]))

    def _see_period(self, name: str, machine: Machine, elapsed_ns: int, *, worked: bool) -> None:
        subject: tuple[str, DesignPath] = (name, ("frequency",))
        self.seen.add(Goal(GoalKind.PERIOD, subject, "elapsed" if worked else "not elapsed"))
        self._compare_times(subject, machine.period_ns, elapsed_ns)


def _gap(step: ComponentStep, condition: _Condition) -> float:
    """Return `left - right` of a comparison, nan if it cannot be evaluated a second time."""
    values = []
    for side in (condition.left, condition.right):
        if not _is_repeatable(step, side):
            return math.nan
        value = evaluate(side, FLOAT, step.memory.values, step)
        assert not isinstance(value, str)
        values.append(value)
    left, right = values
    return 0.0 if left == right else left - right


def _time_in_state(step: ComponentStep) -> int:
    return step.robot.memory.now_ns - step.memory.entered_ns


def _is_repeatable(step: ComponentStep, node: Expr) -> bool:
    """Whether evaluating it again changes nothing: calls of XABSL's functions store their arguments."""
    return not step.has_xabsl_rules or not any(isinstance(each, OutputRef) and each.arguments for each in walk(node))


def measure_coverage(runs: Sequence[ConformanceRun]) -> InputCoverage:
    """Run the reference interpreter on all runs of a design and report what they reach.

    Raises:
        NotInterpretableError: A design has errors, or code that is not portable.
    """
    goals = DesignGoals(build_machines(runs[0].project, runs[0].root), runs[0].root)
    recorder = CoverageRecorder(goals)
    for run in runs:
        robots = recorder.make_robots(run)
        for step in run.steps:
            recorder.follow(robots, step)
    return summarize(goals, recorder.seen)


def summarize(goals: DesignGoals, seen: set[Goal]) -> InputCoverage:
    """Count the goals by kind, and list those that did not happen."""
    never = [goal for goal in goals.goals if goal not in seen]
    incomplete = {goal.item for goal in never}
    counts = []
    for kind in GoalKind:
        items = {goal.item for goal in goals.goals if goal.kind is kind}
        if items:
            counts.append(CoverageCount(kind=kind.value, seen=len(items - incomplete), total=len(items)))
    return InputCoverage(
        counts=tuple(counts),
        never=tuple(
            NeverSeen(
                text=goal.text,
                outcome=goal.outcome,
                component=goal.subject[0],
                path=tuple(map(str, (*goal.subject[1], *_KEYS.get(goal.kind, ())))),
            )
            for goal in never
        ),
    )
