"""Guards as interval decision diagrams.

A comparison with a constant cuts the values of what it compares; a choice such as `min(a, b) < 3` becomes a choice
between comparisons. A computed value is a separate quantity, whose possible values are related to those of its operands
by interval arithmetic, cell by cell. Hand-written code can be anything. So the diagram of a
guard contains every case in which the guard holds, and possibly more: "never" is proved, "possibly" is not.
"""

import math
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import replace

from vicode.analysis.assumed_conditions import AssumedCondition, AssumedConditions
from vicode.analysis.choices import lower_to_choices
from vicode.analysis.computed_values import ComputedValues
from vicode.analysis.interval_diagrams import (
    AFTER_ALL,
    BEFORE_ALL,
    BEFORE_NAN,
    FALSE,
    TRUE,
    Interval,
    IntervalDiagrams,
    Node,
    Position,
    TooLargeError,
)
from vicode.analysis.number_sets import NumberSet, compare_with, cut_off, mirror
from vicode.analysis.quantities import (
    NANOSECONDS,
    Assumption,
    Quantity,
    QuantityTable,
    Shape,
    before_whole,
    is_leaf,
    shape_of,
)
from vicode.model.design import Guard
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    INT,
    Comparison,
    ElapsedTime,
    Expr,
    FunctionCall,
    Logic,
    Minus,
    Not,
    Ternary,
    parse_expression,
    walk,
)

STATE_TIME = 0
"""The level of the time in the state."""
_FIRST_COMPUTED = 1_000_000
"""The least level of a computed value. A new variable is tested before those that are known: so a list of decisions
grows at the top of its diagram, and what is below is shared.
"""
_NODES_OF_A_QUESTION, _MAX_NODES = 30_000, 400_000
_NO_SPAN = (0, 0)
_MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}
_STATE_TIME = ElapsedTime(kind="state", span=_NO_SPAN)


