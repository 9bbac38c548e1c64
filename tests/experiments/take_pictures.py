"""Takes the pictures of docs/experiments.md and docs/sweeps.md: pages, and the view of a world; `make pictures`."""

import subprocess
import sys
import tempfile
from pathlib import Path

from playwright.sync_api import Browser, sync_playwright

from tests.conftest import CHROMIUM_ARGUMENTS, find_chromium
from tests.manual.pictures import FOLDER, take

ROOT = Path(__file__).parents[2]


def main() -> None:
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=find_chromium(playwright), args=CHROMIUM_ARGUMENTS)
        run("experiment", "meeting", "--out", folder, "--seeds", "4", "--no-real-time")
        page = browser.new_page(viewport={"width": 1160, "height": 1280})
        page.goto(Path(folder, "meeting.html").as_uri())
        take(page, FOLDER / "experiment.png")
        take_sweep(browser, folder)
        take_view(browser)
        browser.close()


def take_sweep(browser: Browser, folder: str) -> None:
    words = ("--set", "pan_threshold=15..55:5", "--seeds", "40", "--minimize", "world.first_goal_s", "--out", folder)
    run("sweep", "designs/forward/player.yaml", *words)
    page = browser.new_page(viewport={"width": 1120, "height": 720})
    page.goto(Path(folder, "sweep.html").as_uri())
    take(page, FOLDER / "sweep.png")


def take_view(browser: Browser) -> None:
    bridge = start("bridge", "designs/meeting", "--port", "0")
    assert bridge.stdout is not None
    port = bridge.stdout.readline().split(";")[0].rpartition(":")[2]
    robots = start("sim", "two_rooms", "--robots", "4", "--port", port, "--behavior", "robot", "--view")
    assert robots.stdout is not None
    try:
        page = browser.new_page(viewport={"width": 1160, "height": 640})
        page.goto(robots.stdout.readline().split()[-1])
        page.get_by_text("to_meeting").first.wait_for()
        take(page, FOLDER / "simulated-robot.png")
    finally:
        for process in (robots, bridge):
            process.terminate()
            process.wait()


def start(*arguments: str) -> "subprocess.Popen[str]":
    return subprocess.Popen([sys.executable, "-m", "vicode", *arguments], cwd=ROOT, stdout=subprocess.PIPE, text=True)


def run(*arguments: str) -> None:
    subprocess.run([sys.executable, "-m", "vicode", *arguments], cwd=ROOT, check=True)


if __name__ == "__main__":
    main()
