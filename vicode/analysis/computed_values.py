"""Values that are computed from others: which values both can have together.

The values of the operands are cut into cells by the constants with which they are compared; interval arithmetic gives
the values of the result in each combination of cells.
"""

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Protocol

from vicode.analysis.bounds import find_bounds, find_orders
from vicode.analysis.interval_diagrams import (
    AFTER_ALL,
    BEFORE_ALL,
    BEFORE_NAN,
    Interval,
    IntervalDiagrams,
    Node,
    Position,
)
from vicode.analysis.quantities import Quantity, QuantityTable, before_whole, shape_of
from vicode.model.expressions import INT, Expr

_MAX_CELLS = 512


class DomainOf(Protocol):
    """The values of the quantity of a level."""

    def __call__(self, level: int, *, with_nan: bool, is_ignored: bool) -> Interval: ...


class ComputedValues:
    """The levels of computed values: what each reads, and its trees, two if it is the order of two values.

    Unknown conditions, such as hand-written code, have no trees.
    """

    def __init__(
        self, table: QuantityTable, diagrams: IntervalDiagrams, quantities: Mapping[int, Quantity], domain: DomainOf
    ) -> None:
        self._table, self._diagrams, self._quantities, self._domain = table, diagrams, quantities, domain
        self._reads: dict[int, tuple[int, ...]] = {}
        self._trees: dict[int, tuple[Expr, ...]] = {}

    def __len__(self) -> int:
        return len(self._reads)

    def __contains__(self, level: int) -> bool:
        return level in self._reads

    def add(self, level: int, reads: tuple[int, ...], trees: tuple[Expr, ...]) -> None:
        self._reads[level], self._trees[level] = reads, trees

    def trees_of(self, level: int) -> tuple[Expr, ...]:
        """What computes a value, two trees if it is their order; none if it is unknown, or read."""
        return self._trees.get(level, ())

    def reads_of(self, level: int) -> tuple[int, ...]:
        """The levels of what a computed value reads."""
        return self._reads.get(level, ())

    def is_related(self, level: int) -> bool:
        """Whether a computed value depends on others."""
        return bool(self._trees[level])

    def levels_of(self, tested: Iterable[int]) -> set[int]:
        """Levels with those that they are computed from."""
        levels = set(tested)
        return levels.union(*(self._reads[level] for level in levels if level in self._reads))

    def relate(self, level: int, cuts: Mapping[int, set[Position]], ignored: Collection[int]) -> Node:
        """The values that a computed value has together with those that it is computed from."""
        reads = self._reads[level]
        cells = {each: self._cells(each, cuts.get(each, ()), is_ignored=each in ignored) for each in reads}
        while math.prod(map(len, cells.values())) > _MAX_CELLS:
            largest = max(cells, key=lambda each: len(cells[each]))
            cells[largest] = [(cells[largest][0][0], cells[largest][-1][1])]
        return self._relate_cells(level, reads, cells, {})

    def _cells(self, level: int, cuts: Iterable[Position], *, is_ignored: bool) -> list[Interval]:
        low, high = self._domain(level, with_nan=True, is_ignored=is_ignored)
        bounds = [low, *sorted(cut for cut in cuts if low < cut < high), high]
        return list(pairwise(bounds))

    def _relate_cells(
        self, level: int, reads: Sequence[int], cells: Mapping[int, list[Interval]], chosen: dict[int, Interval]
    ) -> Node:
        if not reads:
            return self._diagrams.test(level, self._bounds(level, chosen))
        first, rest = reads[0], reads[1:]
        children = [self._relate_cells(level, rest, cells, {**chosen, first: cell}) for cell in cells[first]]
        cuts = tuple(low for low, _high in cells[first][1:])
        return self._diagrams.choose(first, cuts, tuple(children))

    def _bounds(self, level: int, chosen: Mapping[int, Interval]) -> list[Interval]:
        trees = self._trees[level]
        if not trees:
            return [(BEFORE_ALL, AFTER_ALL)]
        by_shape = {shape_of(tree): cell for each, cell in chosen.items() if (tree := self._quantities[each].tree)}
        found = [find_bounds(tree, by_shape, self._table) for tree in trees]
        intervals = [interval for interval, _nan in found]
        if len(found) == 2:
            intervals = find_orders(*intervals)
        elif self._quantities[level].type == INT:
            intervals = [(before_whole(low), before_whole(high)) for low, high in intervals]
        return [*intervals, (BEFORE_NAN, AFTER_ALL)] if any(nan for _interval, nan in found) else intervals
