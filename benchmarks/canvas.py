"""How fast the canvas opens, and how many frames it keeps while a hand drags, pans and zooms.

Run `python -m benchmarks.canvas [SIZE …]`. Every figure is the median of the runs; frames are given as a share of
what the same browser reaches on the same page at rest, since a bare figure says more about the machine.
"""

import json
import os
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from urllib.request import urlopen

from playwright.sync_api import Browser, Page, sync_playwright

from tests.editor.canvas.player_scene import machine

ROOT = Path(__file__).parents[1]
SERVER = ROOT / "tests/editor/canvas/canvas_page.py"
SIZES = (20, 300, 1000, 3000)
RUNS = 5
GESTURE_S = 0.7
DISTANCES = ("fit", "half", "near")
ARGUMENTS = ("--no-sandbox", "--disable-dev-shm-usage")

COUNT_FRAMES = """seconds => new Promise(done => {
    const begin = performance.now();
    let frames = 0;
    const tick = now => {
        if (now - begin >= seconds * 1000) done(frames * 1000 / (now - begin));
        else { frames += 1; requestAnimationFrame(tick); }
    };
    requestAnimationFrame(tick);
})"""
START_COUNTING = f"seconds => {{ window.counted = ({COUNT_FRAMES})(seconds); }}"

FIND_MIDDLE = """most => {
    const {vicode} = document.querySelector('.vicode-canvas');
    const {x, y, k} = vicode.view();
    const spots = Object.values(vicode.positions()).map(place => [place.x * k + x, place.y * k + y]);
    const far = ([x, y]) => Math.hypot(x - 683, y - 384);
    return spots.sort((one, other) => far(one) - far(other)).slice(0, most);
}"""

