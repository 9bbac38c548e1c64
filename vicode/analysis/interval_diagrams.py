"""Sets of values of many variables as interval decision diagrams.

A guard divides the values of each variable at the constants with which it compares them. An interval decision diagram
(K. Strehl and L. Thiele, *Interval Diagram Techniques for Symbolic Model Checking of Petri Nets*, 1999) is a decision
diagram whose edges are such intervals: a node tests one variable, its children belong to the intervals between its
cuts, neighbors with the same child are merged, and equal nodes are one node. Two guards that hold for the same values
therefore are the same node, and "never", "always", "only where an earlier one holds" are comparisons of numbers.
Unlike a table of cells, nothing has to be known about the constants of other guards beforehand.
"""

import math
from collections.abc import Collection, Iterator, Mapping
from itertools import pairwise

Position = tuple[float, int]
"""A place between two values, where a variable can be cut: (x, 0) is just before x, (x, 1) just after it.

Beyond (inf, 1) lies nan, which is ordered after all numbers. False, True and the elements of an enumeration are 0, 1, …
"""

Interval = tuple[Position, Position]
"""The values between two positions."""

Node = int
FALSE: Node = 0
TRUE: Node = 1

BEFORE_ALL: Position = (-math.inf, 0)
BEFORE_NAN: Position = (math.inf, 1)
AFTER_ALL: Position = (math.inf, 2)

_LEAF_LEVEL = 1 << 60


class TooLargeError(Exception):
    """A diagram has more nodes than the limit allows: the question is left undecided."""


