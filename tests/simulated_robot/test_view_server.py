"""The browser view of a simulated world: the page, the map, and the newest situation."""

import http.client
import json
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from vicode.simulated_robot.arena import Arena
from vicode.simulated_robot.map_file import load_world_map
from vicode.simulated_robot.session import RobotTrack
from vicode.simulated_robot.view_server import ViewServer

ROOM = load_world_map("room")


@pytest.fixture
def server() -> Iterator[ViewServer]:
    server = ViewServer(ROOM)
    yield server
    server.close()


@contextmanager
def opened(server: ViewServer, path: str, host: str = "") -> Iterator[http.client.HTTPResponse]:
    connection = http.client.HTTPConnection(server.url.removeprefix("http://").rstrip("/"), timeout=20)
    try:
        connection.request("GET", path, headers={"Host": host} if host else {})
        with connection.getresponse() as response:
            yield response
    finally:
        connection.close()


def get(server: ViewServer, path: str, host: str = "") -> tuple[int, bytes]:
    with opened(server, path, host) as response:
        return response.status, response.read()


def test_the_page_and_the_map_are_served(server: ViewServer) -> None:
    assert b"<title>Simulated robot</title>" in get(server, "/")[1]
    served = json.loads(get(server, "/map")[1])
    assert served["name"] == "room"
    assert len(served["walls"]) == 5
    assert get(server, "/other")[0] == 404


def test_a_browser_gets_the_newest_situation(server: ViewServer) -> None:
    arena = Arena(ROOM, robots=2)
    tracks = [RobotTrack(robot) for robot in arena.robots]
    tracks[0].active = (("walk", "left"),)
    for _tick in range(3):
        arena.advance(0.05)
        server.publish(arena.now_s, tracks)
    with opened(server, "/events") as events:
        situation = json.loads(events.readline().removeprefix(b"data: "))
    assert situation["time"] == 0.15
    assert [robot["number"] for robot in situation["robots"]] == [1, 2]
    assert situation["robots"][0]["active"] == [["walk", "left"]]


def test_other_hosts_are_refused(server: ViewServer) -> None:
    assert get(server, "/map", host="attacker.example")[0] == 403
