"""Values for which a diagram holds.

A diagram contains too much where values are computed, so an example is checked: the computed values are calculated.
"""

import math
from collections.abc import Iterator, Mapping
from itertools import islice, product

from vicode.analysis.conditions import Conditions
from vicode.analysis.interval_diagrams import BEFORE_NAN, Interval, Node, TooLargeError
from vicode.analysis.quantities import NANOSECONDS, Quantity, QuantityTable, Value
from vicode.model.expressions import BOOL, FLOAT, INT

_MOST_BOXES, _MOST_CHOICES = 16, 64

Example = Mapping[int, Value]
"""Values by level; those of enumerations are names of elements, times are in the unit of the design."""


def find_example(conditions: Conditions, node: Node) -> Example | None:
    """Values for which a diagram holds; None if none are found, or it depends on hand-written code."""
    diagrams = conditions.diagrams
    try:
        possible = diagrams.both(node, conditions.possible((node,), with_nan=False))
        boxes = list(islice(diagrams.iterate_boxes(possible), _MOST_BOXES))
    except (TooLargeError, RecursionError):
        return None
    return next((found for box in boxes for found in _find_in_box(conditions, box)), None)


def describe_example(conditions: Conditions, example: Example) -> list[str]:
    """The values as text, such as "ball.x = 0"."""
    shown = sorted(example.items(), reverse=True)
    return [f"{conditions.quantities[level].name} = {_show(value)}" for level, value in shown]


def _show(value: Value) -> str:
    return str(value) if isinstance(value, bool | str) else f"{value:g}"


def _find_in_box(conditions: Conditions, box: Mapping[int, Interval]) -> Iterator[Example]:
    computed = {level: conditions.computed[level] for level in box if level in conditions.computed}
    read = {level for each in computed.values() for level in each.reads}
    levels = sorted({*box, *read} - set(computed))
    table = conditions.table
    quantities = [conditions.quantities[level] for level in levels]
    intervals = [box.get(level, each.domain) for level, each in zip(levels, quantities, strict=True)]
    choices = [choose_values(each, interval, table) for each, interval in zip(quantities, intervals, strict=True)]
    for values in islice(product(*choices), _MOST_CHOICES):
        named = {each.name: value for each, value in zip(quantities, values, strict=True)}
        found = ([table.value_of(tree, named) for tree in each.trees] for each in computed.values())
        if all(_is_in(numbers, box[level]) for level, numbers in zip(computed, found, strict=True)):
            yield dict(zip(levels, values, strict=True))


def _is_in(found: list[Value | None], interval: Interval) -> bool:
    """Whether a number, or the order of two, is in an interval."""
    numbers = [each for each in found if isinstance(each, int | float) and not math.isnan(each)]
    if not numbers or len(numbers) < len(found):
        return False
    number = numbers[0] if len(numbers) == 1 else (numbers[0] > numbers[1]) - (numbers[0] < numbers[1])
    return interval[0] <= (number, 0) < interval[1]


def choose_values(quantity: Quantity, interval: Interval, table: QuantityTable) -> Iterator[Value]:
    """Values of a quantity in an interval, plain ones first."""
    low = max(interval[0], quantity.domain[0])
    high = min(interval[1], quantity.domain[1], BEFORE_NAN)
    if quantity.type == BOOL:
        yield low[0] >= 1
    elif quantity.type == INT:
        yield from _plain_ints(int(low[0]), int(high[0]) - 1)
    elif quantity.type == NANOSECONDS:
        yield low[0] / table.ns_per_unit
    elif quantity.type == FLOAT:
        yield from _plain_floats(low, high)
    else:
        yield table.elements(quantity.type)[int(low[0])]


def _plain_ints(low: int, high: int) -> Iterator[int]:
    nearest = min(max(0, low), high)
    yield from dict.fromkeys((nearest, low, high, (low + high) // 2))


def _plain_floats(low: tuple[float, int], high: tuple[float, int]) -> Iterator[float]:
    """The number with the fewest digits in the interval, then its ends and middle."""
    least = low[0] if low[1] == 0 else math.nextafter(low[0], math.inf)
    greatest = high[0] if high[1] == 1 else math.nextafter(high[0], -math.inf)
    least, greatest = max(least, -1e15), min(greatest, 1e15)
    middle = min(max(0.0, least), greatest) if math.isinf(low[0]) or math.isinf(high[0]) else (least + greatest) / 2
    plain = [0.0] if least <= 0 <= greatest else []
    for digits in range(-15, 16):
        rounded = round(middle, digits)
        if least <= rounded <= greatest:
            plain.append(rounded)
            break
    yield from dict.fromkeys(each for each in (*plain, middle, least, greatest) if least <= each <= greatest)