class Conditions:
    """The guards of one design as diagrams over common variables.

    What is assumed about used components is numbered by negative levels, so that it can be ignored like a range.

    Args:
        table: The quantities of the design.
    """

    def __init__(self, table: QuantityTable) -> None:
        self.table = table
        self.diagrams = IntervalDiagrams(_NODES_OF_A_QUESTION, _MAX_NODES)
        self.quantities: dict[int, Quantity] = {STATE_TIME: table.quantity(_STATE_TIME)}
        self._levels: dict[Shape, int] = {shape_of(_STATE_TIME): STATE_TIME}
        self.computed = ComputedValues(table, self.diagrams, self.quantities, self._domain)
        self._texts: dict[tuple[str, str], Node] = {}
        self._plain_cases: dict[Node, bool] = {FALSE: False, TRUE: True}
        self.unknown = self._add_unknown()
        self.assumed = AssumedConditions(self._assume(table.assumptions))

    def of_guard(self, guard: Guard) -> Node:
        """The diagram of a guard.

        Raises:
            TooLargeError: The diagram has too many nodes.
        """
        node = self._of_text(guard.after, FLOAT) if guard.after else TRUE
        if guard.when:
            node = self.diagrams.both(node, self._of_text(guard.when, BOOL))
        # Hand-written code may give another result each time.
        return node if guard.code is None else self.diagrams.both(node, self._add_unknown())

    def of_condition(self, tree: Expr) -> Node:
        """The diagram of a bool without errors.

        Raises:
            TooLargeError: The diagram has too many nodes.
        """
        return self._of(tree)

    def _of_text(self, text: str, type_: str) -> Node:
        """The diagram of an expression, or of the timer that it sets; an expression with errors can be anything."""
        if (text, type_) not in self._texts:
            parsed = parse_expression(text, self.table.scope, type_)
            if parsed.tree is None or parsed.diagnostics:
                node = self._add_unknown()
            else:
                node = self._of(parsed.tree) if type_ == BOOL else self._of_timer(parsed.tree)
            self._texts[text, type_] = node
        return self._texts[text, type_]

    def has_plain_case(self, node: Node) -> bool:
        """Whether a diagram contains values of inputs in their ranges, whatever the computed values are.

        Of most diagrams this is known at once, as it is known of those in them.
        """
        found = self._plain_cases.get(node)
        if found is None:
            level, branches = self.diagrams.branches(node)
            # Unknown conditions are not related to anything, and assumptions relate inputs to each other.
            is_free = level not in self.assumed.levels
            found = (
                is_free
                and (level < _FIRST_COMPUTED or not self.computed.is_related(level))
                and any(
                    self._meets_domain(level, interval) and self.has_plain_case(child) for interval, child in branches
                )
            )
            self._plain_cases[node] = found
        return found

    def _meets_domain(self, level: int, interval: Interval) -> bool:
        low, high = self._domain(level, with_nan=False, is_ignored=False)
        return max(low, interval[0]) < min(high, interval[1])

    def possible(self, nodes: Collection[Node], *, with_nan: bool, ignored: Collection[int] = ()) -> Node:
        """The values that what some diagrams test can have together.

        Args:
            nodes: The diagrams.
            with_nan: Whether floats without a declared range can be nan.
            ignored: The levels whose declared range is ignored.
        """
        assumed = [self.assumed[each].node for each in self._assumed_about(nodes, ignored)]
        cuts = self.diagrams.find_cuts((*nodes, *assumed))
        result = self._join("and", assumed)
        for level in sorted(self.computed.levels_of(cuts), reverse=True):
            domain = self._domain(level, with_nan=with_nan, is_ignored=level in ignored)
            result = self.diagrams.both(self.diagrams.test(level, (domain,)), result)
            if level in self.computed:
                result = self.diagrams.both(self.computed.relate(level, cuts, ignored), result)
        return result

    def _assume(self, assumptions: Iterable[Assumption]) -> Iterator[AssumedCondition]:
        for each in assumptions:
            self.diagrams.begin_question()
            try:
                node = self._of(each.tree)
            except (TooLargeError, RecursionError):
                continue
            levels = self.computed.levels_of(self.diagrams.find_cuts((node,)))
            yield AssumedCondition(text=each.text, node=node, levels=frozenset(levels))

    def _assumed_about(self, nodes: Collection[Node], ignored: Collection[int] = ()) -> list[int]:
        return self.assumed.find_relevant(self.computed.levels_of(self.diagrams.find_cuts(nodes)), ignored)

    def ignorable_facts(self, node: Node) -> list[int]:
        """The assumptions, and the quantities with a declared range, on which a diagram may depend."""
        assumptions = self._assumed_about((node,))
        levels = self.computed.levels_of(self.diagrams.find_cuts((node,)))
        levels.update(*(self.assumed[each].levels for each in assumptions))
        return [*assumptions, *sorted((each for each in levels if self.quantities[each].has_range), reverse=True)]

    def describe_fact(self, level: int) -> str:
        """An assumption or a declared range as text, such as "ball.x from 0 to 10"."""
        if level < 0:
            return f"assumed of {self.assumed[level].text}"
        quantity = self.quantities[level]
        (low, _), (high, side) = quantity.domain
        return f"{quantity.name} from {low:g} to {high - (quantity.type == INT and side == 0):g}"

    def _domain(self, level: int, *, with_nan: bool, is_ignored: bool) -> Interval:
        quantity = self.quantities[level]
        low, high = self.table.domain_of_type(quantity.type) if is_ignored else quantity.domain
        return (low, high if with_nan else min(high, BEFORE_NAN))

    # Guards

    def _of_timer(self, tree: Expr) -> Node:
        value = self.table.value_of(tree)
        if not isinstance(value, int | float):
            return self._compare(_STATE_TIME, ">=", tree)
        ns = value * self.table.ns_per_unit
        if math.isnan(ns):
            return FALSE
        return self._test(STATE_TIME, NumberSet(intervals=(((round(ns) if math.isfinite(ns) else ns, 0), BEFORE_NAN),)))

    def _add_unknown(self) -> Node:
        """A condition about which nothing is known."""
        level = self._next_computed()
        self.quantities[level] = Quantity(name="", type=BOOL, domain=((0, 0), (2, 0)))
        self.computed.add(level, (), ())
        return self._test_bool(level)

    def _of(self, node: Expr) -> Node:
        """The diagram of a bool."""
        value = self.table.value_of(node)
        if value is not None:
            return TRUE if value else FALSE
        match node:
            case Not(operand=operand):
                return self.diagrams.negate(self._of(operand))
            case Logic(operator=operator, operands=operands):
                return self._join(operator, map(self._of, operands))
            case Ternary(test=test, then=then, otherwise=otherwise):
                return self.diagrams.if_then_else(self._of(test), self._of(then), self._of(otherwise))
            case Comparison(operators=operators, operands=operands):
                triples = zip(operands, operators, operands[1:], strict=False)
                return self._join("and", (self._compare(a, operator, b) for a, operator, b in triples))
            case FunctionCall(function="is_nan", arguments=(operand,)) if is_leaf(operand) and operand.type == FLOAT:
                return self._test(self._level(operand), NumberSet(intervals=(), has_nan=True))
            case _:
                return self._test_bool(self._level(node))

    def _join(self, operator: str, nodes: Iterable[Node]) -> Node:
        combine, joined = (self.diagrams.both, TRUE) if operator == "and" else (self.diagrams.either, FALSE)
        for node in nodes:
            joined = combine(joined, node)
        return joined

    # Comparisons

    def _compare(self, left: Expr, operator: str, right: Expr) -> Node:
        left, right = lower_to_choices(left), lower_to_choices(right)
        if isinstance(left, Ternary) and self.table.value_of(left) is None:
            return self._choose(left, lambda branch: self._compare(branch, operator, right))
        if isinstance(right, Ternary) and self.table.value_of(right) is None:
            return self._choose(right, lambda branch: self._compare(left, operator, branch))
        a, b = self.table.value_of(left), self.table.value_of(right)
        if left.type not in (INT, FLOAT):
            return self._compare_choices(left, operator, right)
        if isinstance(b, int | float) and _is_exact(left, b):
            return self._compare_number(left, operator, b)
        if isinstance(a, int | float) and _is_exact(right, a):
            return self._compare_number(right, _MIRRORED[operator], a)
        return self._compare_order(left, operator, right)

    def _choose(self, choice: Ternary, of_branch: Callable[[Expr], Node]) -> Node:
        return self.diagrams.if_then_else(self._of(choice.test), of_branch(choice.then), of_branch(choice.otherwise))

    def _compare_choices(self, left: Expr, operator: str, right: Expr) -> Node:
        """Bools, or elements of an enumeration; only == and != are defined."""
        if left.type == BOOL:
            a, b = self._of(left), self._of(right)
            equal = self.diagrams.if_then_else(a, b, self.diagrams.negate(b))
        elif not self.table.elements(left.type):
            return self._add_unknown()
        else:
            elements = self.table.elements(left.type)
            pairs = ((self._is_element(left, each), self._is_element(right, each)) for each in elements)
            equal = self._join("or", (self.diagrams.both(a, b) for a, b in pairs))
        return equal if operator == "==" else self.diagrams.negate(equal)

    def _is_element(self, node: Expr, element: str) -> Node:
        value = self.table.value_of(node)
        if value is not None:
            return TRUE if value == element else FALSE
        index = self.table.elements(node.type).index(element)
        return self._test(self._level(node), NumberSet(intervals=(((index, 0), (index + 1, 0)),)))

    def _compare_number(self, node: Expr, operator: str, number: float) -> Node:
        """Compare with a constant; a negation or an absolute value is moved to the constant, which is exact."""
        return self._test_in(node, compare_with(operator, float(number) if node.type == FLOAT else number))

    def _test_in(self, node: Expr, numbers: NumberSet) -> Node:
        match node:
            case Minus(operand=operand) if self.table.value_of(node) is None:
                return self._test_in(operand, mirror(numbers))
            case FunctionCall(function="abs", arguments=(operand,)):
                positive = NumberSet(intervals=cut_off(numbers.intervals, (0, 0)), has_nan=numbers.has_nan)
                negative = NumberSet(intervals=mirror(positive).intervals)
                return self.diagrams.either(self._test_in(operand, positive), self._test_in(operand, negative))
            case FunctionCall(function="float", arguments=(operand,)):
                return self._test_in(operand, numbers)
            case ElapsedTime(kind="state"):
                return self._test(STATE_TIME, self._as_ns(numbers))
            case _:
                return self._test(self._level(node), numbers)

    def _as_ns(self, numbers: NumberSet) -> NumberSet:
        """The nanoseconds of which the time in seconds is in a numbers, as `state_time` divides them."""

        def find_first(position: Position) -> Position:
            seconds, side = position
            if math.isinf(seconds):
                return position
            first = math.floor(seconds * self.table.ns_per_unit) - 2
            while (first / self.table.ns_per_unit, 0) < (seconds, side):
                first += 1
            return (first, 0)

        return replace(numbers, intervals=tuple((find_first(low), find_first(high)) for low, high in numbers.intervals))

    def _compare_order(self, left: Expr, operator: str, right: Expr) -> Node:
        """Compare two values: their order is a separate quantity, -1, 0, 1, or nan."""
        shapes = (shape_of(left), shape_of(right))
        if shapes[0] == shapes[1]:
            return self._compare_with_itself(left, operator)
        if repr(shapes[0]) > repr(shapes[1]):
            left, right, operator, shapes = right, left, _MIRRORED[operator], shapes[::-1]
        level = self._levels.get(("order", *shapes))
        if level is None:
            reads = self._reads(left, right)
            level = self._levels["order", *shapes] = self._next_computed()
            self.computed.add(level, reads, (left, right))
            is_int = left.type == right.type == INT
            domain = (BEFORE_ALL, BEFORE_NAN if is_int else AFTER_ALL)
            self.quantities[level] = Quantity(name="", type=FLOAT, domain=domain)
        return self._test(level, compare_with(operator, 0))

    def _compare_with_itself(self, node: Expr, operator: str) -> Node:
        """Only nan is not equal to itself."""
        is_nan = FALSE if node.type == INT else self._test(self._level(node), NumberSet(intervals=(), has_nan=True))
        if operator in ("<", ">"):
            return FALSE
        return is_nan if operator == "!=" else self.diagrams.negate(is_nan)

    # Variables

    def _level(self, node: Expr) -> int:
        """The level of the variable of a quantity."""
        shape = shape_of(node)
        if shape not in self._levels:
            if is_leaf(node):
                level = _FIRST_COMPUTED - (len(self.quantities) - len(self.computed))
            else:
                is_number = node.type in (INT, FLOAT)
                reads = self._reads(node) if is_number else ()
                level = self._next_computed()
                self.computed.add(level, reads, (node,) if is_number else ())
            self._levels[shape] = level
            self.quantities[level] = self.table.quantity(node)
        return self._levels[shape]

    def _next_computed(self) -> int:
        return 2 * _FIRST_COMPUTED - len(self.computed)

    def _reads(self, *nodes: Expr) -> tuple[int, ...]:
        found = {self._level(each) for node in nodes for each in walk(node) if self._is_free_number(each)}
        return tuple(sorted(found))

    def _is_free_number(self, node: Expr) -> bool:
        return is_leaf(node) and node.type in (INT, FLOAT) and self.table.value_of(node) is None

    def _test_bool(self, level: int) -> Node:
        return self._test(level, NumberSet(intervals=(((1, 0), (2, 0)),)))

    def _test(self, level: int, numbers: NumberSet) -> Node:
        type_ = self.quantities[level].type
        intervals = list(numbers.intervals)
        if type_ in (INT, NANOSECONDS):
            intervals = [(before_whole(low), before_whole(high)) for low, high in intervals]
        elif numbers.has_nan and type_ == FLOAT:
            if intervals and intervals[-1][1] == BEFORE_NAN:
                intervals[-1] = (intervals[-1][0], AFTER_ALL)
            else:
                intervals.append((BEFORE_NAN, AFTER_ALL))
        return self.diagrams.test(level, intervals)


def _is_exact(node: Expr, number: float) -> bool:
    """Whether a comparison with a constant compares the exact values: large ints are converted to doubles."""
    return node.type == FLOAT or math.isinf(number) or math.isnan(number) or abs(number) < 2**53
