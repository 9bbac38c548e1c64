"""Brings the components of a root into the states of a recorded iteration."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import Any

from vicode.bica import Component, Root
from vicode.bica.control import ControlError, convert_value
from vicode.simulation.messages import Start
from vicode.simulation.stubs import StubComponent


def restore_root(root: Root, start: Start) -> None:
    """Let the next step of a root follow a recorded iteration; unknown components and states are ignored."""
    root.iteration, root.now_ns = start.iteration, start.time_ns
    steps = {str(step["component"]): step for step in start.tree}
    components = {type(component).__name__: component for component in root.components}
    for name, component in components.items():
        _restore_values(component, start.values.get(name, {}))
        step = steps.get(name)
        if step is None:
            # The next step is a restart, but not the first one.
            component._stepped_in = start.iteration - 2
            continue
        component._stepped_in = start.iteration
        component._worked_ns = start.worked_ns.get(name, start.time_ns)
        _restore_state(component, step, start.time_ns)
        component._called = list(_find_calls(name, start, components)) if component._period_ns else []


def _restore_state(component: Component, step: Mapping[str, Any], time_ns: int) -> None:
    state = component._states.get(str(step["state"]))
    if state is not None:
        component._current, component.state = state, state.name
    component._entered_ns = time_ns - int(step["state_time_ns"])
    component._started_ns = time_ns - int(step.get("component_time_ns", step["state_time_ns"]))


def _restore_values(component: Component, values: Mapping[str, Any]) -> None:
    if isinstance(component, StubComponent):
        return
    attributes = vars(component)
    for name, value in values.items():
        if name in attributes:
            with suppress(ControlError):
                attributes[name] = convert_value(value, attributes[name], name)


def _find_calls(name: str, start: Start, components: Mapping[str, Component]) -> list[tuple[Component, dict[str, Any]]]:
    """The calls that a component repeats until it works again."""
    return [
        (components[step["component"]], _convert_parameters(components[step["component"]], step["parameters"]))
        for step in start.tree
        if step["by"] == name and step["link"] == "modulates" and step["component"] in components
    ]


def _convert_parameters(component: Component, parameters: Mapping[str, Any]) -> dict[str, Any]:
    defaults = getattr(type(component).modulate, "__kwdefaults__", None) or {}
    converted = dict(parameters)
    for name, value in parameters.items():
        if name in defaults:
            with suppress(ControlError):
                converted[name] = convert_value(value, defaults[name], name)
    return converted
