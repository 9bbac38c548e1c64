"""Values for which a diagram holds.

A diagram contains too much where values are computed, so an example is checked: the computed values are calculated.
"""

import math
from collections.abc import Iterator, Mapping
from itertools import chain, islice, product

from vicode.analysis.conditions import Conditions
from vicode.analysis.interval_diagrams import BEFORE_NAN, Interval, Node, TooLargeError
from vicode.analysis.quantities import NANOSECONDS, Quantity, QuantityTable, Value, is_leaf
from vicode.model.expressions import BOOL, FLOAT, INT, walk

_MOST_BOXES, _MOST_CHOICES, _MOST_INTS = 16, 256, 32

Example = Mapping[str, Value]
"""Values by name; those of enumerations are names of elements, times are in the unit of the design."""


def find_example(conditions: Conditions, node: Node) -> Example | None:
    """Values for which a diagram holds; None if none are found, or it depends on hand-written code."""
    diagrams = conditions.diagrams
    try:
        possible = diagrams.both(node, conditions.possible((node,), with_nan=False))
        boxes = list(islice(diagrams.iterate_boxes(possible), _MOST_BOXES))
    except (TooLargeError, RecursionError):
        return None
    return next((found for box in boxes for found in _find_in_box(conditions, box)), None)


def describe_value(value: Value) -> str:
    """A value as text."""
    return str(value) if isinstance(value, bool | str) else f"{value:.12g}"


def _find_in_box(conditions: Conditions, box: Mapping[int, Interval]) -> Iterator[Example]:
    table, read = conditions.table, dict[str, tuple[Quantity, Interval]]()
    trees = {level: conditions.computed.trees_of(level) for level in box if level in conditions.computed}
    # A design reads those of greater levels first.
    for level in sorted(box.keys() - trees.keys(), reverse=True):
        read[conditions.quantities[level].name] = (conditions.quantities[level], box[level])
    for node in (node for tree in chain(*trees.values()) for node in walk(tree)):
        if is_leaf(node) and table.value_of(node) is None:
            read.setdefault(table.quantity(node).name, (table.quantity(node), table.quantity(node).domain))
    choices = [choose_values(quantity, interval, table) for quantity, interval in read.values()]
    for values in islice(product(*choices), _MOST_CHOICES):
        example = dict(zip(read, values, strict=True))
        if all(_is_in([table.value_of(tree, example) for tree in trees[level]], box[level]) for level in trees):
            yield example


def _is_in(found: list[Value | None], interval: Interval) -> bool:
    """Whether a number, or the order of two, is in an interval."""
    numbers = [each for each in found if isinstance(each, int | float)]
    if not numbers or len(numbers) < len(found):
        return False
    number = numbers[0] if len(numbers) == 1 else (numbers[0] > numbers[1]) - (numbers[0] < numbers[1])
    return not any(map(math.isnan, numbers)) and interval[0] <= (number, 0) < interval[1]


def choose_values(quantity: Quantity, interval: Interval, table: QuantityTable) -> Iterator[Value]:
    """Values of a quantity in an interval, plain ones first."""
    low = max(interval[0], quantity.domain[0])
    high = min(interval[1], quantity.domain[1], BEFORE_NAN)
    if quantity.type == BOOL:
        yield from (value for value in (False, True) if low <= (int(value), 0) < high)
    elif quantity.type == INT:
        yield from _plain_ints(int(low[0]), int(high[0]) - 1)
    elif quantity.type == NANOSECONDS:
        last = high if math.isinf(high[0]) else ((high[0] - 1) / table.ns_per_unit, 1)
        yield from _plain_floats((low[0] / table.ns_per_unit, 0), last)
    elif quantity.type == FLOAT:
        yield from _plain_floats(low, high)
    elif elements := table.elements(quantity.type):
        # Nothing is known of a value whose type has errors.
        yield elements[int(low[0])]


def _plain_ints(low: int, high: int) -> Iterator[int]:
    nearest = min(max(0, low), high)
    yield from dict.fromkeys((nearest, low, high, (low + high) // 2, *range(low, min(high, low + _MOST_INTS))))


def _plain_floats(low: tuple[float, int], high: tuple[float, int]) -> Iterator[float]:
    """The number with the fewest digits in the interval, then its ends and middle."""
    least = low[0] if low[1] == 0 else math.nextafter(low[0], math.inf)
    greatest = high[0] if high[1] == 1 else math.nextafter(high[0], -math.inf)
    least, greatest = max(least, -1e15), min(greatest, 1e15)
    if math.isinf(low[0]) or math.isinf(high[0]):
        # Not the very end of the interval, which is hard to read.
        middle = min(least + 1, greatest) if least > 0 else max(greatest - 1, least) if greatest < 0 else 0.0
    else:
        middle = (least + greatest) / 2
    plain = [0.0] if least <= 0 <= greatest else []
    for digits in range(-15, 16):
        rounded = round(middle, digits)
        if least <= rounded <= greatest:
            plain.append(rounded)
            break
    yield from dict.fromkeys(each for each in (*plain, middle, least, greatest) if least <= each <= greatest)
