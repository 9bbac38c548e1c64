"""Rules for stepping components in an iteration: stepped twice, or read but not stepped."""

import re
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cache, partial
from itertools import combinations

from vicode.check.context import RuleContext
from vicode.check.graphs import StepSite
from vicode.check.typed_expressions import TypedExpression
from vicode.findings import Finding, Note
from vicode.model.design import COMMON, Use
from vicode.model.expressions import Done, OutputRef, walk

_MAX_NAMES = 4
SharedDescendants = Callable[[str, str], frozenset[str]]


def find_stepped_twice(context: RuleContext) -> Iterator[Finding]:
    """D425: a component that a state steps twice, directly or through other components.

    Indirect steps count only for components without a frequency: a component with a frequency runs at most once per
    iteration.
    """
    if context.graphs.is_in_cycle(context.design.component):
        return
    shared = cache(partial(_shared_descendants, context))
    by_state: dict[str, list[StepSite]] = {COMMON: []}
    for step in context.steps:
        by_state.setdefault(step.state, list(by_state[COMMON])).append(step)
    for state, steps in by_state.items():
        ordered = sorted(steps, key=lambda step: step.is_call)
        for component, first, second in _find_double_steps(_overlapping(context, ordered), shared):
            # A double step within the common actions is reported once, not for each state.
            if state in (first.state, second.state):
                yield _report_double_step(context, component, first, second)


def _overlapping(context: RuleContext, steps: Sequence[StepSite]) -> list[StepSite]:
    """Return the steps to compare: the first two of each component that step a component which others step too."""
    sites: dict[str, list[StepSite]] = {}
    for step in steps:
        sites.setdefault(step.component, []).append(step)
    compared = [step for step in steps if any(step is each for each in sites[step.component][:2])]
    times = Counter(each for step in compared for each in _stepped_by(context, step.component))
    return [step for step in compared if any(times[each] > 1 for each in _stepped_by(context, step.component))]


def _find_double_steps(
    steps: Iterable[StepSite], shared: SharedDescendants
) -> Iterator[tuple[str, StepSite, StepSite]]:
    reported: set[str] = set()
    for first, second in combinations(steps, 2):
        is_direct = first.component == second.component
        twice = frozenset({first.component}) if is_direct else shared(first.component, second.component)
        for component in sorted(twice - reported):
            reported.add(component)
            yield component, first, second


def _report_double_step(context: RuleContext, component: str, first: StepSite, second: StepSite) -> Finding:
    # A common step may run after a required one, but the finding belongs to the state, where it can be fixed.
    first, second = (second, first) if second.state == COMMON else (first, second)
    paths = [
        f"by '{step.alias}'" if step.component == component else f"through '{step.alias}'" for step in (first, second)
    ]
    message = f"{component} is stepped twice in an iteration: {paths[0]} and {paths[1]}"
    if first.component == second.component == component:
        fix = "step it once"
    else:
        fix = "step it in one place, or set its frequency so that it runs once per iteration"
    note = Note(message="also stepped here", subject=context.make_subject(first.path, is_key=_is_key(first)))
    return context.make_finding("D425", second.path, message, fix, is_key=_is_key(second), notes=[note])


def _is_key(step: StepSite) -> bool:
    return step.path[-2] == "modulates"


def _shared_descendants(context: RuleContext, first: str, second: str) -> frozenset[str]:
    """Return the topmost components without a frequency that both components step."""
    graph, shared = context.graphs.steps, _stepped_by(context, first) & _stepped_by(context, second)
    unlimited = {component for component in shared if not _has_frequency(context, component)}
    return frozenset(
        each for each in unlimited if not any(other != each and graph.path(other, each) for other in unlimited)
    )


def _stepped_by(context: RuleContext, component: str) -> set[str]:
    return {component} | context.graphs.transitive_steps(component)


def _has_frequency(context: RuleContext, component: str) -> bool:
    interface = context.project.interface(component)
    return interface is None or bool(interface.frequency_hz)


def find_unstepped_reads(context: RuleContext) -> Iterator[Finding]:
    """D426: an output that is read in a state in which nothing steps its component.

    Only the states count in which neither the state, the common actions, code nor a stepped component steps it, unless
    all callers do.
    """
    own: dict[str, set[str]] = {}
    for step in context.steps:
        own.setdefault(step.state, set()).add(step.component)
    somewhere = set().union(*own.values())
    with_it = context.graphs.stepped_with(context.design.component)
    always = own.pop(COMMON, set()) | _stepped_by_code(context) | with_it
    stepped = {
        state.name: _with_descendants(context, always | own.get(state.name, set()))
        for state in context.design.states
        if not state.disabled
    }
    needing = {use.alias: use.component for use in context.design.uses if _needs_steps(context, use)}
    if not needing:
        return
    for expression in context.expressions:
        states = _reading_states(expression, stepped)
        for node in walk(expression.tree) if expression.tree is not None else ():
            if isinstance(node, OutputRef | Done) and node.alias in needing:
                component = needing[node.alias]
                idle = [state for state in states if component not in stepped[state]]
                # A common transition may test done(x) in all states, of which some do not call x.
                if idle and not (isinstance(node, Done) and len(idle) < len(states)):
                    is_stepped = component in somewhere
                    yield _report_unstepped_read(context, expression, node, component, idle, is_stepped=is_stepped)


def _report_unstepped_read(
    context: RuleContext,
    expression: TypedExpression,
    node: OutputRef | Done,
    component: str,
    idle: list[str],
    *,
    is_stepped: bool,
) -> Finding:
    alias, where = node.alias, ", ".join(idle[:_MAX_NAMES]) + (", …" if len(idle) > _MAX_NAMES else "")
    if is_stepped:
        message = f"'{alias}' is read in {where}, but nothing steps {component} there"
    else:
        message = f"'{alias}' is read, but {component} is never stepped"
    fix = f"add requires: [{alias}] to {where}"
    finding = context.make_finding("D426", expression.path, message, fix, span=node.span)
    return replace(finding, name=alias)


def _reading_states(expression: TypedExpression, states: Collection[str]) -> list[str]:
    """The states that evaluate an expression after the components that they require were stepped.

    `enter` is excluded: it may use the values of the previous state.
    """
    match expression.path:
        case ("common", *_):
            return list(states)
        case ("states", str(name), str(phase), *_) if phase != "enter" and name in states:
            return [name]
        case _:
            return []


def _with_descendants(context: RuleContext, components: Collection[str]) -> frozenset[str]:
    return frozenset(components).union(*(context.graphs.transitive_steps(each) for each in components))


def _needs_steps(context: RuleContext, use: Use) -> bool:
    """Return whether the outputs of a component change only when it is stepped."""
    interface = context.project.interface(use.component)
    return interface is None or not interface.is_generated or context.project.design(use.component) is not None


def _stepped_by_code(context: RuleContext) -> set[str]:
    texts = [text for placed in context.code_blocks for _language, text in placed.code.texts]
    calls = (
        (use.component, re.compile(rf"\b{re.escape(use.alias)}\s*(\.|->)\s*step\s*\(")) for use in context.design.uses
    )
    return {component for component, call in calls if any(map(call.search, texts))}


WARNINGS = (find_stepped_twice, find_unstepped_reads)
