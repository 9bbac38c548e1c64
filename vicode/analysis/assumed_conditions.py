"""What is taken for granted about the inputs, as diagrams.

Assumptions are numbered by negative levels, so that a proof can ignore one as it ignores the range of a quantity.
"""

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from vicode.analysis.interval_diagrams import Node


@dataclass(frozen=True, slots=True, kw_only=True)
class AssumedCondition:
    """An assumption with the levels that it depends on."""

    text: str
    node: Node
    levels: frozenset[int]


class AssumedConditions:
    """The assumptions of a design by their number, which is negative."""

    def __init__(self, assumed: Iterable[AssumedCondition]) -> None:
        self._assumed = {-number: each for number, each in enumerate(assumed, start=1)}
        self.levels = frozenset[int]().union(*(each.levels for each in self._assumed.values()))

    def __getitem__(self, number: int) -> AssumedCondition:
        return self._assumed[number]

    def find_relevant(self, levels: set[int], ignored: Collection[int]) -> list[int]:
        """The assumptions about some levels, and about what these assumptions are about; `levels` is extended."""
        found: list[int] = []
        while True:
            more = [
                number
                for number, each in self._assumed.items()
                if number not in ignored and number not in found and each.levels & levels
            ]
            if not more:
                return found
            found += more
            levels.update(*(self._assumed[each].levels for each in more))
