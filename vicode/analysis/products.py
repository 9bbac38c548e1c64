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


@dataclass(frozen=True, slots=True, kw_only=True)
class Move:
    """A component of a robot changes to the state `to`; `source` and `target` number the states of the robot."""

    source: int
    target: int
    component: str
    to: str

    @property
    def place(self) -> Place:
        return (self.component, self.to)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Machine:
    """The machine of a robot.

    Attributes:
        name: The name of its agent.
        states: The active components with their states, for each state of the robot; the first is the initial one.
        moves: All moves that can be taken, of which no two from the same source enter the same place.
    """

    name: str
    states: tuple[Mapping[str, str], ...]
    moves: tuple[Move, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """Moves that are taken at the same time: one of a robot, or those of all robots that enter a state together.

    Attributes:
        moves: The moves by their sources, which number the states of all machines.
        place: The state that is entered.
        cooperation: What is required to enter it.
    """

    moves: Mapping[int, Move]
    place: Place
    cooperation: Cooperation | None

    @property
    def is_barrier(self) -> bool:
        return self.cooperation is not None and self.cooperation.is_barrier


class Product:
    """The steps of a team.

    Args:
        robots: The machine of each robot.
        places: The states with `capacity` or `synchronized` that the machines have.
    """

    def __init__(self, robots: Sequence[Machine], places: Mapping[Place, Cooperation]) -> None:
        offsets: dict[Machine, int] = {}
        self.states: list[Mapping[str, str]] = []
        for machine in dict.fromkeys(robots):
            offsets[machine] = len(self.states)
            self.states += machine.states
        self.robots = tuple(robots)
        self.start = tuple(offsets[machine] for machine in robots)
        self._occupying = {place: self.find_states(*place) for place in places}
        self._near = {place: self.find_states(place[0]) for place in places}
        self.steps = tuple(self._list_steps(offsets, places))
        self.leaving: dict[int, set[int]] = {each: set() for each in range(len(self.states))}
        for number, step in enumerate(self.steps):
            for source in step.moves:
                self.leaving[source].add(number)
        self._filling = tuple(self._find_crossing(states, into=True) for states in self._occupying.values())
        barriers = (number for number, step in enumerate(self.steps) if step.is_barrier)
        self._changing = {number: self._find_changing(self.steps[number]) for number in barriers}
        self._find_conflicts = cache(self._list_conflicts)
        self._find_leading = cache(self._list_leading)

    def find_states(self, component: str, name: str = "") -> frozenset[int]:
        """The states in which a component is active, or is in one of its states."""
        return frozenset(
            number
            for number, active in enumerate(self.states)
            if component in active and name in ("", active[component])
        )

    def is_enabled(self, number: int, at: Configuration) -> bool:
        """Whether a step can be taken."""
        step = self.steps[number]
        if step.cooperation is None or not step.is_barrier:
            return any(source in at for source in step.moves) and self._has_room(step, at)
        near = [each for each in at if each in self._near[step.place]]
        return (
            len(near) >= step.cooperation.number
            and any(each in step.moves for each in near)
            and all(each in step.moves or each in self._occupying[step.place] for each in near)
        )

    def list_enabled(self, at: Configuration) -> list[int]:
        """All steps that can be taken."""
        candidates = sorted(set().union(*(self.leaving[each] for each in at)))
        return [number for number in candidates if self.is_enabled(number, at)]

    def take(self, number: int, at: Sequence[int]) -> tuple[int, ...]:
        """The states of the robots after a step, in the same order."""
        step, after = self.steps[number], list(at)
        moving = [index for index, each in enumerate(at) if each in step.moves]
        for index in moving if step.is_barrier else moving[:1]:
            after[index] = step.moves[at[index]].target
        return tuple(after)

    def find_stubborn(self, at: Configuration, seeds: Iterable[int]) -> list[int]:
        """The enabled steps of the smallest stubborn set that contains one of the seeds, which are enabled."""
        best: list[int] = []
        enabled = frozenset(self.list_enabled(at))
        # All steps of a robot are in the same stubborn sets.
        for seed in {next(iter(self.steps[each].moves)): each for each in seeds}.values():
            found = self._close(at, seed, enabled)
            if not best or len(found) < len(best):
                best = found
            if len(best) == 1:
                break
        return best

    def _close(self, at: Configuration, seed: int, enabled: frozenset[int]) -> list[int]:
        closed, pending = {seed}, [seed]
        while pending:
            number = pending.pop()
            more = self._find_conflicts(number) if number in enabled else self._find_enabling(number, at)
            pending += more - closed
            closed |= more
        return sorted(closed & enabled)

    def _list_conflicts(self, number: int) -> set[int]:
        """The steps that do not commute with a step, or of which one prevents the other."""
        found = set().union(*(self.leaving[source] for source in self.steps[number].moves))
        found |= self._changing.get(number, set())
        found.update(barrier for barrier, changing in self._changing.items() if number in changing)
        return found.union(*(filling for filling in self._filling if number in filling))

    def _find_enabling(self, number: int, at: Configuration) -> set[int]:
        """Steps that are next for some robot, of which one has to be taken before a step that is not enabled."""
        step, starts, goal = self.steps[number], set(at), frozenset(self.steps[number].moves)
        inside = self._occupying.get(step.place, frozenset())
        if step.cooperation is not None and step.is_barrier:
            near = self._near[step.place]
            for each in (starts & near) - inside - goal:
                return self.leaving[each]
            if sum(each in near for each in at) < step.cooperation.number:
                starts, goal = starts - near, near
        elif starts & goal:
            return set().union(*(self.leaving[each] for each in starts & inside))
        return self._find_leading(goal).intersection(set().union(*(self.leaving[each] for each in starts)))

    def _list_leading(self, goal: frozenset[int]) -> set[int]:
        """The steps with which a robot can get to one of some states, sooner or later."""
        reached, leading = set(goal), set[int]()
        while True:
            found = {n for n, step in enumerate(self.steps) for move in step.moves.values() if move.target in reached}
            if found == leading:
                return found
            leading = found
            reached |= {source for n in found for source, move in self.steps[n].moves.items() if move.target in reached}

    def _has_room(self, step: Step, at: Configuration) -> bool:
        occupied = sum(each in self._occupying[step.place] for each in at) if step.cooperation else 0
        return step.cooperation is None or occupied < step.cooperation.number

    def _find_crossing(self, states: frozenset[int], *, into: bool) -> set[int]:
        """The steps by which a robot gets into some states, or out of them."""
        return {
            number
            for number, step in enumerate(self.steps)
            if any(
                (move.target in states) is into and (move.source in states) is not into for move in step.moves.values()
            )
        }

    def _find_changing(self, barrier: Step) -> set[int]:
        """The steps that change whether a robot counts at a barrier, is ready, or has entered."""
        counted = (self._near[barrier.place], self._occupying[barrier.place], frozenset(barrier.moves))
        return set().union(*(self._find_crossing(each, into=into) for each in counted for into in (True, False)))

    def _list_steps(self, offsets: Mapping[Machine, int], places: Mapping[Place, Cooperation]) -> Iterator[Step]:
        together: dict[Place, dict[int, Move]] = {}
        for machine, offset in offsets.items():
            for each in machine.moves:
                move = Move(
                    source=each.source + offset, target=each.target + offset, component=each.component, to=each.to
                )
                cooperation = places.get(move.place)
                if cooperation is not None and cooperation.is_barrier:
                    together.setdefault(move.place, {})[move.source] = move
                else:
                    yield Step(moves={move.source: move}, place=move.place, cooperation=cooperation)
        for place, moves in together.items():
            yield Step(moves=moves, place=place, cooperation=places[place])
