"""Observer: records each iteration as JSON-compatible dictionaries, in the form of a trace (docs/traces.md)."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import asdict
from enum import Enum
from functools import lru_cache
from inspect import isfunction
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NotRequired, TypedDict, cast

from .component import RESERVED_NAMES, Component
from .timing import replace_step, will_work

if TYPE_CHECKING:
    from .base_root import BaseRoot
    from .errors import ErrorRecord

TRACE_HEADER = {"vicode-trace": 1, "runtime": "bica"}
"""The first line of a trace: the version of the form and the writer."""

_MAX_ERRORS = 20
_MAX_INT_BITS = 1024
_PLAIN_TYPES = (bool, int, float, str, Enum)
_MAX_CALLS = 200
"""So many calls of outputs with arguments are recorded per iteration at most."""

ActivationLink = Literal["root", "requires", "modulates"]


class StepRecord(TypedDict):
    """One step of a component.

    Attributes:
        component: The name of its class.
        by: The component that stepped it; None for the root.
        link: Why it was stepped: as the root, because a state requires it, or by a call.
        worked: Whether it worked, because its period had elapsed.
        state: The active state after the step.
        state_time_ns: Time since the state was entered.
        changed_from: The state before a change in this step.
        transition: The id of the transition taken.
        parameters: What the call set.
        done: Whether it is done.
        action_done: Whether a component that the state calls is done, if a guard reads that.
        conflict: Whether other robots fill the capacity of the state, if it has one.
        team_size: Number of robots of the team that are alive, if there are others.
        component_time_ns: Time since the restart.
        values: Outputs, variables and parameters.
    """

    component: str
    by: str | None
    link: ActivationLink
    worked: bool
    state: str
    state_time_ns: int
    changed_from: str | None
    transition: str | None
    parameters: dict[str, Any]
    done: bool
    action_done: NotRequired[bool]
    conflict: NotRequired[bool]
    team_size: NotRequired[int]
    component_time_ns: NotRequired[int]
    values: NotRequired[dict[str, Any]]


class CallRecord(TypedDict):
    """What an output with arguments returned; positional arguments have their index as name."""

    component: str
    output: str
    arguments: dict[str, Any]
    value: Any


class IterationRecord(TypedDict):
    """One iteration.

    Attributes:
        iteration: Its number, from 1.
        time_ns: Its time.
        tree: The steps in the order of their start.
        errors: The first exceptions.
        still_done: Components that are done although this iteration did not step them.
        inputs: The values of components that only provide values, before the iteration, whether they are stepped in it
            or not.
        calls: What outputs with arguments returned.
        dropped: Number of iterations before this one that were not recorded.
    """

    iteration: int
    time_ns: int
    tree: list[StepRecord]
    errors: list[dict[str, Any]]
    still_done: list[str]
    inputs: NotRequired[dict[str, dict[str, Any]]]
    calls: NotRequired[list[CallRecord]]
    dropped: NotRequired[int]


class Observer:
    """Observes all components of one root.

    Args:
        sink: Called with the record of each iteration; without it, the records are appended to `records`.
        values: Whether to record outputs, variables and parameters, that is, public attributes with plain values.
    """

    def __init__(self, sink: Callable[[IterationRecord], None] | None = None, *, values: bool = False) -> None:
        self.records: list[IterationRecord] = []
        self._sink = sink if sink is not None else self.records.append
        self.has_values = self._records_calls = values
        self._tree: list[StepRecord] = []
        self._errors: list[dict[str, Any]] = []
        self.active: list[str] = []
        """The components whose code runs, the innermost last."""
        self._stepped: list[Component] = []
        self._calls: dict[str, CallRecord] = {}
        self._modulated: tuple[Component, dict[str, Any]] | None = None
        self._known_components = -1
        self._passive: tuple[Component, ...] = ()

    def attach(self, component: Component) -> None:
        """Observe `component`: instance attributes shadow its methods `step` and `modulate`."""
        plain_step = component.step
        plain_modulate: Callable[..., None] = component.modulate
        defaults = getattr(type(component).modulate, "__kwdefaults__", None) or {}

        def observed_modulate(**parameters: Any) -> None:
            plain_modulate(**parameters)
            self._modulated = (component, to_json_value({**defaults, **parameters}))

        component.__dict__["modulate"] = observed_modulate
        replace_step(component, lambda: self._observe_step(component, plain_step))
        if self._records_calls and not component._states and not component.design_file:
            for name in _find_functions(type(component)):
                component.__dict__[name] = ObservedFunction(getattr(component, name), type(component).__name__, self)

    def add_call(self, component: str, output: str, given: dict[str, Any], value: Any) -> None:
        """Record what a function of a component returned, if all values are plain."""
        if all(isinstance(each, bool | int | float | str | Enum) for each in (value, *given.values())):
            arguments = to_json_value(given)
            key = f"{component}.{output}{arguments}"
            if len(self._calls) < _MAX_CALLS or key in self._calls:
                call: CallRecord = {"component": component, "output": output, "arguments": arguments, "value": None}
                self._calls[key] = {**call, "value": to_json_value(value)}

    def add_error(self, error: ErrorRecord) -> None:
        """Record an exception of this iteration, without the folder of its file, which differs from run to run."""
        if len(self._errors) < _MAX_ERRORS:
            self._errors.append({**asdict(error), "file": Path(error.file).name})

    def observe_iteration(self, root: BaseRoot, step: Callable[[], None] | None = None) -> None:
        """Step the root component, by default with its method, and pass the record of the iteration to the sink."""
        self._tree, self._errors = [], []
        self.active.clear()
        self._calls = {}
        self._modulated = None
        record: IterationRecord = {
            "iteration": root.iteration,
            "time_ns": root.now_ns,
            "tree": self._tree,
            "errors": self._errors,
            "still_done": [],
        }
        before, self._stepped = self._stepped, []
        if self.has_values:
            inputs = {type(each).__name__: read_values(each) for each in self._find_passive(root)}
            if any(inputs.values()):
                record["inputs"] = to_json_value({name: values for name, values in inputs.items() if values})
        try:
            (step or root.main.step)()
        finally:
            # Only of these, `is_done` cannot be seen in the tree: it also counts the iteration before.
            left = [each for each in before if each._stepped_in != root.iteration]
            if left:
                record["still_done"] = sorted({type(each).__name__ for each in left if each.is_done})
            if self._calls:
                record["calls"] = [*self._calls.values()]
            self._sink(record)

    def _find_passive(self, root: BaseRoot) -> tuple[Component, ...]:
        """The components without work and states, which only provide values."""
        if len(root.components) != self._known_components:
            passive = (each for each in root.components if type(each).work is Component.work and not each._states)
            self._known_components, self._passive = len(root.components), tuple(passive)
        return self._passive

    def _observe_step(self, component: Component, plain_step: Callable[[], None]) -> None:
        record = self._begin_record(component)
        self._tree.append(record)
        self.active.append(record["component"])
        self._stepped.append(component)
        component._left = component._transition = None
        try:
            plain_step()
        finally:
            self.active.pop()
            self._finish_record(record, component)

    def _begin_record(self, component: Component) -> StepRecord:
        modulated, self._modulated = self._modulated, None
        is_modulated = modulated is not None and modulated[0] is component
        by = self.active[-1] if self.active else None
        return {
            "component": type(component).__name__,
            "by": by,
            "link": "root" if by is None else "modulates" if is_modulated else "requires",
            "worked": will_work(component),
            "state": component.state,
            "state_time_ns": 0,
            "changed_from": None,
            "transition": None,
            "parameters": modulated[1] if modulated is not None and is_modulated else {},
            "done": False,
        }

    def _finish_record(self, record: StepRecord, component: Component) -> None:
        record["state"] = component.state
        record["changed_from"] = component._left.name if component._left is not None else None
        record["transition"] = component._transition
        record["state_time_ns"] = component.root.now_ns - component._entered_ns
        record["done"] = component.is_done
        if component._reads_action_done:
            record["action_done"] = component.action_done
        if component._cooperative_states:
            record["conflict"] = component.conflict
        if component.root.team.size != 1:
            record["team_size"] = component.root.team.size
        if self.has_values:
            record["component_time_ns"] = component.root.now_ns - component._started_ns
            record["values"] = to_json_value(read_values(component))


def only_changes(sink: Callable[[IterationRecord], None]) -> Callable[[IterationRecord], None]:
    """A sink that drops iterations in which the same components are in the same states as in the one before."""
    known: list[tuple[str, str]] = []

    def pass_changes(record: IterationRecord) -> None:
        states = [(step["component"], step["state"]) for step in record["tree"]]
        if states != known or record["errors"] or any(step["changed_from"] is not None for step in record["tree"]):
            known[:] = states
            sink(record)

    return pass_changes


class ObservedFunction:
    """An output with arguments, in place of the method of a component."""

    def __init__(self, function: Callable[..., Any], component: str, observer: Observer) -> None:
        self._function, self._component, self._observer = function, component, observer
        self.__name__: str = function.__name__

    def __call__(self, *positional: Any, **named: Any) -> Any:
        """Call the method, and record the result if another component asked."""
        active = self._observer.active
        if not active or active[-1] == self._component:
            return self._function(*positional, **named)
        active.append(self._component)
        try:
            value = self._function(*positional, **named)
        finally:
            active.pop()
        given = {**{str(index): each for index, each in enumerate(positional)}, **named}
        self._observer.add_call(self._component, self.__name__, given, value)
        return value


def _find_functions(component_class: type[Component]) -> list[str]:
    """The names of public methods with arguments."""
    return [
        name
        for name in dir(component_class)
        if not name.startswith("_")
        and name not in RESERVED_NAMES
        and isfunction(function := getattr(component_class, name))
        and function.__code__.co_argcount + function.__code__.co_kwonlyargcount > 1
    ]


def to_json_value(value: object) -> Any:
    """Convert a value to JSON data that is the same in each run."""
    kind = type(value)
    if kind is str or kind is bool or (kind is float and math.isfinite(cast("float", value))):
        return value  # most values
    if isinstance(value, dict):
        return {str(key): to_json_value(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [to_json_value(item) for item in value]
    if isinstance(value, Enum):
        return f"{type(value).__name__}.{value.name}"
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    if isinstance(value, int) and value.bit_length() > _MAX_INT_BITS:
        # Python refuses to write long integers in decimal.
        return hex(value)
    if value is None or isinstance(value, bool | int | float | str):
        return value
    return type(value).__name__


def read_values(component: Component) -> dict[str, object]:
    """Return the values of a component: all public attributes with plain values, also properties and those of classes.

    This is the only definition of what records, the live view and other robots see. References to other components are
    left out, and attributes that raise an exception.
    """
    # The copy is needed because threads of a component may add attributes.
    values: dict[str, object] = {
        name: value
        for name, value in vars(component).copy().items()
        if not name.startswith("_") and isinstance(value, _PLAIN_TYPES)
    }
    for name in _find_class_attributes(cast("type", type(component))):
        if name not in values:
            with suppress(Exception):
                value = getattr(component, name)
                if isinstance(value, _PLAIN_TYPES):
                    values[name] = value
    return values


@lru_cache(maxsize=1024)
def _find_class_attributes(component_class: type) -> tuple[str, ...]:
    """The public names in a class and its bases below `Component` that may be values: no methods."""
    bases = component_class.__mro__
    attributes = [each for base in reversed(bases[: bases.index(Component)]) for each in vars(base).items()]
    kinds = {name: not callable(value) and not isinstance(value, classmethod) for name, value in attributes}
    return tuple(name for name, is_value in kinds.items() if is_value and name[0] != "_" and name not in RESERVED_NAMES)
