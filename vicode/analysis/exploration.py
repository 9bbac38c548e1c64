"""Ways to the states of a design together with those of the designs that it steps.

A guard may read what a used design computes, such as `done(search)`. So the places that are looked for are the states
of all designs that are stepped, with the values that the guards of the root read and no input sets. Each place is
continued by each transition of each design, while the root stays in its state, breadth first: ways are short.
"""

from collections import deque
from collections.abc import Iterator, Mapping
from itertools import chain, islice

from vicode.analysis.input_choice import InputChooser, Inputs
from vicode.analysis.machines import MachineAnalysis
from vicode.analysis.walk import SavedWalk, Walk
from vicode.model.project import Project

_MOST_PLACES = 12
"""The places of a state of the root."""
_MOST_TRIES = 6


class Exploration:
    """Finds the places of a design.

    Args:
        project: The project, with all designs.
        machine: The design that is the root.
        walk: A walk of it without steps.
    """

    def __init__(self, project: Project, machine: MachineAnalysis, walk: Walk) -> None:
        self._machine, self._walk, self._root = machine, walk, machine.design.component
        self._machines = {each.component: MachineAnalysis(project, each) for each in project.designs}
        self._machines[self._root] = machine
        self._choosers = {
            name: InputChooser(project, each, is_root=name == self._root) for name, each in self._machines.items()
        }
        self._known = set[object]()
        self._pending = deque[SavedWalk]()
        self._places: dict[str, list[SavedWalk]] = {}

    def find(self) -> Mapping[str, list[SavedWalk]]:
        """The places by the state of the root, those with the shortest ways first."""
        walk, start = self._walk, self._walk.save()
        for inputs in walk.find_first_inputs([each.taken for each in self._machine.live_in(walk.state)]):
            self._try(start, inputs, 0)
        while self._pending:
            saved = self._pending.popleft()
            walk.restore(saved)
            for inputs, time_ns in list(self._continue(walk.active)):
                self._try(saved, inputs, time_ns)
        return self._places

    def _try(self, saved: SavedWalk, inputs: Inputs, time_ns: int) -> None:
        walk = self._walk
        walk.restore(saved)
        if not walk.try_step(inputs, time_ns):
            return
        place = (tuple(walk.active.items()), tuple(self._choosers[self._root].read_fixed(walk.memory)))
        places = self._places.setdefault(walk.state, [])
        most = _MOST_PLACES if self._choosers[self._root].reads_fixed else 1
        if place not in self._known and len(places) < most:
            self._known.add(place)
            places.append(walk.save())
            self._pending.append(places[-1])

    def _continue(self, active: Mapping[str, str]) -> Iterator[tuple[Inputs, int]]:
        """Inputs and times that take transitions of the active designs, or wait."""
        memory, chooser = self._walk.memory, self._choosers[self._root]
        staying = self._machine.staying(active[self._root])
        for name, state in active.items():
            for edge in self._machines[name].live_in(state):
                for inputs, time_ns in islice(self._choosers[name].find(memory, edge.taken), _MOST_TRIES):
                    if name == self._root:
                        yield inputs, time_ns
                        continue
                    others = chain(chooser.find(memory, staying, inputs), [({}, 0)])
                    kept, _time_ns = next(iter(others))
                    yield {**kept, **inputs}, time_ns
        yield from islice(chooser.find(memory, staying), 1)
