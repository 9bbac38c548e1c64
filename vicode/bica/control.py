"""Requests of viewers that change a running root: pause, step, breakpoints, values, states, errors, frequencies."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Mapping
from enum import Enum
from typing import TYPE_CHECKING, Any

from .arithmetic import limit
from .errors import make_error_record

if TYPE_CHECKING:
    from .base_root import BaseRoot
    from .component import Component
    from .observer import IterationRecord, StepRecord

_MAX_LOGGED = 10
"""So many breakpoints are listed in the log."""
_MIN_FREQUENCY_HZ, _MAX_FREQUENCY_HZ = 0.001, 10_000.0


class ControlError(ValueError):
    """A request that cannot be applied."""


class InjectedError(Exception):
    """An exception that a viewer asked for."""


class Constant:
    """A constant of a project, in every module that uses it.

    Raises:
        ControlError: No component uses it.
    """

    def __init__(self, root: BaseRoot, name: str) -> None:
        modules = {sys.modules[type(each).__module__] for each in root.components}
        owners = [module for module in modules if name in vars(module)]
        shared = {sys.modules.get(f"{module.__package__}.declarations") for module in modules}
        declarations = [module for module in shared if module is not None and name in vars(module)]
        if not declarations or not owners or name.startswith("_"):
            raise ControlError(f"no component uses a constant '{name}'")
        self.name, self._modules = name, (*declarations, *owners)

    @property
    def value(self) -> Any:
        return getattr(self._modules[0], self.name)

    def set(self, given: object, limits: tuple[float, float] | None = None) -> Any:
        """Set a JSON value, and return it in the type of the constant.

        Raises:
            ControlError: It has another type, is not finite, or is not within the limits.
        """
        value = convert_value(given, self.value, self.name)
        if isinstance(value, float) and not math.isfinite(value):
            raise ControlError(f"{self.name} must be a finite number")
        if limits is not None and not limits[0] <= value <= limits[1]:
            raise ControlError(f"{self.name} must be from {limits[0]:g} to {limits[1]:g}")
        for module in self._modules:
            setattr(module, self.name, value)
        return value


class Controller:
    """Applies requests between iterations. What a viewer holds ends when it releases it or disconnects."""

    def __init__(self, root: BaseRoot) -> None:
        self._root = root
        self._paused_by: object = None
        self._steps_left = 0
        self.last_iteration = 0
        """The number of the iteration before the requests."""
        self._breakpoints: dict[object, frozenset[tuple[str | None, ...]]] = {}
        self._held: dict[tuple[str, str], tuple[object, Any]] = {}
        self._injected: dict[str, str] = {}
        self._actions: Mapping[str, Callable[[object, dict[str, Any]], str]] = {
            "pause": self._pause,
            "resume": self._resume,
            "step": self._step,
            "break": self._break,
            "set": self._set,
            "unset": self._unset,
            "enter": self._enter,
            "raise": self._raise,
            "frequency": self._set_frequency,
            "tune": self._tune,
            "release": self._release,
        }

    @property
    def is_paused(self) -> bool:
        return self._paused_by is not None and not self._steps_left

    @property
    def has_effects(self) -> bool:
        """Whether `prepare_step` changes steps."""
        return bool(self._held or self._injected)

    def apply(self, viewer: object, request: dict[str, Any]) -> str:
        """Apply a request and return what was done, for the log; "" if nothing was.

        Raises:
            ControlError: The request is not valid.
        """
        action = self._actions.get(str(request.get("do")))
        if action is None:
            raise ControlError(f"unknown request {request.get('do')!r}; known are {', '.join(self._actions)}")
        return action(viewer, request)

    def check_breakpoints(self, record: IterationRecord) -> str:
        """Pause if an iteration reached a breakpoint, and return the first reached for the log, or ""; count steps."""
        if self._steps_left:
            self._steps_left -= 1
        if not self._breakpoints:
            return ""
        reached = {place for step in record["tree"] if step["changed_from"] is not None for place in _places(step)}
        if record["errors"]:
            reached.add(("", "error"))
        found = [(viewer, place) for viewer, places in self._breakpoints.items() for place in places & reached]
        if not found:
            return ""
        self._paused_by, self._steps_left = found[-1][0], 0
        return min(map(_describe_place, (place for _viewer, place in found)))

    def prepare_step(self, component: Component, plain_step: Callable[[], None]) -> Callable[[], None]:
        """The step of a component with injected errors and held values."""
        name = type(component).__name__
        message = self._injected.pop(name, None)
        values = {attribute: value for (owner, attribute), (_viewer, value) in self._held.items() if owner == name}
        if message is None and not values:
            return plain_step

        def step() -> None:
            if message is not None:
                component._stepped_in = component.root.iteration
                try:
                    _fail(message)
                except InjectedError as error:
                    component.root.report(make_error_record(component, error))
                return
            vars(component).update(values)
            plain_step()
            vars(component).update(values)

        return step

    def _pause(self, viewer: object, _request: dict[str, Any]) -> str:
        self._paused_by, self._steps_left = viewer, 0
        return "paused"

    def _resume(self, _viewer: object, _request: dict[str, Any]) -> str:
        self._paused_by, self._steps_left = None, 0
        return "resumed"

    def _step(self, viewer: object, request: dict[str, Any]) -> str:
        count = request.get("count", 1)
        if not isinstance(count, int) or isinstance(count, bool) or not 1 <= count <= 1_000_000:
            raise ControlError("'count' must be a whole number from 1")
        self._paused_by, self._steps_left = viewer, count
        return f"runs {count} iteration{'s' * (count != 1)}"

    def _break(self, viewer: object, request: dict[str, Any]) -> str:
        """Replace the breakpoints of a viewer: [component, state], or [component, source, target, id] of a transition.

        The source of a common transition is "", and its id may be null; ["", "error"] stops on errors.
        """
        places = request.get("places")
        if not isinstance(places, list) or not all(map(_is_place, places)):
            raise ControlError("'places' must be a list of [component, state] or [component, source, target, id]")
        for component, *states in (place[:3] for place in places if place[0]):
            unknown = [state for state in states if state and state not in self._component(component)._states]
            if unknown:
                raise ControlError(f"{component} has no state '{unknown[0]}'")
        self._breakpoints[viewer] = frozenset(map(tuple, places))
        words = [_describe_place(tuple(place)) for place in places]
        more = f" and {len(words) - _MAX_LOGGED} more" if len(words) > _MAX_LOGGED else ""
        return f"breakpoints: {', '.join(words[:_MAX_LOGGED]) or 'none'}{more}"

    def _set(self, viewer: object, request: dict[str, Any]) -> str:
        component, name = self._component(request.get("component")), str(request.get("name"))
        value = convert_value(request.get("value"), _read_plain(component, name), f"{type(component).__name__}.{name}")
        vars(component)[name] = value
        if request.get("hold"):
            self._held[type(component).__name__, name] = (viewer, value)
        verb = "holds" if request.get("hold") else "set"
        return f"{verb} {type(component).__name__}.{name} = {value}"

    def _unset(self, _viewer: object, request: dict[str, Any]) -> str:
        self._held.pop((str(request.get("component")), str(request.get("name"))), None)
        return f"released {request.get('component')}.{request.get('name')}"

    def _enter(self, _viewer: object, request: dict[str, Any]) -> str:
        """Leave the active state of a component and enter another; its transitions are tested in the next iteration."""
        component = self._component(request.get("component"))
        name = type(component).__name__
        new = component._states.get(str(request.get("state")))
        if new is None:
            raise ControlError(f"{name} has no state '{request.get('state')}'")
        if component._stepped_in != self.last_iteration:
            raise ControlError(f"{name} is not active: it was not stepped in the last iteration")
        old = component._current
        if old.leave is not None:
            old.leave()
        component._current, component.state, component._entered_ns = new, new.name, self._root.now_ns
        component._called = []
        if new.enter is not None:
            new.enter()
        return f"{name}: {old.name} → {new.name}"

    def _raise(self, _viewer: object, request: dict[str, Any]) -> str:
        component = self._component(request.get("component"))
        name, message = type(component).__name__, str(request.get("message") or "injected error")[:200]
        self._injected[name] = message
        return f"the next step of {name} raises: {message}"

    def _set_frequency(self, _viewer: object, request: dict[str, Any]) -> str:
        component = self._component(request.get("component"))
        hertz = request.get("hz")
        if isinstance(hertz, bool) or not (
            isinstance(hertz, int | float) and _MIN_FREQUENCY_HZ <= hertz <= _MAX_FREQUENCY_HZ
        ):
            raise ControlError(f"'hz' must be a number from {_MIN_FREQUENCY_HZ:g} to {_MAX_FREQUENCY_HZ:g}")
        component.set_frequency(hertz)
        return f"{type(component).__name__} works at {hertz:g} Hz"

    def _tune(self, _viewer: object, request: dict[str, Any]) -> str:
        constant = Constant(self._root, str(request.get("name")))
        return f"constant {constant.name} = {constant.set(request.get('value'))}"

    def _release(self, viewer: object, _request: dict[str, Any]) -> str:
        was_paused = self._paused_by is viewer
        if was_paused:
            self._paused_by, self._steps_left = None, 0
        self._breakpoints.pop(viewer, None)
        self._held = {key: held for key, held in self._held.items() if held[0] is not viewer}
        # Whatever the viewer commanded last must not go on; the behavior commands the robot again.
        self._root.hold()
        return "resumed, as the viewer that paused has left" if was_paused else ""

    def _component(self, name: object) -> Component:
        for component in self._root.components:
            if type(component).__name__ == name:
                return component
        raise ControlError(f"no component {name!r}")


def _is_place(place: object) -> bool:
    if not isinstance(place, list) or len(place) not in (2, 4):
        return False
    return all(isinstance(part, str) for part in place[:3]) and isinstance(place[-1], str | None)


def _describe_place(place: tuple[str | None, ...]) -> str:
    """A breakpoint in words; without the id, which the viewer may have invented."""
    component, *states = place[:3]
    if not component:
        return "errors"
    return f"{component} {' → '.join(state or 'any state' for state in states)}"


def _places(step: StepRecord) -> Iterator[tuple[str | None, ...]]:
    """The breakpoints that a change of the state reaches."""
    component, state, transition = step["component"], step["state"], step["transition"]
    yield (component, state)
    yield (component, step["changed_from"], state, transition)
    yield (component, "", state, transition)


def _fail(message: str) -> None:
    raise InjectedError(message)


def _read_plain(component: Component, name: str) -> Any:
    """The value of a public attribute of a component."""
    value = None if name.startswith("_") else vars(component).get(name)
    if not isinstance(value, bool | int | float | str | Enum):
        raise ControlError(f"{type(component).__name__} has no value '{name}' that can be set")
    return value


def convert_value(value: object, old: Any, name: str) -> Any:
    """A JSON value in the type of the old value; enumerations are written "Type.element".

    Raises:
        ControlError: It has another type.
    """
    if isinstance(old, Enum):
        kind = type(old)
        element = str(value).removeprefix(f"{kind.__name__}.")
        if element not in kind.__members__:
            raise ControlError(
                f"{name} must be one of {', '.join(f'{kind.__name__}.{each}' for each in kind.__members__)}"
            )
        return kind[element]
    if isinstance(old, float) and not isinstance(value, bool):
        if isinstance(value, int | float):
            return float(value)
        if value in ("inf", "-inf", "nan"):
            return math.nan if value == "nan" else math.copysign(math.inf, -1 if value == "-inf" else 1)
    if type(value) is not type(old):
        raise ControlError(f"{name} must be a value of type {type(old).__name__}")
    return limit(value) if isinstance(value, int) and not isinstance(value, bool) else value
