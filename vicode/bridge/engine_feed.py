"""What viewers see of an XABSL engine: active options and their states, in the messages of the live view."""

from collections import deque
from collections.abc import Callable, Mapping
from typing import Any

from vicode.bridge.behaviors import XabslBehavior

_NS_PER_MS = 1_000_000
_MAX_CHANGES = 256


class EngineFeed:
    """Publishes the newest cycle of an engine while someone watches.

    Args:
        behavior: The behavior; the feed is called after each of its steps.
        name: The name of the robot.
        notify: Called after each published cycle; must not block.
    """

    def __init__(self, behavior: XabslBehavior, name: str, notify: Callable[[], None]) -> None:
        self.root, self.name = behavior.engine, name
        self.newest: tuple[int, Mapping[str, Any]] = (0, {})
        self.changes: deque[Any] = deque(maxlen=_MAX_CHANGES)
        self.answers: deque[tuple[object, dict[str, Any]]] = deque()
        self.is_watched = self.is_focused = False
        self.version = 0
        self._notify = notify
        self._change_count = 0
        self._states: dict[str, str] = {}
        behavior.on_step = self._publish

    def describe(self) -> dict[str, Any]:
        """Describe the robot: all options, with their states; they have no code of a design."""
        options = self.root.program.options
        active = self.root.active_options
        return {
            "name": self.name,
            "root": active[0].name if active else "",
            "components": {
                each.name: {
                    "design": "",
                    "code": "",
                    "states": [state.name for state in each.states],
                    "frequency_hz": 0,
                }
                for each in options
            },
            "shared": {},
        }

    def request(self, viewer: object, request: dict[str, Any]) -> bool:
        """Refuse a request of a viewer."""
        if "id" in request:
            error = "XABSL agents of a bridge can be watched, not controlled"
            self.answers.append((viewer, {"answer": request["id"], "robot": self.name, "error": error}))
            self._notify()
        return True

    def forget(self, viewer: object) -> None:
        """Viewers hold nothing here."""

    def _publish(self, time_ns: int) -> None:
        if not self.is_watched:
            self._states.clear()
            return
        engine, before = self.root, self._states
        tree: list[dict[str, Any]] = []
        self._states = {}
        for view in engine.active_options:
            changed_from = before.get(view.name)
            self._states[view.name] = view.state
            left = changed_from if changed_from != view.state else None
            tree.append(self._describe_step(view, tree[-1]["component"] if tree else None, left))
            if left is not None:
                self._change_count += 1
                self.changes.append(
                    {
                        "number": self._change_count,
                        "iteration": engine.cycle,
                        "time_ns": time_ns,
                        "component": view.name,
                        "source": left,
                        "target": view.state,
                        "transition": None,
                    }
                )
        message = {"iteration": engine.cycle, "time_ns": time_ns, "tree": tree, "errors": [], "still_done": []}
        status = {"robot": self.name, "paused": False, "errors_total": 0}
        self.newest = (self.newest[0] + 1, {**message, **status})
        self._notify()

    def _describe_step(self, view: Any, by: str | None, changed_from: str | None) -> dict[str, Any]:
        return {
            "component": view.name,
            "by": by,
            "link": "root" if by is None else "modulates",
            "worked": True,
            "state": view.state,
            "state_time_ns": view.state_time * _NS_PER_MS,
            "changed_from": changed_from,
            "transition": None,
            "parameters": view.parameters,
            "done": False,
        }