Point = Sequence[float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """The medians for one scene, seen from one distance."""

    states: int
    distance: str
    open_s: float
    rest_fps: float
    drag: float
    drag_12: float
    drag_100: float
    pan: float
    zoom: float


def main(sizes: Sequence[int] = SIZES) -> None:
    """Measure every size and print a table."""
    print("states  view   open s   rest fps   drag   of 12  of 100    pan    zoom   (share of the frames at rest)")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium", args=list(ARGUMENTS))
        for size in sizes:
            for row in measure(browser, size):
                print(
                    f"{row.states:6}  {row.distance:4} {row.open_s:8.2f} {row.rest_fps:10.1f}"
                    f"{row.drag:7.0%}{row.drag_12:8.0%}{row.drag_100:8.0%}{row.pan:7.0%}{row.zoom:8.0%}",
                    flush=True,
                )
        browser.close()


def measure(browser: Browser, size: int) -> Iterator[Row]:
    """Open a made-up machine several times, then work on it from far and from near."""
    with serving(machine(size)) as address:
        opened = [open_page(browser, address) for _ in range(RUNS)]
        page = opened[-1][0]
        for other, _ in opened[:-1]:
            other.close()
        for distance in DISTANCES:
            yield measure_gestures(page, size, distance, median(seconds for _, seconds in opened))
        page.close()


def measure_gestures(page: Page, size: int, distance: str, open_s: float) -> Row:
    """Measure rest, drag, pan and zoom in turn, several times over."""
    strokes = {"drag": (drag, 0), "drag_12": (drag, 12), "drag_100": (drag, 100), "pan": (pan, 0), "zoom": (zoom, 0)}
    counts: dict[str, list[float]] = {name: [] for name in ("rest", *strokes)}
    for _ in range(RUNS):
        set_view(page, distance)
        rest = page.evaluate(COUNT_FRAMES, GESTURE_S)
        counts["rest"].append(rest)
        for name, (stroke, selected) in strokes.items():
            set_view(page, distance, selected)
            counts[name].append(count_during(page, stroke) / rest)
    middle = {name: median(values) for name, values in counts.items()}
    return Row(
        states=size,
        distance=distance,
        open_s=open_s,
        rest_fps=middle["rest"],
        drag=middle["drag"],
        drag_12=middle["drag_12"],
        drag_100=middle["drag_100"],
        pan=middle["pan"],
        zoom=middle["zoom"],
    )


def count_during(page: Page, stroke: Callable[[Page, Point, float], None]) -> float:
    """The frames per second while a stroke of the hand is made."""
    [spot] = page.evaluate(FIND_MIDDLE, 1)
    page.mouse.move(*spot)
    page.evaluate(START_COUNTING, GESTURE_S)
    stroke(page, spot, time.monotonic() + GESTURE_S)
    return float(page.evaluate("window.counted"))


def drag(page: Page, spot: Point, until: float) -> None:
    """Drag the state in the middle to and fro."""
    page.mouse.down()
    move_back_and_forth(page, spot, until)
    page.mouse.up()


def pan(page: Page, spot: Point, until: float) -> None:
    """Pan with the middle button."""
    page.mouse.down(button="middle")
    move_back_and_forth(page, spot, until)
    page.mouse.up(button="middle")


def zoom(page: Page, spot: Point, until: float) -> None:
    """Turn the wheel, out and in again."""
    page.mouse.move(*spot)
    turn = 0
    while time.monotonic() < until:
        page.mouse.wheel(0, 100 if (turn // 8) % 2 == 0 else -100)
        time.sleep(0.02)
        turn += 1


def move_back_and_forth(page: Page, spot: Point, until: float) -> None:
    """Move the mouse to and fro, about once a frame."""
    step = 0
    while time.monotonic() < until:
        step += 1
        page.mouse.move(spot[0] + 8 * (step % 40), spot[1] + 4 * (step % 30))
        time.sleep(0.008)


def set_view(page: Page, distance: str, selected: int = 0) -> None:
    """Select states in the middle; show everything, or the middle of the scene at half or at life size."""
    page.keyboard.press("Escape")
    page.locator(".stage").press("1")
    wait_until_idle(page)
    for spot in page.evaluate(FIND_MIDDLE, selected) if selected else ():
        page.keyboard.down("Shift")
        page.mouse.click(*spot)
        page.keyboard.up("Shift")
    if distance != "fit":
        page.locator(".stage").press("0")
    if distance == "half":
        page.mouse.move(683, 384)
        while page.evaluate("document.querySelector('.vicode-canvas').vicode.view().k") > 0.5:
            page.mouse.wheel(0, 100)
            time.sleep(0.03)
    wait_until_idle(page)


def wait_until_idle(page: Page) -> None:
    """Wait until the view does not move any more."""
    page.wait_for_function("document.querySelector('.vicode-canvas').vicode.view().resting")
    time.sleep(0.3)


def open_page(browser: Browser, address: str) -> tuple[Page, float]:
    """Open the page; the seconds are from the request to the painted scene."""
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    begin = time.monotonic()
    page.goto(address, wait_until="commit")
    page.wait_for_selector(".vicode-canvas[data-ready]")
    page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    seconds = time.monotonic() - begin
    time.sleep(0.5)
    return page, seconds


@contextmanager
def serving(scene: dict[str, object]) -> Iterator[str]:
    """Serve a scene in a separate process."""
    with tempfile.TemporaryDirectory() as folder, socket.socket() as free:
        scene_file = Path(folder, "scene.json")
        scene_file.write_text(json.dumps(scene), encoding="utf-8")
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
        free.close()
        kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTEST_", "NICEGUI_"))}
        environment = {**kept, "NICEGUI_STORAGE_PATH": folder, "PYTHONPATH": str(ROOT)}
        command = [sys.executable, str(SERVER), str(port), str(scene_file), "light"]
        process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            wait_until_served(f"http://127.0.0.1:{port}/gestures", process)
            yield f"http://127.0.0.1:{port}/"
        finally:
            process.kill()
            process.wait()


def wait_until_served(address: str, process: subprocess.Popen[bytes]) -> None:
    """Wait for the first answer, or fail when the server died."""
    while process.poll() is None:
        try:
            urlopen(address).close()
        except OSError:
            time.sleep(0.05)
        else:
            return
    raise RuntimeError("the server for the benchmark ended by itself")


if __name__ == "__main__":
    main([int(argument) for argument in sys.argv[1:]] or SIZES)
