"""One step of a component: the section "A step of a component".

It is written as the page is: a method for each rule, in the order of the rules, so that both can be read side by side.
Decisions are reported with their outcome while they are tested; `vicode.conformance` derives from this what inputs
reach.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, Protocol

from vicode.model.design import (
    Action,
    Assign,
    Call,
    Decision,
    DecisionGroup,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
)
from vicode.model.expressions import BOOL, FLOAT, TEAM_SIZE
from vicode.model.portable_code import PortableAssign, PortableCall, PortableIf, PortableReturn, PortableStatement
from vicode.semantics.evaluation import GivenArguments, evaluate
from vicode.semantics.machine import Machine
from vicode.semantics.memory import Arguments, ComponentMemory, RobotMemory
from vicode.semantics.values import Value, stored

Outcome = Literal["true", "false", "passed"]
"""What became of a decision: its guard held or not; a group was left without a decision after its guard held."""


class StepRobot(Protocol):
    """The robot, as far as a step of one of its components needs it."""

    memory: RobotMemory
    machines: dict[str, Machine]

    def require(self, component: str, by: str) -> None:
        """Step a component that a state requires."""
        ...

    def call(self, component: str, by: str, parameters: Arguments) -> None:
        """Set the parameters of a component and step it."""
        ...

    def is_done(self, component: str) -> bool: ...

    def read(self, component: str, name: str) -> Value: ...

    def ask(self, component: str, name: str, arguments: Arguments) -> Value:
        """Return an output with arguments."""
        ...

    def note(self, step: "ComponentStep", item: Decision, outcome: Outcome) -> None:
        """Take note of a decision, which has no effect."""
        ...


@dataclass(slots=True)
class ComponentStep:
    """A step; it also reads for the expressions of the component (`ComponentReader`).

    Attributes:
        has_worked: Whether the period had elapsed.
        left: The state that was left, "" without a change.
        transition: The id of the transition that was taken.
    """

    robot: StepRobot
    name: str
    machine: Machine
    memory: ComponentMemory
    has_worked: bool = False
    left: str = ""
    transition: str = ""

    def run(self) -> None:
        if self._is_restart():
            self._restart()
        self.memory.stepped_in = self.robot.memory.iteration
        self._require(self._state.requires if self._state else ())
        now_ns = self.robot.memory.now_ns
        self.has_worked = now_ns - self.memory.worked_ns >= self.machine.period_ns
        if self.has_worked:
            self.memory.worked_ns = now_ns
            self.memory.calls = []
            self._work()
        else:
            for component, parameters in list(self.memory.calls):
                self.robot.call(component, self.name, parameters)

    @property
    def _state(self) -> State | None:
        return self.machine.state(self.memory.state) if self.machine.design else None

    # 0. Restart

    def _is_restart(self) -> bool:
        memory, iteration = self.memory, self.robot.memory.iteration
        if memory.stepped_in is None:
            return True
        if memory.stepped_in == iteration:
            # "Designs with other rules": a component that was not active before restarts at each step.
            return self.machine.has_xabsl_rules and memory.restarted_in == iteration
        return memory.stepped_in < iteration - 1

    def _restart(self) -> None:
        memory, design = self.memory, self.machine.design
        is_first = memory.stepped_in is None
        memory.restarted_in = self.robot.memory.iteration
        if design is not None and design.resume and not is_first:
            return
        memory.started_ns = memory.entered_ns = self.robot.memory.now_ns
        memory.worked_ns = self.robot.memory.now_ns - self.machine.period_ns
        memory.calls = []
        if design is not None:
            memory.state = design.initial
            self._act(self.machine.state(design.initial).enter)

    # 1. Requirements

    def _require(self, aliases: Iterable[str]) -> None:
        for alias in aliases:
            self.robot.require(self.machine.uses[alias], self.name)

    # 2. Work

    def _work(self) -> None:
        design, state = self.machine.design, self._state
        if design is None or state is None:
            return
        decided = self._decide(design.common.transitions) or self._decide(state.transitions)
        if isinstance(decided, Transition) and decided.to != state.name:
            if self._may_enter(self.machine.state(decided.to)):
                self._change(state, self.machine.state(decided.to), decided.id)
        elif decided is not None or _is_cooperative(state):
            # A robot that stays in a cooperative state tells its team so.
            self._may_enter(state)
        self._act(design.common.actions)
        self._act(self._state.all_actions if self._state else ())

    def _decide(self, items: Iterable[Decision]) -> Transition | Stay | None:
        """Return the first decision that holds."""
        for item in items:
            if not self.machine.is_enabled(item):
                continue
            holds = self._holds(item.guard)
            self.robot.note(self, item, "true" if holds else "false")
            if isinstance(item, DecisionGroup):
                found = self._decide(item.then if holds else item.otherwise)
                if found is not None:
                    return found
                if holds:
                    self.robot.note(self, item, "passed")
            elif holds:
                return item
        return None

    def _holds(self, guard: Guard) -> bool:
        if guard.after and not self._has_elapsed(guard.after):
            return False
        if guard.when and not self.evaluate(guard.when, BOOL):
            return False
        if guard.code is None:
            return True
        return bool(self._run(self.machine.statements(guard.code, "predicate")))

    def _has_elapsed(self, after: str) -> bool:
        return self.robot.memory.now_ns - self.memory.entered_ns >= self.timer_ns(after)

    def timer_ns(self, after: str) -> float:
        """Return the time of `after` in whole nanoseconds; it may be infinite or nan."""
        time = self.evaluate(after, FLOAT)
        assert isinstance(time, float)
        ns = time * self.machine.ns_per_unit
        return round(ns) if math.isfinite(ns) else ns

    def _change(self, old: State, new: State, transition: str) -> None:
        self._act(old.leave)
        self.left, self.transition = old.name, transition
        self.memory.state = new.name
        self.memory.entered_ns = self.robot.memory.now_ns
        self._act(new.enter)
        self._require(alias for alias in new.requires if alias not in old.requires)

    def _may_enter(self, state: State) -> bool:
        team, place = self.robot.memory.team, (self.name, state.name)
        if state.capacity is not None:
            return team.may_enter_with_capacity(place, state.capacity)
        return state.synchronized is None or team.may_enter_together(place, state.synchronized)

    def _act(self, actions: Iterable[Action]) -> None:
        for action in actions:
            match action:
                case Assign(values=pairs):
                    for target, text in pairs:
                        self._set(target, text)
                case Call(alias=alias, arguments=given):
                    self._call(self.machine.uses[alias], given)
                case RunCode(code=code):
                    self._run(self.machine.statements(code, "action"))

    def _set(self, target: str, text: str) -> None:
        alias, _dot, name = target.rpartition(".")
        owner = self.machine.uses[alias] if alias else self.name
        type_ = self.robot.machines[owner].types[name]
        self.robot.memory.components[owner].values[name] = stored(self.evaluate(text, type_), type_)

    def _call(self, component: str, given: Iterable[tuple[str, str]]) -> None:
        called = self.robot.machines[component]
        parameters = dict(called.defaults)
        for name, text in given:
            type_ = called.parameter_types[name]
            parameters[name] = stored(self.evaluate(text, type_), type_)
        self.memory.calls.append((component, parameters))
        self.robot.call(component, self.name, parameters)

    def _run(self, statements: Iterable[PortableStatement]) -> Value | None:
        """Run hand-written code; return what it returns, or None at its end."""
        for statement in statements:
            match statement:
                case PortableAssign(target=target, value=value):
                    self._set(target, value)
                case PortableCall(call=call):
                    self.evaluate(call, None)
                case PortableReturn(value=value):
                    return self.evaluate(value, BOOL) if value else False
                case PortableIf(test=test, then=then, otherwise=otherwise):
                    returned = self._run(then if self.evaluate(test, BOOL) else otherwise)
                    if returned is not None:
                        return returned
        return None

    def evaluate(self, text: str, expected: str | None) -> Value:
        """Evaluate an expression of the component; with None, of its own type."""
        tree = self.machine.tree(text, expected)
        return evaluate(tree, expected or tree.type, self.memory.values, self)

    # What expressions read

    @property
    def has_xabsl_rules(self) -> bool:
        return self.machine.has_xabsl_rules

    def note_large_int(self) -> None:
        self.robot.memory.had_large_ints = True

    def read_time(self, kind: str) -> float:
        since = self.memory.entered_ns if kind == "state" else self.memory.started_ns
        return (self.robot.memory.now_ns - since) / self.machine.ns_per_unit

    def read_status(self, name: str) -> Value:
        if name == TEAM_SIZE:
            return 1 + len(self.robot.memory.team.reports)
        state = self._state
        if state is None:
            return False
        if name == "action_done":
            return any(map(self.robot.is_done, self.machine.called_designs(state, self.robot.machines)))
        return state.capacity is not None and self.robot.memory.team.is_full((self.name, state.name), state.capacity)

    def is_done(self, alias: str) -> bool:
        return self.robot.is_done(self.machine.uses[alias])

    def read_output(self, alias: str, name: str) -> Value:
        return self.robot.read(self.machine.uses[alias], name)

    def call_output(self, alias: str, name: str, given: GivenArguments) -> Value:
        component = self.machine.uses[alias]
        types = self.robot.machines[component].argument_types(name)
        # "Designs with other rules": all calls share one set of arguments.
        shared = self.robot.memory.arguments.setdefault((component, name), {}) if self.has_xabsl_rules else {}
        for argument, evaluate_as in given:
            shared[argument] = stored(evaluate_as(types[argument]), types[argument])
        return self.robot.ask(component, name, {argument: shared[argument] for argument, _value in given})


def _is_cooperative(state: State) -> bool:
    return state.capacity is not None or state.synchronized is not None
