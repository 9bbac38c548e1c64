"""Fixtures for the canvas in a real browser: a server with a page that contains only the canvas, and a driver."""

import json
import os
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any
from urllib.request import Request, urlopen

import pytest
from playwright.sync_api import Browser, ConsoleMessage, Error, Locator, Page

from tests.editor.canvas.player_scene import player

ROOT = Path(__file__).parents[3]
SERVER = Path(__file__).parent / "canvas_page.py"
Point = tuple[float, float]


class CanvasDriver:
    """Simulates a user of the canvas, and reads the gestures that Python received."""

    def __init__(self, page: Page, address: str) -> None:
        self.page = page
        self.address = address

    def show(self, scene: Mapping[str, Any]) -> None:
        """Load a scene, fit it into the view and reset selection, mouse and gestures."""
        self.page.mouse.move(1, 1)
        self.press("Escape")
        self.call("show_links", True)
        self.call("select", [])
        self.page.evaluate("document.querySelector('.vicode-canvas').removeAttribute('data-ready')")
        self.call("load", scene)
        self.page.wait_for_selector(".vicode-canvas[data-ready]")
        self.call("fit")
        self.page.wait_for_timeout(30)
        self.wait_until_idle()
        self.clear_gestures()

    def clear_gestures(self) -> None:
        """Delete the received gestures; a marker, which the canvas refuses, makes sure that none is on its way."""
        canvas = "getElement(document.querySelector('.vicode-canvas').id.slice(1))"
        self._request("/clear", b"")
        self.page.evaluate(f"{canvas}.$emit('gesture', {{kind: 'marker', rev: 0}})")
        self.wait_for_gesture("marker")
        self._request("/clear", b"")

    def at(self, of: str, identity: str, right: float = 0, down: float = 0) -> Point:
        """Screen position of the center of an element, plus an offset."""
        position = self.evaluate(f"screen({json.dumps(of)}, {json.dumps(identity)})")
        return position["x"] + right, position["y"] + down

    def drag(self, start: Point, end: Point, button: Any = "left") -> None:
        self.page.mouse.move(*start)
        self.page.mouse.down(button=button)
        self.page.mouse.move((start[0] + end[0]) / 2, (start[1] + end[1]) / 2, steps=3)
        self.page.mouse.move(*end, steps=3)
        self.page.mouse.up(button=button)

    def drag_handle(self, of: str, identity: str, end: Point) -> None:
        """Hover a node and drag the handle at its lower side."""
        self.page.mouse.move(*self.at(of, identity))
        handle = self.page.locator("circle.handle-hit[data-handle]").nth(2)
        handle.wait_for()
        box = handle.bounding_box()
        assert box is not None
        self.drag((box["x"] + box["width"] / 2, box["y"] + box["height"] / 2), end)

    def click(self, position: Point, *, double: bool = False) -> None:
        self.page.mouse.click(*position, click_count=2 if double else 1)

    def press(self, *keys: str) -> None:
        for key in keys:
            self.page.keyboard.press(key)

    def wait_for_gesture(self, kind: str, **fields: Any) -> dict[str, Any]:
        """Wait until the newest gesture of a kind has these fields; return it without its kind and numbers."""
        end = time.monotonic() + 10
        while time.monotonic() < end:
            if found := self.gestures(kind):
                newest = {name: value for name, value in found[-1].items() if name not in {"kind", "rev", "seq"}}
                if newest.items() >= fields.items():
                    return newest
            time.sleep(0.02)
        raise AssertionError(f"no gesture {kind!r} with {fields} was received, only {self.gestures()}")

    def gestures(self, kind: str = "") -> list[dict[str, Any]]:
        gestures: list[dict[str, Any]] = json.loads(self._request("/gestures"))
        return [gesture for gesture in gestures if gesture["kind"] == kind or not kind]

    def call(self, method: str, *arguments: object) -> None:
        """Call a method of the Python element."""
        self._request(f"/call/{method}", json.dumps(arguments).encode())

    def evaluate(self, call: str) -> Any:
        return self.page.evaluate(f"document.querySelector('.vicode-canvas').vicode.{call}")

    def position(self, name: str) -> Point:
        """Position of a node in the scene: `position("states/FollowBall")`."""
        node = self.evaluate("positions()")[name]
        return node["x"], node["y"]

    def selection(self) -> set[str]:
        return {f"{item['of']}/{item['id']}" for item in self.evaluate("selection()")}

    def group(self, kind: str, identity: str) -> Locator:
        return self.page.locator(f'g.item:not(.chip)[data-kind="{kind}"][data-id={json.dumps(identity)}]')

    def wait_until_idle(self) -> None:
        self.page.wait_for_function("document.querySelector('.vicode-canvas').vicode.view().resting")

    def wait_for(self, condition: str) -> None:
        """Wait for a JavaScript condition on `vicode`, the test interface of the canvas."""
        self.page.wait_for_function(
            f"() => {{ const {{vicode}} = document.querySelector('.vicode-canvas'); return {condition}; }}"
        )

    def _request(self, path: str, body: bytes | None = None) -> str:
        request = Request(self.address + path, data=body, headers={"Content-Type": "application/json"})
        with urlopen(request, timeout=60) as answer:
            return str(answer.read().decode())


