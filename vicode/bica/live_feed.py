"""What viewers see of one root, and what they ask of it; runs in the thread that steps the root, unless noted."""

from __future__ import annotations

import hashlib
import inspect
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypedDict

from .control import ControlError, Controller
from .errors import USER_ERRORS, print_error
from .observer import IterationRecord, Observer

if TYPE_CHECKING:
    from .base_root import BaseRoot
    from .component import Component

_MAX_CHANGES = 256
_MAX_REQUESTS = 64
"""So many requests of viewers wait at most; others are refused."""
_MAX_HANDLED = 4
"""So many requests are handled between two iterations at most; the rest wait for the next ones."""
_PAUSED_POLL_S = 0.05
_SHARED_MODULES = ("declarations.py", "interfaces.py")


class StateChangeRecord(TypedDict):
    """A state change of a component; `number` counts the changes of the robot from 1."""

    number: int
    iteration: int
    time_ns: int
    component: str
    source: str
    target: str
    transition: str | None


class Feed(Protocol):
    """What the server delivers of one robot; see `LiveFeed`."""

    name: str
    is_watched: bool
    is_focused: bool
    version: int

    @property
    def root(self) -> object: ...
    @property
    def newest(self) -> tuple[int, Mapping[str, Any]]: ...
    @property
    def changes(self) -> Iterable[Any]: ...
    @property
    def answers(self) -> deque[tuple[object, dict[str, Any]]]: ...
    def describe(self) -> dict[str, Any]: ...
    def request(self, viewer: object, request: dict[str, Any], /) -> bool: ...
    def forget(self, viewer: object, /) -> None: ...


class LiveFeed:
    """Publishes the newest iteration of a root while someone watches, and applies requests between iterations.

    Args:
        root: The root; its step function is replaced.
        name: The name of the robot.
        notify: Called after each published iteration and answer; must not block.
    """

    def __init__(self, root: BaseRoot, name: str, notify: Callable[[], None]) -> None:
        self.root, self.name = root, name
        self.newest: tuple[int, Mapping[str, Any]] = (0, {})
        """The number of the newest message, and the message. Read by the thread of the server."""
        self.changes: deque[StateChangeRecord] = deque(maxlen=_MAX_CHANGES)
        self.answers: deque[tuple[object, dict[str, Any]]] = deque()
        """Viewers and the answers to their requests. Read by the thread of the server."""
        self.is_watched = self.is_focused = False
        """Whether there are viewers, and viewers that look at this robot, which get values."""
        self.version = 0
        """Changes when code was exchanged, after which the robot is described again."""
        self._notify = notify
        self._change_count = 0
        self._requests: deque[tuple[object, dict[str, Any]]] = deque()
        self._has_requests = threading.Event()
        self._controller = Controller(root)
        self._observer = _LiveObserver(self._publish, self._controller)
        self._is_observing = False
        self._plain_step = root._step_main
        self._observed_step = self._plain_step
        root._step_main = self._step
        root._set_step = self._set_plain_step
        root._before_reload.append(self._stop_observing)

    def describe(self) -> dict[str, Any]:
        """Describe the robot: its components with their design, states, and hashes of their code."""
        return {
            "name": self.name,
            "root": type(self.root.main).__name__,
            "components": {type(each).__name__: _describe_component(each) for each in self.root.components},
            "shared": _hash_shared_modules(self.root.components),
        }

    def request(self, viewer: object, request: dict[str, Any]) -> bool:
        """Queue a request of a viewer unless too many wait; called by the thread of the server."""
        if len(self._requests) >= _MAX_REQUESTS:
            return False
        self._queue(viewer, request)
        return True

    def forget(self, viewer: object) -> None:
        """Undo what a viewer holds, such as a pause; called by the thread of the server."""
        self._queue(viewer, {"do": "release"})

    def _queue(self, viewer: object, request: dict[str, Any]) -> None:
        self._requests.append((viewer, request))
        self._has_requests.set()

    def _step(self) -> None:
        if self._requests:
            self._handle_requests(self.root.iteration - 1)
        if self.is_watched is not self._is_observing:
            self._set_observing(self.is_watched)
        if not self._is_observing:
            self._plain_step()
            return
        self._observer.has_values = self.is_focused
        self._observed_step()
        # After the iteration, not before the next one, whose inputs would be as old as the pause is long.
        if self._controller.is_paused:
            self._wait_while_paused()

    def _set_plain_step(self, step: Callable[[], None]) -> None:
        self._plain_step = step
        # Code may have been exchanged.
        _hash_file.cache_clear()
        self.version += 1
        self._notify()

    def _stop_observing(self) -> None:
        if self._is_observing:
            self._set_observing(False)

    def _set_observing(self, is_observing: bool) -> None:
        root, self._is_observing = self.root, is_observing
        if is_observing:
            self._observer.attach_all(root)
            # The step function of the root component was replaced.
            self._observed_step = self._observer.bind(root, root._find_step())
        else:
            self._observer.detach_all(root)
            # The next viewer must not take it for the present.
            self.newest = (0, {})
            self._plain_step = root._find_step()

    def _publish(self, record: IterationRecord) -> None:
        root = self.root
        for step in record["tree"]:
            source = step["changed_from"]
            if source is not None:
                self._change_count += 1
                self.changes.append(
                    {
                        "number": self._change_count,
                        "iteration": record["iteration"],
                        "time_ns": record["time_ns"],
                        "component": step["component"],
                        "source": source,
                        "target": step["state"],
                        "transition": step["transition"],
                    }
                )
        if reached := self._controller.check_breakpoints(record):
            print_error(f"{self.name}: paused at the breakpoint {reached}", kind="control")
        message = {
            **record,
            "robot": self.name,
            "paused": False,
            "errors_total": root.errors.total(),
        }
        self.newest = (self.newest[0] + 1, message)
        self._notify()

    def _handle_requests(self, last_iteration: int) -> None:
        self._has_requests.clear()
        self._controller.last_iteration = last_iteration
        # The others wait for the next iteration, which must not be delayed.
        for _ in range(min(len(self._requests), _MAX_HANDLED)):
            viewer, request = self._requests.popleft()
            answer: dict[str, Any] = {"answer": request.get("id"), "robot": self.name}
            try:
                words = self._controller.apply(viewer, request)
            except ControlError as error:
                answer["error"] = str(error)
            except USER_ERRORS as error:
                # Code of a state that was entered by request.
                answer["error"] = f"{type(error).__name__}: {error}"
            else:
                if words:
                    answer["done"] = words
                    print_error(f"{self.name}: {words}", kind="control")
            if "id" in request:
                self.answers.append((viewer, answer))
                self._notify()
        if self._requests:
            self._has_requests.set()

    def _wait_while_paused(self) -> None:
        """Handle requests until one of them continues; the time of the components stands still."""
        with self.root._stopped_time():
            # Only now: who reads that the robot is paused may rely on it.
            number, message = self.newest
            self.newest = (number + 1, {**message, "paused": True})
            self._notify()
            while self._controller.is_paused and self.is_watched and not self.root._is_stopping():
                self._has_requests.wait(_PAUSED_POLL_S)
                self._handle_requests(self.root.iteration)


