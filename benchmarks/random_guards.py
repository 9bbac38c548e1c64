"""Random guards over a few inputs that contradict, imply or cover each other often, and values at which to try them."""

import math
import random
from collections.abc import Iterator, Mapping, Sequence

from vicode.model.design import Declaration, Guard
from vicode.model.project import Enumeration
from vicode.semantics.values import Value

SIDES = ("left", "right", "both")
ENUMERATION = Enumeration(name="Side", elements=tuple((side, "") for side in SIDES))
FLOAT_RANGES: Mapping[str, tuple[float, float]] = {"a": (0, 10), "b": (0, 10), "u": (-5, 5), "d": (0.5, 4)}
INT_RANGES: Mapping[str, tuple[int, int]] = {"n": (0, 3), "m": (-4, 4)}
RANGES = {**FLOAT_RANGES, **INT_RANGES}
FREE_FLOATS, FREE_INT, BOOLS = ("x", "y"), "k", ("seen", "ready")
FLOATS = (*FLOAT_RANGES, *FREE_FLOATS)
INTS = (*INT_RANGES, FREE_INT)
DECLARATIONS = (
    *(Declaration(name=name, type="float", range=limits) for name, limits in FLOAT_RANGES.items()),
    *(Declaration(name=name, type="float") for name in FREE_FLOATS),
    *(Declaration(name=name, type="int", range=limits) for name, limits in INT_RANGES.items()),
    Declaration(name=FREE_INT, type="int"),
    *(Declaration(name=name, type="bool") for name in BOOLS),
    Declaration(name="side", type=ENUMERATION.name),
)
TIMES = ("state_time", "component_time")
CONSTANTS = ("0", "1", "2", "3", "4", "5", "7", "9", "10", "0.5", "2.5", "0.1", "0.3", "-1", "-2.5", "-4")
INT_CONSTANTS = ("0", "1", "2", "3", "4", "-1", "-4")
DURATIONS = ("0.3", "0.5", "1", "2.5", "3", "10")
EXTREMES = (math.inf, -math.inf, math.nan, 1e308, -1e308, 5e-324, -0.0)
_ORDERS = ("<", "<=", ">", ">=", "<", ">", "==", "!=")


