"""The designs of one robot: iterations, inputs, and what other components see of a component."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, Literal

from vicode.model.design import Decision
from vicode.model.project import MISSING, Project
from vicode.semantics.component_step import ComponentStep, Outcome
from vicode.semantics.machine import Machine, build_machines
from vicode.semantics.memory import Arguments, ComponentMemory, RobotMemory
from vicode.semantics.team import RobotReport, TeamMemory
from vicode.semantics.values import InputFunction, Value, stored

Link = Literal["root", "requires", "modulates"]


class Interpreter:
    """Interprets a component and all that it uses.

    Components without a design only provide values: `set_input` sets them, and those with arguments are functions.

    Args:
        project: The project.
        root: The component that is stepped in each iteration.
        priority: The priority of the robot in its team.
        team_ticks: The number of iterations until the other robots have answered.
        on_decision: Is called with each decision of a step and what became of it.

    Raises:
        NotInterpretableError: A component has errors or belongs to another robot.
    """

    def __init__(
        self,
        project: Project,
        root: str,
        *,
        priority: int = 0,
        team_ticks: int = 0,
        on_decision: Callable[[ComponentStep, Decision, Outcome], None] = lambda _step, _item, _outcome: None,
    ) -> None:
        self.root = root
        self.note = on_decision
        self.machines = build_machines(project, root)
        self.memory = RobotMemory(
            components={name: _create_memory(machine) for name, machine in self.machines.items()},
            team=TeamMemory(priority=priority, ticks=team_ticks),
        )
        self._functions: dict[tuple[str, str], InputFunction] = {}
        self._held: dict[str, dict[str, Value]] = {}
        self._tree: list[dict[str, Any]] = []

    def set_input(self, component: str, name: str, value: Value | InputFunction) -> None:
        """Set an output of a component without a design, or a parameter of the root component."""
        if callable(value):
            self._functions[component, name] = value
        else:
            machine = self.machines[component]
            self.memory.components[component].values[name] = stored(value, machine.types[name])

    def hold_input(self, component: str, name: str, value: Value) -> None:
        """Set an output of a component without a design when it is stepped next."""
        self._held.setdefault(component, {})[name] = value

    def step(self, clock_ns: int, reports: Iterable[RobotReport] = ()) -> dict[str, Any]:
        """Run one iteration and return its record (docs/traces.md).

        Args:
            clock_ns: What the clock shows at the start of the iteration.
            reports: What the other robots told after their last iteration.
        """
        self.memory.begin_iteration(clock_ns)
        self.memory.team.begin_iteration(reports)
        self._tree = []
        shared = {name: self._stored_values(name) for name, each in self.machines.items() if each.is_shared_memory}
        self._step(self.root, "", "root", {})
        return {
            "iteration": self.memory.iteration,
            "time_ns": self.memory.now_ns,
            "tree": self._tree,
            "errors": [],
            "inputs": shared,
        }

    def evaluate(self, component: str, text: str, type_: str) -> Value:
        """Evaluate an expression of a component as its guards read it now.

        Raises:
            NotInterpretableError: The expression has errors.
        """
        step = ComponentStep(self, component, self.machines[component], self.memory.components[component])
        return step.evaluate(text, type_)

    def report(self) -> RobotReport:
        """Return what this robot tells its team after an iteration."""
        places = {
            (name, state.name)
            for name, machine in self.machines.items()
            if machine.design and self.memory.components[name].stepped_in == self.memory.iteration
            for state in machine.design.states
            if state.capacity is not None or state.synchronized is not None
        }
        executed = {place for place in places if self.memory.components[place[0]].state == place[1]}
        return RobotReport(
            priority=self.memory.team.priority,
            executed=frozenset(executed),
            entering=frozenset((self.memory.team.waiting & places) - executed),
            near=frozenset(places),
        )

    # What a step of a component needs

    def require(self, component: str, by: str) -> None:
        self._step(component, by, "requires", {})

    def call(self, component: str, by: str, parameters: Arguments) -> None:
        if self.machines[component].holds_parameters:
            self.memory.components[component].values |= parameters
        self._step(component, by, "modulates", parameters)

    def is_done(self, component: str) -> bool:
        """Whether a component was in a final state after its latest step, in this or the previous iteration."""
        machine, memory = self.machines[component], self.memory.components[component]
        if machine.design is None or memory.stepped_in is None or not machine.state(memory.state).final:
            return False
        if machine.has_xabsl_rules and memory.stepped_in == memory.restarted_in == self.memory.iteration:
            return False
        return memory.stepped_in >= self.memory.iteration - 1

    def read(self, component: str, name: str) -> Value:
        return self.memory.components[component].values[name]

    def ask(self, component: str, name: str, arguments: Arguments) -> Value:
        machine = self.machines[component]
        output = machine.interface.output(name)
        assert output is not None
        if machine.interface.implementation == MISSING:
            return machine.functions[name]
        return stored(self._functions[component, name](arguments), machine.scope.type_of(output))

    def _step(self, component: str, by: str, link: Link, parameters: Arguments) -> None:
        for name, value in self._held.pop(component, {}).items():
            self.set_input(component, name, value)
        step = ComponentStep(self, component, self.machines[component], self.memory.components[component])
        record: dict[str, Any] = {}
        self._tree.append(record)
        step.run()
        memory, now_ns = step.memory, self.memory.now_ns
        record |= {
            "component": component,
            "by": by or None,
            "link": link,
            "worked": step.has_worked,
            "state": memory.state,
            "state_time_ns": now_ns - memory.entered_ns,
            "component_time_ns": now_ns - memory.started_ns,
            "changed_from": step.left or None,
            "transition": step.transition or None,
            "parameters": parameters,
            "done": self.is_done(component),
            "values": self._stored_values(component),
        }

    def _stored_values(self, component: str) -> Mapping[str, Value]:
        values = self.memory.components[component].values
        return {name: values[name] for name in self.machines[component].types}


def _create_memory(machine: Machine) -> ComponentMemory:
    state = machine.design.initial if machine.design else ""
    return ComponentMemory(values=dict(machine.initial), state=state)