class _LiveObserver(Observer):
    """Records the steps with their durations; can be attached and detached between iterations."""

    def __init__(self, sink: Callable[[IterationRecord], None], controller: Controller) -> None:
        super().__init__(sink, values=True)
        self._records_calls = False
        self._controller = controller
        self._replaced: list[tuple[Component, dict[str, Any]]] = []

    def attach_all(self, root: BaseRoot) -> None:
        for component in root.components:
            names = ("step", "modulate")
            self._replaced.append((component, {name: component.__dict__.get(name) for name in names}))
            self.attach(component)
        root._error_listeners.append(self.add_error)

    def detach_all(self, root: BaseRoot) -> None:
        for component, functions in self._replaced:
            for name, function in functions.items():
                if function is None:
                    component.__dict__.pop(name, None)
                else:
                    component.__dict__[name] = function
        self._replaced.clear()
        root._error_listeners.remove(self.add_error)

    def bind(self, root: BaseRoot, step: Callable[[], None]) -> Callable[[], None]:
        return lambda: self.observe_iteration(root, step)

    def _observe_step(self, component: Component, plain_step: Callable[[], None]) -> None:
        controller = self._controller
        if controller.has_effects:
            plain_step = controller.prepare_step(component, plain_step)
        begin_ns = time.perf_counter_ns()
        position = len(self._tree)
        try:
            super()._observe_step(component, plain_step)
        finally:
            step: Any = self._tree[position]
            step["step_ns"] = time.perf_counter_ns() - begin_ns


def _describe_component(component: Component) -> dict[str, Any]:
    return {
        "design": component.design_file,
        "code": hash_source(type(component)),
        "states": list(component._states),
        "frequency_hz": component.frequency_hz,
    }


def _hash_shared_modules(components: Iterable[Component]) -> dict[str, str]:
    """The hashes of the generated modules that the designs share."""
    files = {_find_source(type(each)) for each in components if each._states}
    paths = (Path(file).with_name(name) for file in files if file for name in _SHARED_MODULES)
    return {path.name: _hash_file(str(path)) for path in paths if path.is_file()}


def hash_source(component_class: type[Component]) -> str:
    """SHA-256 of the file that defines a component, by which a viewer finds its design; "" if there is no file."""
    file = _find_source(component_class)
    return _hash_file(file) if file else ""


def _find_source(component_class: type[Component]) -> str:
    try:
        return inspect.getfile(component_class)
    except (TypeError, OSError):
        return ""


@lru_cache(maxsize=1024)
def _hash_file(path: str) -> str:
    try:
        return hashlib.sha256(Path(path).read_bytes()).hexdigest()
    except OSError:
        return ""
