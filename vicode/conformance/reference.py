"""Runs designs in the reference interpreter."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from vicode.conformance.inputs import PARAMETERS, ConformanceRun, InputKey, InputKind, RunInput, RunStep, derive_value
from vicode.conformance.traces import TraceIteration, TraceNormalizer
from vicode.model.design import Decision
from vicode.model.project import Project
from vicode.semantics import ComponentStep, Interpreter, Outcome, RobotMemory, RobotReport

OnDecision = Callable[[ComponentStep, Decision, Outcome], None]


@dataclass(frozen=True, slots=True)
class ReferenceState:
    """The memories of robots, their inputs, and what they told each other."""

    memories: tuple[RobotMemory, ...]
    inputs: tuple[Mapping[InputKey, Any], ...]
    sent: tuple[RobotReport, ...]


class ReferenceRobots:
    """Robots that run one component in the reference interpreter.

    Raises:
        NotInterpretableError: A design has errors, or code that is not portable.
    """

    def __init__(
        self,
        project: Project,
        root: str,
        inputs: tuple[RunInput, ...],
        *,
        robots: int = 1,
        team_ticks: int = 0,
        on_decision: OnDecision = lambda _step, _item, _outcome: None,
        holds_outputs: bool = False,
    ) -> None:
        self._holds_outputs = holds_outputs
        self._inputs = {each.key: each for each in inputs}
        self.robots = [
            Interpreter(project, root, priority=number, team_ticks=team_ticks, on_decision=on_decision)
            for number in range(robots)
        ]
        self.values: list[dict[InputKey, Any]] = [{} for _robot in self.robots]
        for number in range(robots):
            self.set_inputs(number, {key: each.initial for key, each in self._inputs.items()})
        self._sent = [robot.report() for robot in self.robots]

    def step(self, step: RunStep) -> list[dict[str, Any]]:
        """Run an iteration of each robot; return their records."""
        received, records = list(self._sent), []
        for number, robot in enumerate(self.robots):
            self.set_inputs(number, step.inputs[number])
            others = [report for sender, report in enumerate(received) if sender != number]
            records.append(robot.step(step.time_ns, others))
            self._sent[number] = robot.report()
        return records

    def set_inputs(self, number: int, values: Mapping[InputKey, Any]) -> None:
        """Set inputs of a robot."""
        robot = self.robots[number]
        for key, value in values.items():
            component, each = robot.root if key[0] == PARAMETERS else key[0], self._inputs[key]
            is_held = self._holds_outputs and each.kind is InputKind.STUB and each.arguments is None
            if is_held and robot.memory.iteration:
                robot.hold_input(component, each.name, value)
                continue
            robot.set_input(
                component, each.name, value if each.arguments is None else partial(derive_value, each, value)
            )
        self.values[number].update(values)

    def save(self) -> ReferenceState:
        """Return the state, which the robots do not change any more."""
        return ReferenceState(
            memories=tuple(robot.memory.copy() for robot in self.robots),
            inputs=tuple(dict(each) for each in self.values),
            sent=tuple(self._sent),
        )

    def restore(self, state: ReferenceState) -> None:
        """Continue from a state."""
        self._sent = list(state.sent)
        for number, robot in enumerate(self.robots):
            robot.memory = state.memories[number].copy()
            functions = {key: value for key, value in state.inputs[number].items() if self._inputs[key].arguments}
            self.set_inputs(number, functions)
            self.values[number] = dict(state.inputs[number])


def run_reference(run: ConformanceRun, on_decision: OnDecision = lambda *_: None) -> list[TraceIteration]:
    """Interpret the designs of a run.

    Raises:
        NotInterpretableError: A design has errors, or code that is not portable.
    """
    robots = ReferenceRobots(
        run.project,
        run.root,
        run.inputs,
        robots=run.robots,
        team_ticks=run.team_ticks,
        on_decision=on_decision,
        holds_outputs=run.holds_outputs,
    )
    normalizer = TraceNormalizer(run.project)
    iterations: list[TraceIteration] = []
    for step in run.steps:
        records = robots.step(step)
        had_large_ints = any(robot.memory.had_large_ints for robot in robots.robots)
        for number, record in enumerate(records):
            iterations.append(replace(normalizer.iteration(record, number), had_large_ints=had_large_ints))
    return iterations
