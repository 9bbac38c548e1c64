"""Describes what a replay found: the first difference with the guards that decided, or what another value changes."""

import re
from collections.abc import Iterator, Mapping
from typing import Any

from vicode.model.constant_folding import evaluate_constants
from vicode.model.design import COMMON, Design, Guard, Transition
from vicode.model.project import Project
from vicode.model.traversal import iter_transitions
from vicode.runs.replay import Difference
from vicode.runs.value_replay import ValueEffect

_UNLIKE_RECORD = "the design was changed since, or a viewer changed the run."
_NAME = re.compile(r"(?<![\w.])[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)?")


def describe_difference(project: Project, difference: Difference) -> list[str]:
    """Lines for the terminal: time, component and states, then the guards that decided."""
    time_s = difference.time_ns / 1e9
    expected, got = _state(difference.expected), _state(difference.got)
    lines = [
        f"{time_s:.3f} s, iteration {difference.iteration}: {difference.component}: expected {expected}, got {got}"
    ]
    if difference.before:
        lines.append(f"  before: {difference.before}")
    design = project.design(difference.component)
    if design is not None and difference.before is not None:
        constants = evaluate_constants(project)
        lines += _describe_guards(design, difference, constants, constants)
    return lines


OPEN_LOOP = "The recorded inputs do not react to the changed behavior."


def summarize_effect(effect: ValueEffect) -> str:
    """One line: how many iterations change, and the first one."""
    whole = f"{effect.iterations} iteration{'s' * (effect.iterations != 1)}"
    first = effect.first
    if first is None:
        return f"No iteration changes ({whole})"
    verb = "changes" if effect.changed == 1 else "change"
    return f"{effect.changed} of {whole} {verb}; first at {first.time_ns / 1e9:.3f} s: {_describe_change(first)}"


def describe_effect(project: Project, changed: Project, effect: ValueEffect) -> list[str]:
    """Lines for the terminal: the guards that decided first, and the time in each state that changes.

    Args:
        project: The project as it is.
        changed: The project with the changed values.
        effect: What changes.
    """
    lines: list[str] = []
    first = effect.first
    design = project.design(first.component) if first is not None else None
    if first is not None and design is not None and first.before is not None:
        lines += _describe_guards(design, first, evaluate_constants(project), evaluate_constants(changed))
    rows = changed_times(effect)
    width = max((len(f"{component} {state}") for component, state, _before, _after in rows), default=0)
    if rows:
        lines.append(f"  {'time in states':{width}} {'before':>10} {'after':>10}")
    for component, state, before_s, after_s in rows:
        lines.append(f"  {f'{component} {state}':{width}} {before_s:8.2f} s {after_s:8.2f} s")
    return lines


def describe_unlike_record(effect: ValueEffect) -> str:
    """A note if the record cannot be reproduced even without the change; "" if it can."""
    if not effect.unlike_record:
        return ""
    count = f"{effect.unlike_record} iteration{'s' * (effect.unlike_record != 1)}"
    return f"Without the change, the states of {count} already differ from the record: {_UNLIKE_RECORD}"


def changed_times(effect: ValueEffect) -> list[tuple[str, str, float, float]]:
    """Component, state, and seconds before and after, of the states whose time changes."""
    rows = ((*key, before / 1e9, after / 1e9) for key, (before, after) in effect.times_ns.items() if before != after)
    return sorted(rows)


def _describe_change(first: Difference) -> str:
    old, new, before = first.expected, first.got, first.before
    name = first.component
    if new is None:
        words = f"{name} is not active"
    else:
        words = f"{name} stays in {new}" if new == before else f"{name}: {before or 'start'} → {new}"
    instead = "not being active" if old is None else "staying" if old == before else f"→ {old}"
    return f"{words} instead of {instead}"


def _state(state: str | None) -> str:
    return "no step" if state is None else state


def _describe_guards(
    design: Design, difference: Difference, constants: Mapping[str, Any], changed: Mapping[str, Any]
) -> Iterator[str]:
    """The transitions to either state, from the state before, and the values that they read."""
    targets = {difference.expected, difference.got} - {difference.before}
    names: list[str] = []
    for located in iter_transitions(design):
        decision = located.decision
        if not isinstance(decision, Transition) or located.source not in (difference.before, COMMON):
            continue
        if decision.to not in targets:
            continue
        guards = [group.guard for group, _is_then in located.groups] + [decision.guard]
        words = " and ".join(_words(guard) for guard in guards if not guard.is_empty) or "always"
        yield f"  {located.source} → {decision.to}: {words}"
        names += [name for guard in guards for name in _NAME.findall(guard.when) if name not in names]
    components = {use.alias: use.component for use in design.uses}
    for name in names:
        alias, _dot, output = name.rpartition(".")
        component = components.get(alias, "") if alias else design.component
        recorded, replayed = (_find(values, component, output) for values in (difference.recorded, difference.replayed))
        if recorded is None and replayed is None:
            recorded, replayed = constants.get(name), changed.get(name)
        if recorded is not None or replayed is not None:
            then = "not in the trace" if recorded is None else _value(recorded)
            yield f"    {name} = {then}" + (f", now {_value(replayed)}" if recorded != replayed else "")


def _words(guard: Guard) -> str:
    parts = [guard.when, f"after {guard.after}" if guard.after else "", "code" if guard.code else ""]
    return ", ".join(part for part in parts if part)


def _find(values: Mapping[str, Mapping[str, Any]], component: str, name: str) -> Any:
    return values.get(component, {}).get(name)


def _value(value: Any) -> str:
    return "unknown" if value is None else f"{value:g}" if isinstance(value, float) else str(value)
