"""A team of robots as a product of finite machines, with the states that they coordinate.

A configuration says in which state each robot is. Most steps of different robots are independent: their order makes no
difference. So only the steps of a *stubborn set* of each configuration are explored (A. Valmari, *Stubborn sets for
reduced state space generation*, 1991), which commute with all others until one of them is taken. Robots with the same
machine are interchangeable: a configuration is a sorted tuple.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

Place = tuple[str, str]
"""A component and one of its states."""

Configuration = tuple[int, ...]
"""The local states of all robots, in ascending order."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Cooperation:
    """At most `number` robots are in a state; or, if `is_barrier`, at least `number` enter it together."""

    number: int
    is_barrier: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RobotMachine:
    """The machine of a robot.

    Attributes:
        name: The name of its root component.
        states: The active components with their states, for each state of the robot; the first is the initial one.
        moves: All moves that can be taken: the numbers of two states, by the number of the first and what is entered.
    """

    name: str
    states: tuple[Mapping[str, str], ...]
    moves: Mapping[tuple[int, Place], int]


@dataclass(frozen=True, slots=True, kw_only=True)
class TeamStep:
    """What one robot does, or what all robots do that enter a state together.

    Attributes:
        targets: The next state for each state of the robots.
        place: What is entered.
        cooperation: What is required to enter it.
        is_barrier: Whether all robots in one of the states do the step at once.
    """

    targets: Mapping[int, int]
    place: Place
    cooperation: Cooperation | None
    is_barrier: bool = False


