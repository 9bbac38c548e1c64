"""Rules about who steps what in an iteration: twice, or never although it is read."""

import re
from collections.abc import Callable, Collection, Iterable, Iterator
from functools import cache, partial
from itertools import combinations

from vicode.check.context import RuleContext
from vicode.check.graphs import StepSite, find_path
from vicode.findings import Finding, Note
from vicode.model.design import COMMON, Use
from vicode.model.expressions import Done, OutputRef, walk

SharedDescendants = Callable[[str, str], frozenset[str]]


def find_stepped_twice(context: RuleContext) -> Iterator[Finding]:
    """D425: a component that one state steps twice, itself or through two of those it steps.

    Below the state only components without a frequency count: one that has a frequency works once an iteration,
    however often it is stepped.
    """
    if context.graphs.is_in_cycle(context.design.component):
        return
    reach = cache(partial(_shared_descendants, context))
    by_state: dict[str, list[StepSite]] = {COMMON: []}
    for step in context.steps:
        by_state.setdefault(step.state, list(by_state[COMMON])).append(step)
    for state, steps in by_state.items():
        ordered = sorted(steps, key=lambda step: step.is_call)
        for component, first, second in _find_double_steps(ordered, reach):
            # What the common actions do alone is said once, not for every state again.
            if state in (first.state, second.state):
                yield _report_double_step(context, component, first, second)


def _find_double_steps(steps: Iterable[StepSite], reach: SharedDescendants) -> Iterator[tuple[str, StepSite, StepSite]]:
    said: set[str] = set()
    for first, second in combinations(steps, 2):
        is_direct = first.component == second.component
        twice = frozenset({first.component}) if is_direct else reach(first.component, second.component)
        for component in sorted(twice - said):
            said.add(component)
            yield component, first, second


def _report_double_step(context: RuleContext, component: str, first: StepSite, second: StepSite) -> Finding:
    # A common step after a required one is second in time, but the state's own place is where it can be mended.
    first, second = (second, first) if second.state == COMMON else (first, second)
    ways = [
        f"by '{step.alias}'" if step.component == component else f"below '{step.alias}'" for step in (first, second)
    ]
    message = f"{component} is stepped twice in an iteration: {ways[0]} and {ways[1]}"
    if first.component == second.component == component:
        mend = "step it once"
    else:
        mend = "step it in one place, or give it a frequency: it then works once an iteration"
    note = Note(message="stepped here as well", subject=context.make_subject(first.path, is_key=_is_key(first)))
    return context.make_finding("D425", second.path, message, mend, is_key=_is_key(second), notes=[note])


def _is_key(step: StepSite) -> bool:
    return step.path[-2] == "modulates"


def _shared_descendants(context: RuleContext, first: str, second: str) -> frozenset[str]:
    """Topmost components without a frequency that stepping either of two components reaches."""
    graph = context.graphs.steps
    shared = ({first} | context.graphs.transitive_steps(first)) & ({second} | context.graphs.transitive_steps(second))
    working = {component for component in shared if not _has_frequency(context, component)}
    return frozenset(
        each for each in working if not any(other != each and find_path(graph, other, each) for other in working)
    )


def _has_frequency(context: RuleContext, component: str) -> bool:
    interface = context.project.interface(component)
    return interface is None or bool(interface.frequency_hz)


def find_never_stepped(context: RuleContext) -> Iterator[Finding]:
    """D426: reading an output of a component that neither this design steps nor its code, nor anyone below it."""
    stepped = {step.component for step in context.steps} | _stepped_by_code(context)
    for component in tuple(stepped):
        stepped |= context.graphs.transitive_steps(component)
    idle = {use.alias: use.component for use in context.design.uses if _is_idle(context, use, stepped)}
    if not idle:
        return
    for expression in context.expressions:
        for node in walk(expression.tree) if expression.tree is not None else ():
            if isinstance(node, OutputRef | Done) and node.alias in idle:
                message = f"'{node.alias}' is read, but nothing here steps {idle[node.alias]}"
                mend = f"add requires: [{node.alias}] to the states that read it"
                yield context.make_finding("D426", expression.path, message, mend, span=node.span)


def _is_idle(context: RuleContext, use: Use, stepped: Collection[str]) -> bool:
    """Nobody steps it, and it is not one that only hands on what it is asked."""
    interface = context.project.interface(use.component)
    return use.component not in stepped and not (interface is not None and interface.is_generated)


def _stepped_by_code(context: RuleContext) -> set[str]:
    texts = [text for placed in context.code_blocks for _language, text in placed.code.texts]
    calls = (
        (use.component, re.compile(rf"\b{re.escape(use.alias)}\s*(\.|->)\s*step\s*\(")) for use in context.design.uses
    )
    return {component for component, call in calls if any(map(call.search, texts))}


RULES = (find_stepped_twice, find_never_stepped)
