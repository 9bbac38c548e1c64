"""What a person does first on the page of the forward player: open it, find a state or a transition, select it."""

import time
from pathlib import Path

from playwright.sync_api import Locator, Page, expect

PLAYER = "design/forward/Player"
Point = tuple[float, float]

# A busy machine takes its time; what never comes still fails.
expect.set_options(timeout=20_000)


def open_player(page: Page, url: str) -> None:
    """Open the page and wait for its drawing, and until it can speak to the server.

    What is done before reaches the server in any order, within a few milliseconds; nobody's hands are that quick.
    """
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(url + PLAYER)
    expect(state(page, "LookForBall")).to_be_visible()
    page.wait_for_function("window.did_handshake")


def state(page: Page, name: str) -> Locator:
    """A state in the drawing."""
    return page.locator(f'g[data-kind="state"][data-id="{name}"]')


def component(page: Page, alias: str) -> Locator:
    """A used component in the drawing."""
    return page.locator(f'g[data-kind="component"][data-id="{alias}"]')


def label(page: Page, key: str) -> Locator:
    """The label of a transition in the drawing, where it has one."""
    return page.locator(f'g.chip[data-kind="transition"][data-id="{key}"]')


def select_state(page: Page, name: str) -> None:
    """Click a state; the inspector shows it."""
    state(page, name).click()
    expect(page.get_by_label("State", exact=True)).to_have_value(name)


def select_transition(page: Page, key: str) -> None:
    """Click the label of a transition; the inspector shows it."""
    label(page, key).click()
    expect(page.get_by_label("Inspector").get_by_text("Transition from")).to_be_visible()


def center_of(page: Page, name: str) -> Point:
    """The middle of a state's box on the screen."""
    shape = state(page, name).locator("rect.box")
    shape.wait_for()
    box = shape.bounding_box()
    if box is None:
        # It was drawn anew between the two questions.
        return center_of(page, name)
    return (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)


def empty_corner(page: Page) -> Point:
    """A point of the drawing where nothing is."""
    stage = page.locator("main.design-view").bounding_box()
    assert stage is not None
    return (stage["x"] + 30, stage["y"] + stage["height"] - 40)


def create_state(page: Page, name: str) -> None:
    """Double click on nothing, and type the name into the box that opens."""
    page.mouse.dblclick(*empty_corner(page))
    box = page.locator("input.rename")
    expect(box).to_be_focused()
    box.fill(name)
    box.press("Enter")


def save(page: Page, file: Path) -> str:
    """Save by the key; returns the text of the file.

    "Saved" may stand there from before, until an edit has arrived: the file is waited for.
    """
    before = file.stat().st_ino
    page.keyboard.press("Control+s")
    wait_for_another(page, file, before)
    expect(page.get_by_text("Saved", exact=True).first).to_be_visible()
    return file.read_text(encoding="utf-8")


def wait_for_another(page: Page, file: Path, before: int) -> None:
    """Wait until a file is another than the one that had a number before."""
    until_s = time.monotonic() + 20
    while file.stat().st_ino == before and time.monotonic() < until_s:
        page.wait_for_timeout(20)


def findings(page: Page) -> Locator:
    """The panel below the canvas."""
    return page.get_by_label("Findings", exact=True)