class Product:
    """The steps of a team.

    Args:
        robots: The machine of each robot.
        places: The states with `capacity` or `synchronized` that the machines have.
    """

    def __init__(self, robots: Sequence[RobotMachine], places: Mapping[Place, Cooperation]) -> None:
        offsets: dict[RobotMachine, int] = {}
        self.states: list[Mapping[str, str]] = []
        for machine in dict.fromkeys(robots):
            offsets[machine] = len(self.states)
            self.states += machine.states
        self.robots = tuple(robots)
        self.start = tuple(offsets[machine] for machine in robots)
        self.steps = tuple(_list_steps(offsets, places))
        self.leaving: dict[int, set[int]] = {each: set() for each in range(len(self.states))}
        for number, step in enumerate(self.steps):
            for source in step.targets:
                self.leaving[source].add(number)
        self._inside = {place: self.find_states(*place) for place in places}
        self._near = {place: self.find_states(place[0]) for place in places}
        self._filling = tuple(self._find_crossing(states, into=True) for states in self._inside.values())
        self._changing = {
            number: self._find_changing(step) for number, step in enumerate(self.steps) if step.is_barrier
        }
        self._find_conflicts = cache(self._list_conflicts)
        self._find_leading = cache(self._list_leading)

    def find_states(self, component: str, name: str | None = None) -> frozenset[int]:
        """The states in which a component is active, or is in one of its states."""
        active = ((number, each.get(component)) for number, each in enumerate(self.states))
        return frozenset(number for number, state in active if state is not None and name in (None, state))

    def list_enabled(self, at: Configuration) -> list[int]:
        """All steps that can be taken."""
        candidates = set().union(*(self.leaving[each] for each in at))
        return [number for number in sorted(candidates) if self._is_enabled(self.steps[number], at)]

    def take(self, number: int, at: Sequence[int]) -> tuple[int, ...]:
        """The states of the robots after a step, in the same order."""
        step, after = self.steps[number], list(at)
        moving = [index for index, each in enumerate(at) if each in step.targets]
        for index in moving if step.is_barrier else moving[:1]:
            after[index] = step.targets[at[index]]
        return tuple(after)

    def find_stubborn(self, at: Configuration, seeds: Iterable[int]) -> list[int]:
        """The enabled steps of the smallest stubborn set that contains one of the seeds, which are enabled."""
        enabled = frozenset(self.list_enabled(at))
        # All steps of a robot are in the same stubborn sets.
        seeds = {next(iter(self.steps[each].targets)): each for each in seeds}.values()
        return min((self._close(at, seed, enabled) for seed in seeds), key=len, default=[])

    def _is_enabled(self, step: TeamStep, at: Configuration) -> bool:
        """Whether a step can be taken for which a robot is ready."""
        if step.cooperation is None:
            return True
        inside, near = self._inside[step.place], self._near[step.place]
        if not step.is_barrier:
            return sum(each in inside for each in at) < step.cooperation.number
        waiting = [each for each in at if each in near]
        return len(waiting) >= step.cooperation.number and all(
            each in step.targets or each in inside for each in waiting
        )

    def _close(self, at: Configuration, seed: int, enabled: frozenset[int]) -> list[int]:
        closed, pending = {seed}, [seed]
        while pending:
            number = pending.pop()
            more = self._find_conflicts(number) if number in enabled else self._find_enabling(self.steps[number], at)
            pending += more - closed
            closed |= more
        return sorted(closed & enabled)

    def _list_conflicts(self, number: int) -> set[int]:
        """The steps that do not commute with a step, or of which one prevents the other."""
        found = set().union(*(self.leaving[source] for source in self.steps[number].targets))
        found |= self._changing.get(number, set())
        found.update(barrier for barrier, changing in self._changing.items() if number in changing)
        return found.union(*(filling for filling in self._filling if number in filling))

    def _find_enabling(self, step: TeamStep, at: Configuration) -> set[int]:
        """Steps that are next for some robot, of which one has to be taken before a step that is not enabled."""
        starts, goal = set(at), frozenset(step.targets)
        if step.cooperation is not None and (step.is_barrier or starts & goal):
            inside, near = self._inside[step.place], self._near[step.place]
            if not step.is_barrier:
                return set().union(*(self.leaving[each] for each in starts & inside))
            for each in (starts & near) - inside - goal:
                return self.leaving[each]
            if sum(each in near for each in at) < step.cooperation.number:
                starts, goal = starts - near, near
        return self._find_leading(goal) & set().union(*(self.leaving[each] for each in starts))

    def _list_leading(self, goal: frozenset[int]) -> set[int]:
        """The steps with which a robot can get to one of some states, sooner or later."""
        pending, reached, leading = list(goal), set(goal), set[int]()
        while pending:
            found = self._find_crossing(frozenset((pending.pop(),)), into=True)
            sources = {source for number in found for source in self.steps[number].targets}
            leading |= found
            pending += sources - reached
            reached |= sources
        return leading

    def _find_crossing(self, states: frozenset[int], *, into: bool) -> set[int]:
        """The steps by which a robot gets into some states, or out of them."""
        return {
            number
            for number, step in enumerate(self.steps)
            for source, target in step.targets.items()
            if (target in states) is into and (source in states) is not into
        }

    def _find_changing(self, barrier: TeamStep) -> set[int]:
        """The steps that change whether a robot counts at a barrier, is ready, or has entered."""
        counted = (self._near[barrier.place], self._inside[barrier.place], frozenset(barrier.targets))
        return set().union(*(self._find_crossing(each, into=into) for each in counted for into in (True, False)))


def _list_steps(offsets: Mapping[RobotMachine, int], places: Mapping[Place, Cooperation]) -> Iterator[TeamStep]:
    together: dict[Place, dict[int, int]] = {}
    for machine, offset in offsets.items():
        for (source, place), target in machine.moves.items():
            cooperation = places.get(place)
            if cooperation is not None and cooperation.is_barrier:
                together.setdefault(place, {})[source + offset] = target + offset
            else:
                yield TeamStep(targets={source + offset: target + offset}, place=place, cooperation=cooperation)
    for place, targets in together.items():
        yield TeamStep(targets=targets, place=place, cooperation=places[place], is_barrier=True)
