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
        self._entering: dict[int, set[int]] = {each: set() for each in range(len(self.states))}
        for number, step in enumerate(self.steps):
            for move in step.moves.values():
                self.leaving[move.source].add(number)
                self._entering[move.target].add(number)
        self._filling = {p: self._find_crossing(s, into=True) for p, s in self._occupying.items()}
        self._freeing = {p: self._find_crossing(s, into=False) for p, s in self._occupying.items()}
        self._approaching = {p: self._find_crossing(s, into=True) for p, s in self._near.items()}
        barriers = (number for number, step in enumerate(self.steps) if step.is_barrier)
        self._changing = {number: self._find_changing(self.steps[number]) for number in barriers}
        self._find_conflicts = cache(self._list_conflicts)

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
        """The enabled steps of the smallest stubborn set that contains one of the seeds."""
        best: list[int] = []
        for seed in seeds:
            found = self._close(at, seed)
            if not best or len(found) < len(best):
                best = found
            if len(best) == 1:
                break
        return best

    def _close(self, at: Configuration, seed: int) -> list[int]:
        closed, pending, enabled = {seed}, [seed], []
        while pending:
            number = pending.pop()
            if self.is_enabled(number, at):
                enabled.append(number)
                more = self._find_conflicts(number)
            else:
                more = self._find_enabling(number, at)
            pending += more - closed
            closed |= more
        return enabled

    def _list_conflicts(self, number: int) -> set[int]:
        """The steps that do not commute with a step, or of which one prevents the other."""
        found = set().union(*(self.leaving[source] for source in self.steps[number].moves))
        found |= self._changing.get(number, set())
        found.update(barrier for barrier, changing in self._changing.items() if number in changing)
        return found.union(*(filling for filling in self._filling.values() if number in filling))

    def _find_enabling(self, number: int, at: Configuration) -> set[int]:
        """Steps of which one has to be taken before a step that is not enabled."""
        step = self.steps[number]
        if step.cooperation is not None and step.is_barrier:
            near = [each for each in at if each in self._near[step.place]]
            for each in near:
                if each not in step.moves and each not in self._occupying[step.place]:
                    return self.leaving[each]
            if len(near) < step.cooperation.number:
                return self._approaching[step.place]
        elif any(source in at for source in step.moves):
            return self._freeing[step.place]
        return set().union(*(self._entering[source] for source in step.moves))

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
