"""Shows a simulated world in the browser while it runs: a page, the map, and an event stream."""

import json
import threading
from collections.abc import Iterable, Iterator
from typing import Any

from vicode.local_server import NOT_FOUND, HttpAnswer, LocalServer
from vicode.simulated_robot.arena import RADIUS_M
from vicode.simulated_robot.session import RobotTrack
from vicode.simulated_robot.world_map import WorldMap
from vicode.templating import read_asset

_PING_S = 10.0
_PERIOD_S = 0.05
_PAGE = "simulated_robot/view.html"


class ViewServer:
    """Serves the view on this machine, in background threads; slow browsers skip situations. Call `close` when done."""

    def __init__(self, world_map: WorldMap, port: int = 0) -> None:
        """Listen on a port; by default, on a free one.

        Raises:
            OSError: The port is taken.
        """
        self._map = json.dumps(_describe_map(world_map))
        self._situation = ""
        self._number = 0
        self._is_closed = False
        self._changed = threading.Condition()
        self._server = LocalServer(self._answer, port)
        self.url = self._server.url

    def publish(self, time_s: float, tracks: Iterable[RobotTrack]) -> None:
        """Show a situation."""
        situation = json.dumps({"time": round(time_s, 2), "robots": [_describe_robot(track) for track in tracks]})
        with self._changed:
            self._situation = situation
            self._number += 1
            self._changed.notify_all()

    def close(self) -> None:
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()
        self._server.close()

    def _answer(self, request: str) -> HttpAnswer | Iterator[str]:
        """The page, the map or the event stream."""
        if request == "/":
            return HttpAnswer(content=read_asset(_PAGE).encode(), kind="text/html; charset=utf-8")
        if request == "/map":
            return HttpAnswer(content=self._map.encode(), kind="application/json; charset=utf-8")
        return self._follow() if request == "/events" else NOT_FOUND

    def _follow(self) -> Iterator[str]:
        """The situations from now on, or the same one after a timeout; ends after `close`."""
        number = 0
        while (news := self._wait(number)) is not None:
            number, situation = news
            yield situation
            with self._changed:
                # One picture of the browser.
                self._changed.wait_for(lambda: self._is_closed, timeout=_PERIOD_S)

    def _wait(self, number: int) -> tuple[int, str] | None:
        """Wait for a newer situation, up to a timeout; None after `close`."""
        with self._changed:
            self._changed.wait_for(lambda: self._is_closed or self._number != number, timeout=_PING_S)
            return None if self._is_closed else (self._number, self._situation)


def _describe_map(world_map: WorldMap) -> dict[str, Any]:
    return {
        "name": world_map.name,
        "doc": world_map.doc,
        "walls": world_map.lines(),
        "goals": [[*goal.at, goal.radius] for goal in world_map.goals],
        "bounds": world_map.bounds(),
        "radius": RADIUS_M,
    }


def _describe_robot(track: RobotTrack) -> dict[str, Any]:
    robot = track.robot
    return {
        "number": robot.number,
        "at": [round(value, 3) for value in robot.at],
        "yaw": round(robot.yaw, 1),
        "ranges": [round(value, 2) for value in track.ranges],
        "active": track.active,
        "speed": round(robot.speed, 2),
        "turning": round(robot.turning_speed, 1),
        "contacts": robot.contacts,
        "age": track.age_ms,
    }