class RandomGuards:
    """Draws the guards of one case, which read a few of the inputs.

    Args:
        has_arithmetic: Whether values are added, subtracted, multiplied and divided.
    """

    def __init__(self, chance: random.Random, *, has_arithmetic: bool) -> None:
        self._chance = chance
        self._has_arithmetic = has_arithmetic
        numbers = (*FLOATS, *FLOAT_RANGES, *INTS, *TIMES)
        self._numbers = chance.sample(numbers, chance.choice((1, 2, 2, 3)))
        self._uses_choices = chance.random() < 0.4

    def draw_case(self) -> tuple[Guard, ...]:
        """One guard, or two of which the second often is related to the first."""
        first = self.draw_guard()
        kind = self._chance.random()
        if kind < 0.5:
            return (first,)
        if kind < 0.7 and first.when:
            return (first, Guard(when=f"({self._vary(first.when)}) and {self.draw_condition(1)}"))
        if kind < 0.8 and first.when:
            return (first, Guard(when=self._vary(first.when)))
        return (first, self.draw_guard())

    def draw_guard(self) -> Guard:
        after = self._chance.choice(DURATIONS) if self._chance.random() < 0.15 else ""
        if after and self._chance.random() < 0.4:
            return Guard(after=after)
        return Guard(after=after, when=self.draw_condition(self._chance.choice((1, 2, 2, 3))))

    def draw_condition(self, depth: int) -> str:
        chance = self._chance
        if depth <= 0:
            return self._draw_atom()
        parts = [self.draw_condition(depth - chance.choice((1, 1, 2))) for _ in range(chance.choice((2, 2, 3)))]
        match chance.randrange(12):
            case 0:
                return f"not ({parts[0]})"
            case 1:
                return f"({parts[0]} if {chance.choice(BOOLS)} else {parts[1]})"
            case 2 | 3 | 4:
                return " or ".join(f"({part})" for part in parts)
            case _:
                return " and ".join(f"({part})" for part in parts)

    def _draw_atom(self) -> str:
        chance = self._chance
        match chance.randrange(12):
            case 0:
                return chance.choice((*BOOLS, "not seen", "seen == ready", "seen != ready"))
            case 1:
                return f"side {chance.choice(('==', '!='))} Side.{chance.choice(SIDES)}"
            case 2 | 3:
                orders = chance.choice((("<", "<="), (">", ">="), ("<=", "<"), ("==", "<")))
                first, last = (chance.choice((self._draw_constant(), self._draw_leaf())) for _ in range(2))
                return f"{first} {orders[0]} {self._draw_number(1)} {orders[1]} {last}"
            case 4 | 5:
                return f"{self._draw_number(2)} {chance.choice(_ORDERS)} {self._draw_number(1)}"
            case _:
                return f"{self._draw_number(2)} {chance.choice(_ORDERS)} {self._draw_constant()}"

    def _draw_leaf(self) -> str:
        return self._chance.choice(self._numbers)

    def _draw_constant(self) -> str:
        is_int = all(name in INTS for name in self._numbers)
        return self._chance.choice(INT_CONSTANTS if is_int else CONSTANTS)

    def _draw_number(self, depth: int) -> str:
        chance = self._chance
        if depth <= 0 or chance.random() < 0.4:
            return self._draw_leaf()
        if self._uses_choices and chance.random() < 0.5:
            return self._draw_choice(depth - 1)
        return self._draw_arithmetic(depth - 1) if self._has_arithmetic else self._draw_leaf()

    def _draw_choice(self, depth: int) -> str:
        chance = self._chance
        number, other = self._draw_number(depth), self._draw_number(depth)
        match chance.randrange(6):
            case 0:
                return f"abs({number})"
            case 1 | 2:
                last = chance.choice((other, self._draw_constant()))
                return f"{chance.choice(('min', 'max'))}({number}, {last})"
            case 3:
                return f"clamp({number}, {chance.choice(('0', '-1', '2'))}, {chance.choice(('3', '5'))})"
            case 4:
                return f"-({number})"
            case _:
                return f"({number} if {chance.choice(BOOLS)} else {other})"

    def _draw_arithmetic(self, depth: int) -> str:
        chance = self._chance
        left, right, constant = self._draw_number(depth), self._draw_number(depth), self._draw_constant()
        match chance.randrange(10):
            case 0 | 1:
                return f"({left} {chance.choice('+-')} {constant})"
            case 2 | 3 | 4:
                return f"({left} {chance.choice('+-')} {right})"
            case 5 | 6:
                return f"({left}) * {constant}"
            case 7:
                return f"({left}) * ({right})"
            case 8:
                return f"({left}) / {chance.choice(('2', '4', '0.5', '-2', '3'))}"
            case _:
                return f"({left}) / {chance.choice(('d', 'd', right))}"

    def _vary(self, condition: str) -> str:
        """The condition, often with the numbers in another place."""
        return condition.replace("3", "2") if self._chance.random() < 0.3 else condition


def draw_values(chance: random.Random, numbers: Sequence[float]) -> Iterator[Mapping[str, Value]]:
    """Yield values of all inputs without end, most of them at or near the numbers of a guard."""

    def draw(low: float, high: float) -> float:
        kind = chance.random()
        if kind < 0.6:
            value = chance.choice(numbers) + chance.choice((0, 0, 0, 1, -1, 0.25, -0.25))
            value = math.nextafter(value, chance.choice((-math.inf, math.inf))) if kind < 0.1 else value
        elif kind < 0.7 and math.isinf(high):
            return chance.choice(EXTREMES)
        else:
            value = chance.uniform(max(low, -20), min(high, 20))
        return min(max(value, low), high)

    while True:
        values: dict[str, Value] = {name: float(draw(*FLOAT_RANGES[name])) for name in FLOAT_RANGES}
        values |= {name: float(draw(-math.inf, math.inf)) for name in FREE_FLOATS}
        values |= {name: round(draw(low, high)) for name, (low, high) in INT_RANGES.items()}
        values["k"] = round(draw(-1e9, 1e9)) if chance.random() < 0.95 else chance.choice((2**53, -(2**53)))
        values |= {name: chance.random() < 0.5 for name in BOOLS}
        values["side"] = f"Side.{chance.choice(SIDES)}"
        values |= {"state_time": round(draw(0, 1e9) * 1e9) / 1e9, "component_time": float(draw(0, 1e9))}
        yield values
