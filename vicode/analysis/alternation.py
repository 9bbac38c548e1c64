"""States that alternate while the inputs hold still.

Two states alternate if each is left for the other in the iteration after it was entered, for the same inputs: usually
their guards overlap where one should exclude the other. Candidates are found with the diagrams: the guards of the
cycle are joined over the inputs, with what actions change left free in each state. What is reported was replayed: the
reference interpreter goes to the first state and gets inputs from the diagram once, and then the states alternate.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

from vicode.analysis.conditions import STATE_TIME
from vicode.analysis.input_choice import Inputs
from vicode.analysis.interval_diagrams import FALSE, TRUE, Node, TooLargeError
from vicode.analysis.machines import LiveTransition, MachineAnalysis
from vicode.analysis.quantities import Quantity
from vicode.analysis.walk import Walk, WalkStep
from vicode.findings import DesignPath
from vicode.model.design import COMMON, Assign
from vicode.model.expressions import Done, ElapsedTime, OutputRef, StatusFlag, Variable
from vicode.model.project import Project
from vicode.model.traversal import iter_actions
from vicode.semantics import NotInterpretableError, Value

_ITERATIONS = 12
_MOST_CYCLES = 10_000


@dataclass(frozen=True, slots=True, kw_only=True)
class Alternation:
    """A cycle of states that was replayed.

    Attributes:
        states: The states in their order.
        paths: The transitions that are taken, one for each state.
        steps: The run: the way to the first state, and iterations in which the states alternate.
    """

    states: tuple[str, ...]
    paths: tuple[DesignPath, ...]
    steps: tuple[WalkStep, ...]

    @property
    def held(self) -> Inputs:
        """The inputs that hold still while the states alternate."""
        held: dict[tuple[str, str], Value] = {}
        for step in self.steps:
            held |= step.inputs
        return held


class AlternationSearch:
    """Finds the alternations of a design.

    Args:
        project: The project, with all designs.
        machine: A design of it without errors.
    """

    def __init__(self, project: Project, machine: MachineAnalysis) -> None:
        self._project = project
        self._machine = machine
        self._design = machine.design
        self._conditions = machine.guards.conditions
        self._diagrams = self._conditions.diagrams

    def find(self) -> Iterator[Alternation]:
        """Yield the alternations of two and three states; none if a design has errors or code that is not portable."""
        try:
            tick_ns = Walk(self._project, self._machine).tick_ns
            for cycle in islice(self._find_cycles(tick_ns), _MOST_CYCLES):
                found = self._replay(cycle, tick_ns)
                if found is not None:
                    yield found
        except NotInterpretableError:
            return

    def _replay(self, cycle: Sequence[tuple[str, LiveTransition]], tick_ns: int) -> Alternation | None:
        self._diagrams.begin_question()
        try:
            held = self._hold(cycle, tick_ns)
        except (TooLargeError, RecursionError):
            return None
        if held == FALSE:
            return None
        states = [state for state, _edge in cycle]
        expected = [states[(index + 1) % len(states)] for index in range(_ITERATIONS)]
        walk = Walk(self._project, self._machine)
        if not walk.go_to(states[0]) or not walk.hold(held, expected):
            return None
        paths = tuple(edge.path for _state, edge in cycle)
        return Alternation(states=tuple(states), paths=paths, steps=tuple(walk.steps))

    def _find_cycles(self, tick_ns: int) -> Iterator[tuple[tuple[str, LiveTransition], ...]]:
        """Cycles of two and three states of which none is left whatever the inputs are, each once."""
        order = {state.name: index for index, state in enumerate(self._design.states)}
        edges = {
            name: [each for each in self._machine.live[name] if each.target in self._machine.reachable]
            for name in self._machine.reachable
            if not self._is_passing(name, tick_ns)
        }
        for first in sorted(edges, key=order.__getitem__):
            steps = ((edge, second) for edge in edges[first] for second in edges.get(edge.target, ()))
            for edge, second in steps:
                # Each cycle once: from its first state in the design.
                if order[first] >= min(order[each] for each in {edge.target, second.target} - {first}):
                    continue
                if second.target == first:
                    yield ((first, edge), (edge.target, second))
                for third in edges.get(second.target, ()) if second.target != first else ():
                    if third.target == first:
                        yield ((first, edge), (edge.target, second), (second.target, third))

    def _is_passing(self, state: str, tick_ns: int) -> bool:
        """Whether a state is left at once on purpose."""
        time = self._machine.time_in(state)
        return time is not None and time.at_most_ns is not None and time.at_most_ns <= tick_ns

    # The inputs

    def _hold(self, cycle: Sequence[tuple[str, LiveTransition]], tick_ns: int) -> Node:
        """The inputs for which each transition of a cycle is taken one iteration after its state was entered."""
        changing = self._find_changing({state for state, _edge in cycle})
        early = self._diagrams.test(STATE_TIME, (((tick_ns, 0), (tick_ns + 1, 0)),))
        held = TRUE
        for _state, edge in cycle:
            taken = self._diagrams.both(edge.taken, early)
            taken = self._diagrams.both(taken, self._conditions.possible((taken,), with_nan=False))
            held = self._diagrams.both(held, self._diagrams.exists(taken, changing))
        return held

    def _find_changing(self, states: set[str]) -> frozenset[int]:
        """The levels of quantities that may differ between the states: times, flags, what actions set."""
        assigned = {
            name
            for placed in iter_actions(self._design)
            if isinstance(placed.action, Assign) and placed.state in (*states, COMMON)
            for name, _text in placed.action.values
        }
        return frozenset(
            level for level, quantity in self._conditions.quantities.items() if not self._is_input(quantity, assigned)
        )

    def _is_input(self, quantity: Quantity, assigned: set[str]) -> bool:
        match quantity.tree:
            case Variable(name=name):
                return name not in assigned
            case OutputRef(alias=alias):
                use = self._design.use(alias)
                return use is not None and self._project.design(use.component) is None
            case ElapsedTime() | StatusFlag() | Done() | None:
                return False
            case _:
                return True
