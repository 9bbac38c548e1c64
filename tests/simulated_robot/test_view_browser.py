"""The view of a simulated world in a browser: it follows the situations, and says when they end."""

from playwright.sync_api import Page, expect

from vicode.simulated_robot.arena import Arena
from vicode.simulated_robot.map_file import load_world_map
from vicode.simulated_robot.session import RobotTrack
from vicode.simulated_robot.view_server import ViewServer


def test_the_view_follows_the_robots(page: Page, console_errors: list[str]) -> None:
    arena = Arena(load_world_map("room"), robots=2)
    tracks = [RobotTrack(robot) for robot in arena.robots]
    server = ViewServer(arena.map)
    page.goto(server.url)
    expect(page.locator("#time")).to_have_text("Waiting for the first message.")
    expect(page.locator("polyline.wall")).to_have_count(5)
    for state in ("left", "right"):
        arena.advance(0.5)
        for track in tracks:
            track.robot.drive(0.4, 0)
            track.active, track.ranges = (("walk", state),), arena.scan(track.robot)
        tracks[1].robot.contacts = 3
        server.publish(arena.now_s, tracks)
        expect(page.locator("aside section")).to_have_count(2)
        expect(page.locator("aside section").nth(1).locator("li")).to_have_text(f"walk: {state}")
    expect(page.locator("#time")).to_have_text("1.0 s")
    expect(page.locator("dd.bad")).to_have_text("3")
    points = page.locator("polygon.rays").first.get_attribute("points")
    assert points is not None
    assert len(points.split()) == 182
    path = page.locator("polyline.path").first.get_attribute("points")
    assert path is not None
    assert len(path.split()) == 2
    server.close()
    expect(page.locator("#time")).to_have_text("1.0 s: the simulation has ended")
    # The browser reports that it tried to connect again.
    console_errors.clear()
