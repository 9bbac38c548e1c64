"""Describes the first difference of a replay: the states, and the guards with the values that they read."""

import re
from collections.abc import Iterator, Mapping
from typing import Any

from vicode.model.constant_folding import evaluate_constants
from vicode.model.design import COMMON, Design, Guard, Transition
from vicode.model.project import Project
from vicode.model.traversal import iter_transitions
from vicode.runs.replay import Difference

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
        lines += _describe_guards(design, difference, evaluate_constants(project))
    return lines


def _state(state: str | None) -> str:
    return "no step" if state is None else state


def _describe_guards(design: Design, difference: Difference, constants: Mapping[str, Any]) -> Iterator[str]:
    """The transitions to either state, from the state before."""
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
        if recorded is not None or replayed is not None:
            yield f"    {name} = {_value(recorded)}" + (f", now {_value(replayed)}" if recorded != replayed else "")
        elif name in constants:
            yield f"    {name} = {_value(constants[name])}"


def _words(guard: Guard) -> str:
    parts = [guard.when, f"after {guard.after}" if guard.after else "", "code" if guard.code else ""]
    return ", ".join(part for part in parts if part)


def _find(values: Mapping[str, Mapping[str, Any]], component: str, name: str) -> Any:
    return values.get(component, {}).get(name)


def _value(value: Any) -> str:
    return "unknown" if value is None else f"{value:g}" if isinstance(value, float) else str(value)