@pytest.fixture(scope="session")
def canvas_address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """A server for all modules; each test sends its scene."""
    folder = tmp_path_factory.mktemp("canvas")
    scene_file = folder / "scene.json"
    scene_file.write_text(json.dumps(player()), encoding="utf-8")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    # NiceGUI changes its behavior if these variables are set.
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTEST_", "NICEGUI_"))}
    environment = {**kept, "NICEGUI_STORAGE_PATH": str(folder), "PYTHONPATH": str(ROOT)}
    command = [sys.executable, str(SERVER), str(port), str(scene_file), "light"]
    with (folder / "log").open("wb") as log:
        process = subprocess.Popen(command, env=environment, stdout=log, stderr=log)
    try:
        _wait_until_served(f"http://127.0.0.1:{port}", process, folder / "log")
        yield f"http://127.0.0.1:{port}"
    finally:
        process.kill()
        process.wait()


@pytest.fixture(scope="session")
def canvas_page(chromium: Browser, canvas_address: str) -> Page:
    """One page for all tests: opening one for each test would take most of the time."""
    page = chromium.new_page(viewport={"width": 1366, "height": 768})
    page.goto(canvas_address)
    page.wait_for_selector(".vicode-canvas[data-ready]")
    return page


@pytest.fixture
def show(canvas_page: Page, canvas_address: str) -> Iterator[Callable[[Mapping[str, Any]], CanvasDriver]]:
    """Returns a function that loads a scene; errors in the console fail the test."""
    errors: list[str] = []

    def on_console(message: ConsoleMessage) -> None:
        if message.type == "error":
            errors.append(message.text)

    def on_page_error(error: Error) -> None:
        errors.append(str(error))

    def show_scene(scene: Mapping[str, Any]) -> CanvasDriver:
        driver = CanvasDriver(canvas_page, canvas_address)
        driver.show(scene)
        return driver

    canvas_page.on("console", on_console)
    canvas_page.on("pageerror", on_page_error)
    yield show_scene
    canvas_page.remove_listener("console", on_console)
    canvas_page.remove_listener("pageerror", on_page_error)
    assert not errors, "the browser reported errors:\n" + "\n".join(errors)


@pytest.fixture
def canvas(show: Callable[[Mapping[str, Any]], CanvasDriver]) -> CanvasDriver:
    """The canvas with the player's scene."""
    return show(player())


def _wait_until_served(address: str, process: subprocess.Popen[bytes], log: Path) -> None:
    end = time.monotonic() + 60
    while time.monotonic() < end and process.poll() is None:
        try:
            urlopen(f"{address}/gestures", timeout=60).close()
        except OSError:
            time.sleep(0.05)
        else:
            return
    pytest.fail(f"the canvas server did not start:\n{log.read_text(errors='replace')}")
