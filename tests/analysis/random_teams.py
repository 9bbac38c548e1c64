"""Random products of robots, explored completely, robot by robot."""

import random
from collections import deque
from collections.abc import Iterator, Mapping

import networkx as nx

from vicode.analysis.products import Cooperation, Place, RobotMachine

COMPONENTS, NAMES = ("Body", "Arm"), ("a", "b", "c")
Robots = tuple[int, ...]
"""The state of each robot, in the order of the robots."""
Taken = tuple[str, Place]
"""Which machine moved, and what it entered; no machine for robots that entered a state together."""


class FullProduct:
    """All configurations, without any reduction."""

    def __init__(self, robots: list[RobotMachine], places: Mapping[Place, Cooperation]) -> None:
        self.robots, self.places = robots, places
        self.graph: nx.MultiDiGraph[Robots] = nx.MultiDiGraph()
        start = (0,) * len(robots)
        self.distance = {start: 0}
        self.graph.add_node(start)
        pending = deque([start])
        while pending:
            at = pending.popleft()
            for taken, after in self._successors(at):
                self.graph.add_edge(at, after, taken=taken)
                if after not in self.distance:
                    self.distance[after] = self.distance[at] + 1
                    pending.append(after)

    def active(self, at: Robots) -> list[Mapping[str, str]]:
        return [robot.states[state] for robot, state in zip(self.robots, at, strict=True)]

    def named(self, at: Robots) -> tuple[tuple[str, int], ...]:
        return tuple(sorted((robot.name, state) for robot, state in zip(self.robots, at, strict=True)))

    def _successors(self, at: Robots) -> Iterator[tuple[Taken, Robots]]:
        active = self.active(at)
        moves = [
            [(place, target) for (source, place), target in robot.moves.items() if source == state]
            for robot, state in zip(self.robots, at, strict=True)
        ]
        for index, (place, target) in ((index, move) for index, of_robot in enumerate(moves) for move in of_robot):
            rule = self.places.get(place)
            inside = sum(each.get(place[0]) == place[1] for each in active)
            if rule is None or (not rule.is_barrier and inside < rule.number):
                yield (self.robots[index].name, place), (*at[:index], target, *at[index + 1 :])
        for place, rule in self.places.items():
            ready = {
                index: target
                for index, of_robot in enumerate(moves)
                for entered, target in of_robot
                if entered == place
            }
            near = [index for index, each in enumerate(active) if place[0] in each]
            is_met = all(index in ready or active[index][place[0]] == place[1] for index in near)
            if rule.is_barrier and ready and is_met and len(near) >= rule.number:
                yield ("", place), tuple(ready.get(index, state) for index, state in enumerate(at))

    def deadlocks(self) -> dict[tuple[tuple[str, int], ...], int]:
        """The configurations that no step leaves, with their least distance from the start."""
        found: dict[tuple[tuple[str, int], ...], int] = {}
        for at in self.graph:
            if not self.graph.out_degree(at):
                found[self.named(at)] = min(found.get(self.named(at), 10**9), self.distance[at])
        return found

    def final_components(self) -> list[frozenset[Robots]]:
        parts = nx.strongly_connected_components(self.graph)
        return [frozenset(part) for part in parts if all(after in part for at in part for after in self.graph[at])]

    def waiting(self) -> set[tuple[str, str, str]]:
        """Machine, component and its state, for each robot that keeps a state which it could leave alone."""
        found = set()
        for part in self.final_components():
            for index, robot in enumerate(self.robots):
                states = {at[index] for at in part}
                for component in COMPONENTS:
                    kept = {robot.states[state].get(component) for state in states}
                    wants = any(source in states and place[0] == component for source, place in robot.moves)
                    if len(kept) == 1 and wants:
                        found.add((robot.name, component, str(kept.pop())))
        return found

    def taken(self) -> set[Taken]:
        return {taken for _at, _after, taken in self.graph.edges(data="taken")}


def draw_machine(rng: random.Random, name: str, count: int) -> RobotMachine:
    states = []
    for _ in range(count):
        active = {component: rng.choice(NAMES) for component in COMPONENTS if rng.random() < 0.85}
        states.append(active or {"Body": "a"})
    moves: dict[tuple[int, Place], int] = {}
    for _ in range(rng.randint(2 * count, 5 * count)):
        source, target = rng.randrange(count), rng.randrange(count)
        for component in COMPONENTS:
            old, new = states[source].get(component), states[target].get(component)
            if old and new and old != new:
                moves[source, (component, new)] = target
                break
    return RobotMachine(name=name, states=tuple(states), moves=moves)


def draw_product(rng: random.Random, sizes: range) -> tuple[list[RobotMachine], dict[Place, Cooperation]]:
    """Two to four robots that run up to three machines, which have as many states as one of the sizes."""
    names = ("one", "two", "three")[: rng.randint(1, 3)]
    machines = [draw_machine(rng, name, rng.choice(sizes)) for name in names]
    robots = sorted((rng.choice(machines) for _ in range(rng.randint(2, 4))), key=lambda each: each.name)
    all_places = [(component, name) for component in COMPONENTS for name in NAMES]
    places = {
        place: Cooperation(number=rng.randint(1, 3), is_barrier=rng.random() < 0.5)
        for place in rng.sample(all_places, rng.randint(1, 4))
    }
    return robots, places
