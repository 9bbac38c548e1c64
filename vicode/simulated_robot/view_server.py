"""Shows a simulated world in the browser while it runs: a page, the map, and an event stream."""

import json
import threading
from collections.abc import Iterable
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from vicode.simulated_robot.arena import RADIUS_M
from vicode.simulated_robot.session import RobotTrack
from vicode.simulated_robot.world_map import WorldMap
from vicode.templating import read_asset

HOST = "127.0.0.1"
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
        self._server = _HttpServer((HOST, port), _RequestHandler)
        self._server.view = self
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)
        self._thread.start()

    @property
    def url(self) -> str:
        return f"http://{HOST}:{self._server.server_port}/"

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
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()

    def read_map(self) -> str:
        return self._map

    def wait(self, number: int) -> tuple[int, str] | None:
        """Wait for a newer situation, up to a timeout; None after `close`."""
        with self._changed:
            self._changed.wait_for(lambda: self._is_closed or self._number != number, timeout=_PING_S)
            return None if self._is_closed else (self._number, self._situation)

    def pause(self) -> None:
        """Wait for one picture of the browser."""
        with self._changed:
            self._changed.wait_for(lambda: self._is_closed, timeout=_PERIOD_S)


class _HttpServer(ThreadingHTTPServer):
    daemon_threads = True
    view: ViewServer


class _RequestHandler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server: _HttpServer

    def do_GET(self) -> None:
        """Send the page, the map or the event stream."""
        port = self.server.server_port
        if self.headers.get("Host") not in (f"{HOST}:{port}", f"localhost:{port}"):
            # A foreign page that resolves its own name to this machine (DNS rebinding) sends that name.
            self._send(HTTPStatus.FORBIDDEN, "This server answers to 127.0.0.1 and localhost alone.\n", "text/plain")
        elif self.path == "/":
            self._send(HTTPStatus.OK, read_asset(_PAGE), "text/html")
        elif self.path == "/map":
            self._send(HTTPStatus.OK, self.server.view.read_map(), "application/json")
        elif self.path == "/events":
            self._send_events()
        else:
            self._send(HTTPStatus.NOT_FOUND, "", "text/plain")

    def _send_events(self) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Cache-Control", "no-store")
        self.send_header("Connection", "close")
        self.end_headers()
        self.close_connection = True
        number = 0
        try:
            while (news := self.server.view.wait(number)) is not None:
                number, situation = news
                self.wfile.write(f"data: {situation}\n\n".encode() if situation else b": waiting\n\n")
                self.server.view.pause()
        except OSError:
            # The browser disconnected.
            return

    def _send(self, status: HTTPStatus, text: str, kind: str) -> None:
        content = text.encode()
        self.send_response(status)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        self.send_header("Content-Length", str(len(content)))
        self.send_header("Cache-Control", "no-store")
        self.send_header("X-Content-Type-Options", "nosniff")
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002 - as the library has it
        """Suppress the request log."""


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
