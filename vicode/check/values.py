"""Rules for values: divisions by zero, values outside of ranges, times that a component cannot keep."""

from collections.abc import Iterator

from vicode.analysis.bounds import find_bounds
from vicode.analysis.divisions import DivisionSearch
from vicode.analysis.examples import describe_value
from vicode.analysis.guards import TestedDecision
from vicode.analysis.interval_diagrams import BEFORE_ALL, TooLargeError
from vicode.check.context import RuleContext
from vicode.check.declarations import find_set_names, validate_range
from vicode.check.typed_expressions import analyze_expression, literal_value
from vicode.findings import Finding
from vicode.model.expressions import FLOAT, INT, Expr, Ternary

_RESULTS = {"/": "inf or nan", "//": "inf or nan", "%": "nan"}
_XABSL_RESULTS = _RESULTS | {"/": "that of a division by 0.0000001", "%": "0"}


def find_divisions_by_zero(context: RuleContext) -> Iterator[Finding]:
    """D443: a division by zero, for values that the declarations allow."""
    divided = [each for each in context.expressions if each.is_sound and set(each.text) & set("/%")]
    search = DivisionSearch(context.machine, find_set_names(context)) if divided else None
    results = _XABSL_RESULTS if context.design.arithmetic == "xabsl" else _RESULTS
    for expression in divided:
        found = search.find(expression.tree, expression.path) if search and expression.tree else ()
        for division, example in found:
            values = ", ".join(f"{name} = {describe_value(value)}" for name, value in example.items())
            message = f"this divides by 0{' with ' * bool(values)}{values}: the result is {results[division.operator]}"
            fix = "test the divisor first, or exclude 0 from its range" if example else "change the divisor"
            yield context.make_finding("D443", expression.path, message, fix, span=division.span)


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
    # What it reads is in its range: if it is not, that is reported where it was set.
    declared = frozenset(declaration.name for _section, declaration in context.design.declarations())
    table = context.machine.guards.conditions.table.trusting(declared)
    ((low, _), (high, _)), may_be_nan = find_bounds(tree, {}, table)
    return (None, None) if may_be_nan else (low, high)


def find_short_times(context: RuleContext) -> Iterator[Finding]:
    """D446: a timer or a window of the time in a state that is shorter than the period of the component."""
    hertz, guards = context.design.frequency_hz, context.machine.guards
    # With `resume`, the time in a state includes pauses.
    if hertz is None or not 0 < hertz < float("inf") or context.design.resume:
        return
    table, period = guards.conditions.table, 1e9 / hertz
    fix, works = "use a longer time or a higher frequency", f"the component works every {1 / hertz:g} s"
    for each in guards.listed:
        guard = each.decision.guard
        timer = analyze_expression(guard.after, context.scope, FLOAT).tree if guard.after else None
        time = table.value_of(timer) if timer is not None else None
        # A time may be a rounded period.
        if isinstance(time, int | float) and 0 < time * table.ns_per_unit < 0.9 * period:
            message = f"this time is shorter than the period: {works}"
            yield context.make_finding("D446", (*each.path, "after"), message, fix)
        elif "state_time" in guard.when and (length := _find_window(context, each, period)):
            message = f"this guard can hold for {length / 1e9:g} s only and be missed: {works}"
            yield context.make_finding("D446", (*each.path, "when"), message, fix)


def _find_window(context: RuleContext, tested: TestedDecision, period: float) -> float:
    """The time for which a guard can hold, if the component can miss it, else 0."""
    context.machine.guards.conditions.diagrams.begin_question()
    try:
        times = context.machine.find_times(tested.own)
    except (TooLargeError, RecursionError):
        return 0
    (start, _), (end, _) = times[0] if len(times) == 1 else (BEFORE_ALL, BEFORE_ALL)
    # Only the initial state is tested at the time 0, after a restart.
    is_tested_at_once = tested.path[:2] == ("states", context.design.initial) or tested.path[0] == "common"
    return end - start if end - start < period and (start > 0 or not is_tested_at_once) else 0


WARNINGS = (find_divisions_by_zero, find_out_of_range_values, find_short_times)