class IntervalDiagrams:
    """Creates and combines diagrams. A node is the number of its diagram; it stays valid.

    Args:
        budget: The number of nodes that one question may add; the operation that would exceed it, or the total,
            raises `TooLargeError`.
        total: The limit of all nodes.
    """

    def __init__(self, budget: int, total: int) -> None:
        self._budget, self._total = budget, total
        self._max_nodes = min(budget, total)
        self._nodes: list[tuple[int, tuple[Position, ...], tuple[Node, ...]]] = [(_LEAF_LEVEL, (), ())] * 2
        self._known: dict[tuple[int, tuple[Position, ...], tuple[Node, ...]], Node] = {}
        self._intersections: dict[tuple[Node, Node], Node] = {}
        self._complements: dict[Node, Node] = {FALSE: TRUE, TRUE: FALSE}

    def __len__(self) -> int:
        return len(self._nodes)

    def begin_question(self) -> None:
        """Allow as many nodes again as one question may add."""
        self._max_nodes = min(len(self._nodes) + self._budget, self._total)

    def test(self, level: int, intervals: Collection[Interval]) -> Node:
        """The values of which the variable of a level lies in one of the intervals, which are in order and disjoint."""
        cuts: list[Position] = []
        children: list[Node] = [FALSE]
        for low, high in intervals:
            if low < high:
                cuts += (low, high)
                children += (TRUE, FALSE)
        return self.choose(level, tuple(cuts), tuple(children))

    def choose(self, level: int, cuts: tuple[Position, ...], children: tuple[Node, ...]) -> Node:
        """The values that are in the child that belongs to the variable's interval; children have greater levels."""
        merged_cuts: list[Position] = []
        merged = [children[0]]
        for cut, child in zip(cuts, children[1:], strict=True):
            if (merged_cuts and merged_cuts[-1] == cut) or cut == BEFORE_ALL:
                # The interval before this cut is empty.
                merged[-1] = child
                if len(merged) > 1 and merged[-2] == child:
                    del merged[-1], merged_cuts[-1]
            elif cut < AFTER_ALL and merged[-1] != child:
                merged_cuts.append(cut)
                merged.append(child)
        if not merged_cuts:
            return merged[0]
        key = (level, tuple(merged_cuts), tuple(merged))
        node = self._known.get(key)
        if node is None:
            if len(self._nodes) >= self._max_nodes:
                raise TooLargeError
            node = self._known[key] = len(self._nodes)
            self._nodes.append(key)
        return node

    def negate(self, node: Node) -> Node:
        found = self._complements.get(node)
        if found is None:
            level, cuts, children = self._nodes[node]
            found = self.choose(level, cuts, tuple(map(self.negate, children)))
            self._complements[node], self._complements[found] = found, node
        return found

    def both(self, a: Node, b: Node) -> Node:
        if FALSE in (a, b):
            return FALSE
        if a in (TRUE, b):
            return b
        if b == TRUE:
            return a
        key = (a, b) if a < b else (b, a)
        found = self._intersections.get(key)
        if found is None:
            found = self._intersections[key] = self._intersect(a, b)
        return found

    def either(self, a: Node, b: Node) -> Node:
        return self.negate(self.both(self.negate(a), self.negate(b)))

    def without(self, a: Node, b: Node) -> Node:
        return self.both(a, self.negate(b))

    def if_then_else(self, test: Node, then: Node, otherwise: Node) -> Node:
        return self.either(self.both(test, then), self.without(otherwise, test))

    def _intersect(self, a: Node, b: Node) -> Node:
        level, cuts, children = self._nodes[a]
        other_level, other_cuts, other_children = self._nodes[b]
        if level < other_level:
            return self.choose(level, cuts, tuple(self.both(child, b) for child in children))
        if other_level < level:
            return self.choose(other_level, other_cuts, tuple(self.both(a, child) for child in other_children))
        merged: list[Position] = []
        pairs = [self.both(children[0], other_children[0])]
        i = j = 0
        while i < len(cuts) or j < len(other_cuts):
            ahead = cuts[i] if i < len(cuts) else AFTER_ALL
            cut = min(ahead, other_cuts[j] if j < len(other_cuts) else AFTER_ALL)
            i += i < len(cuts) and cuts[i] == cut
            j += j < len(other_cuts) and other_cuts[j] == cut
            merged.append(cut)
            pairs.append(self.both(children[i], other_children[j]))
        return self.choose(level, tuple(merged), tuple(pairs))

    def exists(self, node: Node, levels: Collection[int]) -> Node:
        """The values of the other variables for which some values of these `levels` are in the diagram."""
        known: dict[Node, Node] = {FALSE: FALSE, TRUE: TRUE}

        def visit(node: Node) -> Node:
            if node not in known:
                level, cuts, children = self._nodes[node]
                visited = tuple(map(visit, children))
                if level in levels:
                    found = FALSE
                    for child in visited:
                        found = self.either(found, child)
                else:
                    found = self.choose(level, cuts, visited)
                known[node] = found
            return known[node]

        return visit(node)

    def find_cuts(self, nodes: Collection[Node]) -> dict[int, set[Position]]:
        """The variables that the diagrams test, with all places where they are cut."""
        found: dict[int, set[Position]] = {}
        pending, seen = list(nodes), {FALSE, TRUE}
        while pending:
            node = pending.pop()
            if node not in seen:
                seen.add(node)
                level, cuts, children = self._nodes[node]
                found.setdefault(level, set()).update(cuts)
                pending += children
        return found

    def branches(self, node: Node) -> tuple[int, Iterator[tuple[Interval, Node]]]:
        """The level that a node tests, and its children with their intervals."""
        level, cuts, children = self._nodes[node]
        bounds = (BEFORE_ALL, *cuts, AFTER_ALL)
        return level, zip(pairwise(bounds), children, strict=True)

    def iterate_boxes(self, node: Node) -> Iterator[Mapping[int, Interval]]:
        """Yield boxes of values that the diagram contains: an interval for each variable that is restricted."""
        if node == TRUE:
            yield {}
        elif node != FALSE:
            level, branches = self.branches(node)
            for interval, child in branches:
                for box in self.iterate_boxes(child):
                    yield {level: interval, **box}

    def intervals_of(self, node: Node, level: int) -> list[Interval]:
        """The intervals of a variable in which some values of the others are in the diagram, in order."""
        rest = [each for each in self.find_cuts((node,)) if each != level]
        projected = self.exists(node, rest)
        if projected == FALSE:
            return []
        _level, cuts, children = self._nodes[projected]
        bounds = (BEFORE_ALL, *cuts, AFTER_ALL)
        pieces = zip(bounds, bounds[1:], children or (TRUE,), strict=False)
        return [(low, high) for low, high, child in pieces if child == TRUE]
