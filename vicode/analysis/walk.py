"""Runs of the reference interpreter that follow the transitions of a design: witnesses of what is possible.

A diagram yields the inputs and the time for which a transition is taken; the interpreter decides whether it is. So a
mistake of the analysis cannot become a witness.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice

from vicode.analysis.conditions import STATE_TIME, Conditions
from vicode.analysis.input_choice import InputChooser, Inputs
from vicode.analysis.interval_diagrams import Node
from vicode.analysis.machines import LiveTransition, MachineAnalysis
from vicode.findings import DesignPath
from vicode.model.design import Decision
from vicode.model.expressions import BOOL
from vicode.model.project import Project
from vicode.semantics import (
    ComponentStep,
    InputFunction,
    Interpreter,
    NotInterpretableError,
    Outcome,
    RobotMemory,
    Value,
)

OnDecision = Callable[[ComponentStep, Decision, Outcome], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class WalkStep:
    """One iteration: its time, the inputs that were set before it, and the state after it."""

    time_ns: int
    inputs: Inputs
    state: str


SavedWalk = tuple[RobotMemory, tuple[WalkStep, ...]]


class Walk:
    """A run of one component that continues transition by transition.

    Args:
        project: The project, with all designs.
        machine: The design that is the root.
        on_decision: Is called with each decision of a step and what became of it.
        may_leave_out: Whether steps with code that is not portable are left out; otherwise, they raise an error.

    Attributes:
        left_out: Why steps were left out.

    Raises:
        NotInterpretableError: A design has errors, or code that is not portable.
    """

    def __init__(
        self,
        project: Project,
        machine: MachineAnalysis,
        on_decision: OnDecision = lambda *_: None,
        *,
        may_leave_out: bool = False,
    ) -> None:
        self._may_leave_out = may_leave_out
        self.left_out = set[str]()
        self._project = project
        self._machine = machine
        self._design = machine.design
        self._conditions: Conditions = machine.guards.conditions
        self._robot = Interpreter(project, self._design.component, on_decision=on_decision)
        for name, each in self._robot.machines.items():
            for function, value in each.functions.items():
                self._robot.set_input(name, function, _always(value))
        self._inputs = InputChooser(project, machine)
        self.tick_ns = self._inputs.tick_ns
        self.steps: list[WalkStep] = []

    @property
    def state(self) -> str:
        return self.memory.components[self._design.component].state

    def go_to(self, state: str) -> bool:
        """Follow a shortest way of live transitions to a state; False if a transition on it could not be taken."""
        if self.steps:
            return self._follow_way(state)
        start = self.save()
        for inputs in self.find_first_inputs(edge.taken for edge in self._shortest_way(state)[:1]):
            self.step(inputs, 0)
            if self._follow_way(state):
                return True
            self.restore(start)
        return False

    def find_first_inputs(self, nodes: Iterable[Node]) -> Iterator[Inputs]:
        """Inputs of the first iteration, in which the initial state is kept or can already be left as diagrams say."""
        at_start = self._conditions.diagrams.test(STATE_TIME, (((0, 0), (1, 0)),))
        for node in (self._machine.staying(self.state), *nodes):
            found = self._inputs.find(self.memory, self._conditions.diagrams.both(node, at_start))
            yield from (inputs for inputs, _time_ns in islice(found, 1))
        yield {}

    def _follow_way(self, state: str) -> bool:
        failed: set[DesignPath] = set()
        most = len(self.steps) + 2 * len(self._design.states)
        while self.state != state:
            edge = next(iter(self._shortest_way(state, failed)), None)
            if edge is None or len(self.steps) > most:
                return False
            if self.take(edge):
                failed.clear()
            else:
                failed.add(edge.path)
        return True

    @property
    def active(self) -> Mapping[str, str]:
        """The states of the designs that were stepped in the last iteration."""
        components = self.memory.components.items()
        return {
            name: each.state for name, each in components if each.state and each.stepped_in == self.memory.iteration
        }

    @property
    def memory(self) -> RobotMemory:
        return self._robot.memory

    def take(self, edge: LiveTransition) -> bool:
        """Take a transition in the next iteration; without effect if no inputs are found."""
        return self.meet(edge.taken, lambda: self.state == edge.target)

    def meet(self, node: Node, is_met: Callable[[], bool]) -> bool:
        """Run an iteration with values of a diagram after which a condition holds; without effect if none is found."""
        for inputs, time_ns in self._inputs.find(self.memory, node):
            before = self.save()
            if self.try_step(inputs, time_ns) and is_met():
                return True
            self.restore(before)
        return False

    def hold(self, node: Node, states: Sequence[str]) -> bool:
        """Set inputs that are in a diagram once; whether the next iterations are in these states, one after another."""
        for inputs, _time_ns in self._inputs.find(self.memory, node):
            before = self.save()
            for index, state in enumerate(states):
                self.step(inputs if index == 0 else {}, self.memory.now_ns + self.tick_ns)
                if self.state != state:
                    break
            else:
                return True
            self.restore(before)
        return False

    def find_inputs_to_stay(self, state: str, fixed: Inputs, iterations: int) -> Iterator[Inputs]:
        """Yield inputs, the fixed ones among them, for which the root stays in a state for some iterations."""
        early = self._conditions.diagrams.test(STATE_TIME, (((0, 0), (self.tick_ns * (iterations + 1), 0)),))
        node = self._conditions.diagrams.both(self._machine.staying(state), early)
        for inputs, _time_ns in self._inputs.find(self.memory, node, fixed):
            yield {**inputs, **fixed}

    def follow(self, component: str, expected: Sequence[str], states: Mapping[str, str], inputs: Inputs) -> bool:
        """Put components into states that they have just entered; whether the next states of one are the expected ones.

        The inputs hold still. Without effect if they are not.
        """
        before = self.save()
        self.step(inputs, self.memory.now_ns + self.tick_ns)
        memories = self.memory.components
        for name, state in states.items():
            # A component that was not active before would restart.
            memories[name].state, memories[name].stepped_in = state, self.memory.iteration
            memories[name].entered_ns = self.memory.now_ns
        for state in expected:
            self.step({}, self.memory.now_ns + self.tick_ns)
            memory = self.memory.components[component]
            if memory.state != state or memory.stepped_in != self.memory.iteration:
                self.restore(before)
                return False
        return True

    def holds(self, condition: str) -> bool:
        """Whether a condition of the root holds after the last step."""
        return self._robot.evaluate(self._design.component, condition, BOOL) is True

    def step(self, inputs: Inputs, time_ns: int) -> None:
        """Run an iteration."""
        for (component, name), value in inputs.items():
            machine = self._robot.machines[component]
            self._robot.set_input(component, name, _always(value) if name in machine.functions else value)
        self._robot.step(time_ns)
        self.steps.append(WalkStep(time_ns=time_ns, inputs=inputs, state=self.state))

    def try_step(self, inputs: Inputs, time_ns: int) -> bool:
        """Run an iteration; False if it runs code that is not portable, after which the walk must be restored."""
        try:
            self.step(inputs, time_ns)
        except NotInterpretableError as error:
            if not self._may_leave_out:
                raise
            self.left_out.add(str(error))
            return False
        return True

    def save(self) -> SavedWalk:
        return self.memory.copy(), tuple(self.steps)

    def restore(self, saved: SavedWalk) -> None:
        """Continue where the walk was saved."""
        self._robot.memory = saved[0].copy()
        self.steps[:] = saved[1]

    def _shortest_way(self, goal: str, without: Collection[DesignPath] = ()) -> list[LiveTransition]:
        ways: dict[str, list[LiveTransition]] = {self.state: []}
        pending = [self.state]
        while pending and goal not in ways:
            following: list[str] = []
            for name in pending:
                for edge in self._machine.live.get(name, ()):
                    if edge.target not in ways and (name != self.state or edge.path not in without):
                        ways[edge.target] = [*ways[name], edge]
                        following.append(edge.target)
            pending = following
        return ways.get(goal, [])


def _always(value: Value) -> InputFunction:
    return lambda _arguments: value
