"""What a team can do: where robots wait forever, and which steps are ever taken.

The search explores one stubborn set of each configuration. From a strongly connected component that nothing leaves, it
explores what is enabled and not taken in it, until nothing is: so no step is put off forever. Hence the search finds
all deadlocks, each way for robots to wait forever while others go on, and all steps that are taken in some run (A.
Valmari, *Stop it, and be stubborn!*, 2015).
"""

from collections import deque
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass

from vicode.analysis.products import Configuration, Place, Product


@dataclass(frozen=True, slots=True, kw_only=True)
class Waiting:
    """A component of a robot waits forever.

    Attributes:
        robots: The state of each robot.
        state: The state of the robots that wait.
        source: The component that waits, and its state.
        place: What it cannot enter.
        run: The steps that lead there; the shortest ones if no robot can move on.
    """

    robots: tuple[int, ...]
    state: int
    source: Place
    place: Place
    run: tuple[int, ...]


class TooManyConfigurationsError(Exception):
    """The search was ended: nothing is known of the team."""


class TeamSearch:
    """The configurations that a team can reach, reduced.

    Args:
        product: The team.
        limit: The number of configurations.

    Raises:
        TooManyConfigurationsError: There are more.
    """

    def __init__(self, product: Product, limit: int) -> None:
        self.product = product
        self.edges: dict[Configuration, dict[int, Configuration]] = {}
        self._final_components: list[frozenset[Configuration]] = []
        self._explore(tuple(sorted(product.start)), limit)

    def find_waiting(self) -> Iterator[Waiting]:
        """Yield where robots wait forever, nearest to the start first."""
        final = {at: component for component in self._final_components for at in component}
        found: set[frozenset[Configuration]] = set()
        for at, run in self._find_runs().items():
            component = final.get(at)
            if component is None or component in found:
                continue
            found.add(component)
            robots = self.product.start
            for number in run:
                robots = self.product.take(number, robots)
            for state in dict.fromkeys(robots):
                for source in self.product.states[state].items():
                    for place in self._find_blocked(state, source[0], component):
                        yield Waiting(robots=robots, state=state, source=source, place=place, run=run)

    def find_taken(self) -> set[int]:
        """The steps that are taken in some run."""
        return self._taken_in(self.edges)

    def _explore(self, start: Configuration, limit: int) -> None:
        """Find the strongly connected components by R. Tarjan's search; extend those that nothing leaves."""
        order: dict[Configuration, int] = {}
        lowest: dict[Configuration, int] = {}
        next_: dict[Configuration, list[int]] = {}
        # The configurations that are not yet in a component, with their places in it, and the others.
        opened: list[Configuration] = []
        place: dict[Configuration, int] = {}
        closed: set[Configuration] = set()
        path = [start]
        while path:
            at = path[-1]
            if at not in order:
                if len(order) == limit:
                    raise TooManyConfigurationsError
                order[at] = lowest[at] = len(order)
                place[at] = len(opened)
                opened.append(at)
                self.edges[at] = {}
                next_[at] = self.product.find_stubborn(at, self.product.list_enabled(at))
            if next_[at]:
                number = next_[at].pop(0)
                after = self.edges[at][number] = tuple(sorted(self.product.take(number, at)))
                if after not in order:
                    path.append(after)
                elif after not in closed:
                    lowest[at] = min(lowest[at], order[after])
                continue
            if lowest[at] == order[at]:
                component = frozenset(opened[place[at] :])
                next_[at] = self._find_ignored(at, component)
                if next_[at]:
                    continue
                closed |= component
                del opened[place[at] :]
            path.pop()
            if path:
                lowest[path[-1]] = min(lowest[path[-1]], lowest[at])

    def _find_ignored(self, at: Configuration, component: frozenset[Configuration]) -> list[int]:
        """Steps that are enabled and never taken in a component, if nothing leaves it."""
        if any(after not in component for each in component for after in self.edges[each].values()):
            return []
        # What is never taken commutes with all that is, so it is enabled in each configuration.
        ignored = set(self.product.list_enabled(at)) - self._taken_in(component)
        if not ignored:
            self._final_components.append(component)
        return self.product.find_stubborn(at, ignored)

    def _taken_in(self, component: Collection[Configuration]) -> set[int]:
        return set().union(*(self.edges[at] for at in component))

    def _find_blocked(self, state: int, name: str, component: Collection[Configuration]) -> Iterable[Place]:
        """What a component of a robot waits to enter, if it keeps its state whatever is taken again and again."""
        states, steps = self.product.states, self.product.steps
        taken, pending, seen = self._taken_in(component), [state], {state}
        while pending:
            source = pending.pop()
            targets = {steps[number].targets[source] for number in self.product.leaving[source] & taken} - seen
            if any(states[each].get(name) != states[state][name] for each in targets):
                return ()
            pending += targets
            seen |= targets
        places = (steps[number].place for each in sorted(seen) for number in sorted(self.product.leaving[each]))
        return dict.fromkeys(place for place in places if place[0] == name)

    def _find_runs(self) -> Mapping[Configuration, tuple[int, ...]]:
        """The steps to each configuration, nearest to the start first."""
        start = next(iter(self.edges))
        runs: dict[Configuration, tuple[int, ...]] = {start: ()}
        pending = deque([start])
        while pending:
            at = pending.popleft()
            for number, after in self.edges[at].items():
                if after not in runs:
                    runs[after] = (*runs[at], number)
                    pending.append(after)
        return runs
