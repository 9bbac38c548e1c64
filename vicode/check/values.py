"""Rules for values: divisions by zero, values outside of ranges, times that a component cannot keep."""

from collections.abc import Iterator
from itertools import islice

from vicode.analysis.bounds import find_bounds
from vicode.analysis.divisions import DivisionSearch, ZeroDivision
from vicode.analysis.examples import describe_value
from vicode.analysis.guards import TestedDecision
from vicode.analysis.interval_diagrams import BEFORE_NAN, TooLargeError
from vicode.check.context import RuleContext
from vicode.check.declarations import validate_range
from vicode.check.typed_expressions import analyze_expression, literal_value
from vicode.findings import Finding
from vicode.model.design import Assign
from vicode.model.expressions import FLOAT, INT, Expr, Ternary

_MOST_VALUES = 6
_RESULTS = {"/": "inf or nan", "//": "inf or nan", "%": "nan"}
_XABSL_RESULTS = {"/": "that of a division by 0.0000001", "%": "0"}


def find_divisions_by_zero(context: RuleContext) -> Iterator[Finding]:
    """D436: a division by zero, for values that the declarations allow."""
    divided = [each for each in context.expressions if each.is_sound and set(each.text) & set("/%")]
    if not divided:
        return
    assigned = {
        name for placed in context.actions if isinstance(placed.action, Assign) for name, _text in placed.action.values
    }
    search = DivisionSearch(context.machine, assigned | context.code_identifiers)
    for expression in divided:
        for found in search.find(expression.tree, expression.path) if expression.tree is not None else ():
            message = _describe_division(found, is_xabsl=context.design.arithmetic == "xabsl")
            fix = "test the divisor first" if found.example else "change the divisor"
            if found.example:
                fix = f"{fix}, or exclude 0 from its range"
            yield context.make_finding("D436", expression.path, message, fix, span=found.division.span)


def _describe_division(found: ZeroDivision, *, is_xabsl: bool) -> str:
    results = _RESULTS | _XABSL_RESULTS if is_xabsl else _RESULTS
    more = f" and {len(found.example) - _MOST_VALUES} more" if len(found.example) > _MOST_VALUES else ""
    shown = (f"{name} = {describe_value(value)}" for name, value in islice(found.example.items(), _MOST_VALUES))
    values = f" with {', '.join(shown)}{more}" if found.example else ""
    return f"this divides by 0{values}: the result is {results[found.division.operator]}"


def find_out_of_range_values(context: RuleContext) -> Iterator[Finding]:
    """D427: a value that is outside the declared range, whatever the inputs are."""
    for expression in context.expressions:
        receiver = expression.receiver
        if receiver is None or receiver.range is None or not expression.is_sound or expression.tree is None:
            continue
        for tree in _iterate_results(expression.tree):
            message = validate_range(receiver, *_find_ends(context, tree))
            if message:
                yield context.make_finding(
                    "D427", expression.path, message, "change the value or the range", span=tree.span
                )


def _iterate_results(tree: Expr) -> Iterator[Expr]:
    """The branches of a choice."""
    if isinstance(tree, Ternary):
        yield from _iterate_results(tree.then)
        yield from _iterate_results(tree.otherwise)
    else:
        yield tree


def _find_ends(context: RuleContext, tree: Expr) -> tuple[float | None, float | None]:
    """The least and the greatest value that a number can have; None if it can be nan."""
    literal = literal_value(tree, context.scope)
    if literal is not None or tree.type not in (INT, FLOAT):
        return literal, None
    ((low, _), (high, _)), may_be_nan = find_bounds(tree, {}, context.machine.guards.conditions.table)
    return (None, None) if may_be_nan else (low, high)


def find_short_times(context: RuleContext) -> Iterator[Finding]:
    """D439: a timer or a window of the time in a state that is shorter than the period of the component."""
    hertz, guards = context.design.frequency_hz, context.machine.guards
    # With `resume`, the time in a state includes pauses.
    if hertz is None or not 0 < hertz < float("inf") or context.design.resume:
        return
    period = round(1e9 / hertz)
    for each in (*guards.common, *(each for listed in guards.states.values() for each in listed)):
        guard = each.decision.guard
        timer = analyze_expression(guard.after, context.scope, FLOAT).tree if guard.after else None
        seconds = guards.conditions.table.value_of(timer) if timer is not None else None
        if isinstance(seconds, int | float) and 0 < seconds * guards.conditions.table.ns_per_unit < period:
            message = f"this time is over before the component works again, {1 / hertz:g} s later"
            fix = "use a longer time or a higher frequency"
            yield context.make_finding("D439", (*each.path, "after"), message, fix)
        elif "state_time" in guard.when:
            message = _judge_window(context, each, period)
            fix = "test only the start of the time, or use a longer time"
            if message:
                yield context.make_finding("D439", (*each.path, "when"), message, fix)


def _judge_window(context: RuleContext, tested: TestedDecision, period: int) -> str:
    """Why a guard holds for a time that the component can miss, "" if it does not."""
    context.machine.guards.conditions.diagrams.begin_question()
    try:
        times = context.machine.find_times(tested.own)
    except (TooLargeError, RecursionError):
        return ""
    if len(times) != 1 or times[0][1] >= BEFORE_NAN:
        return ""
    (start, _), (end, _) = times[0]
    works = f"the component works every {period / 1e9:g} s"
    # Only the initial state is tested at the time 0, after a restart.
    is_tested_at_once = tested.path[:2] == ("states", context.design.initial) or tested.path[0] == "common"
    if end <= period and not (start <= 0 and is_tested_at_once):
        return f"this guard never holds: it is first tested {period / 1e9:g} s after the state is entered"
    if start > 0 and end - start < period:
        return f"this guard holds for {(end - start) / 1e9:g} s, but {works}: it can be missed"
    return ""


WARNINGS = (find_divisions_by_zero, find_out_of_range_values, find_short_times)
