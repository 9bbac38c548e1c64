"""The pictures of the documents: each is a page that is opened, brought to a state, and looked at."""

import io
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, expect

from tests.editor.conftest import started_editor
from tests.editor.player_page import open_player, select_state, state
from tests.manual.code_blocks import ROOT, code_blocks
from vicode.cli import main

FOLDER = ROOT / "docs/pictures"
MAX_BYTES = 150_000
SIZE = {"width": 1366, "height": 768}


def show_editor(page: Page, scratch: Path) -> Iterator[None]:
    """The forward player, with a state selected."""
    with started_editor(ROOT / "designs", scratch / "storage") as url:
        open_player(page, url)
        select_state(page, "WatchBall")
        expect(state(page, "LookForBall")).to_be_visible()
        expect(page.get_by_label("Findings", exact=True)).to_be_visible()
        page.mouse.move(0, 0)
        yield


def show_simulation(page: Page, scratch: Path) -> Iterator[None]:
    """The design of the tutorial in the simulation, before the robot has a world."""
    folder = write_tutorial(scratch / "corridor", is_complete=False)
    with started_editor(folder, scratch / "storage") as url:
        _open_patrol(page, url)
        page.get_by_role("tab", name="Simulate").click()
        page.keyboard.press("F10")
        active = page.locator("g.node.active")
        expect(active).to_have_attribute("data-id", "Drive")
        distance = page.get_by_role("spinbutton", name="Scanner distance, number")
        distance.fill("0.4")
        distance.press("Enter")
        expect(page.locator(".guard", has_text="→ Wait")).to_contain_text("true")
        page.get_by_role("button", name="Step (F10)").click()
        expect(active).to_have_attribute("data-id", "Wait")
        expect(page.locator(".guard", has_text="→ BackUp")).to_contain_text("false")
        page.mouse.move(0, 0)
        yield


def show_robot(page: Page, scratch: Path) -> Iterator[None]:
    """The design of the tutorial while it runs in real time; nobody leaves the hall, so that the run does not end."""
    folder = write_tutorial(scratch / "corridor")
    hall = folder / "hall.py"
    hall.write_text(hall.read_text(encoding="utf-8").replace("< 9 else", "< 1e9 else"), encoding="utf-8")
    address = f"unix:{scratch / 'robot.sock'}"
    run = [
        sys.executable,
        "-m",
        "vicode",
        "run",
        str(folder),
        "--real-time",
        "--watch",
        address,
        "--control",
        "--plain",
    ]
    with subprocess.Popen(run, cwd=ROOT, stdout=subprocess.PIPE, text=True) as robot:
        try:
            assert robot.stdout is not None
            assert "Patrol: Drive" in robot.stdout.readline()
            attaching = ("attach", address, str(folder))
            with started_editor(folder, scratch / "storage", (), command=attaching) as url:
                _open_patrol(page, url)
                expect(page.locator(".robot-card.is-followed")).to_contain_text("Patrol")
                expect(page.locator(".guard").first).to_contain_text("→")
                page.mouse.move(0, 0)
                # For three of every seven seconds.
                expect(page.locator("g.node.active")).to_have_attribute("data-id", "Wait")
                yield
        finally:
            robot.kill()


def show_site(page: Page, scratch: Path) -> Iterator[None]:
    """The page of the forward player on its documentation site."""
    assert main(["docs", str(ROOT / "designs/forward"), "--out", str(scratch / "site")]) == 0
    page.set_viewport_size({"width": 1160, "height": 900})
    page.goto((scratch / "site/component-Player.html").as_uri())
    expect(page.locator("h1")).to_have_text("Player")
    expect(page.locator(".diagram a.state", has_text="WatchBall").first).to_be_visible()
    yield


def _open_patrol(page: Page, url: str) -> None:
    page.set_viewport_size(SIZE)
    page.goto(url)
    page.get_by_role("link", name="Patrol", exact=True).first.click()
    expect(state(page, "Drive")).to_be_visible()
    page.wait_for_function("window.did_handshake")


PICTURES: dict[str, Callable[[Page, Path], Iterator[None]]] = {
    "editor.png": show_editor,
    "tutorial-editor.png": show_simulation,
    "live.png": show_robot,
    "site.png": show_site,
}


@contextmanager
def shown(name: str, page: Page, scratch: Path) -> Iterator[None]:
    """The page as the picture shows it."""
    yield from PICTURES[name](page, scratch)


def take(page: Page, file: Path) -> None:
    """Write what the page shows, in 256 colors, which halve the size."""
    picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    picture.quantize(256, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(file, optimize=True)


def write_tutorial(folder: Path, *, is_complete: bool = True) -> Path:
    """The files of the tutorial, with the world, or as they are before it."""
    folder.mkdir()
    for block in code_blocks(ROOT / "docs/tutorial.md", "yaml", "python"):
        if is_complete or not (folder / block.name).exists():
            (folder / block.name).write_text(block.text, encoding="utf-8")
    return folder
