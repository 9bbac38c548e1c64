"""Fixtures for gestures on the real page of the editor, on a small design."""

import json
import shutil
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, FloatRect, Locator, Page, expect

from tests.editor.conftest import ROOT, started_editor

Point = tuple[float, float]
WAIT_MS = 30_000
DESIGN = """\
vicode: 1
component: Sketch
uses:
  walk: {component: Walk, at: [760, 320]}
initial: Start
states:
  Start:
    at: [120, 100]
    transitions:
      - {to: Go, when: state_time > 9}
      - {to: Stop, after: 3}
      - {to: Rest, when: state_time > 1}
  Go: {at: [440, 100]}
  Stop: {at: [440, 320]}
  Rest: {at: [120, 320]}
"""

# Accessible names and positions of all elements, including labels.
DRAWN = """() => {
  const canvas = document.querySelector('.vicode-canvas');
  const places = canvas.vicode.positions();
  const items = [...canvas.shadowRoot.querySelectorAll('g.item')];
  return JSON.stringify([
    Object.keys(places).sort().map(name => [name, places[name].x, places[name].y]),
    items.map(item => [item.dataset.key, item.getAttribute('aria-label'), item.dataset.at].join()).sort(),
  ]);
}"""

# Long enough for a busy machine.
expect.set_options(timeout=WAIT_MS)


class EditorDriver:
    """Simulates a user of the design page with mouse and keyboard."""

    def __init__(self, page: Page, address: str) -> None:
        self.page, self.address = page, address
        page.goto(f"{address}design/forward/Sketch")
        page.wait_for_selector(".vicode-canvas[data-ready]")
        self.undo_all()
        expect(page.get_by_text("Saved", exact=True)).to_be_visible()
        self.wait_for("vicode.view().resting && Object.keys(vicode.positions()).length === 5")
        # The findings panel is filled, so the size of the canvas is final.
        expect(page.get_by_text("4 warnings")).to_be_visible()
        self.start = page.evaluate(DRAWN)
        page.mouse.move(1000, 20)

    def at(self, of: str, identity: str, right: float = 0, down: float = 0) -> Point:
        """Screen position of the center of an element, plus an offset."""
        position = self.evaluate(f"screen({json.dumps(of)}, {json.dumps(identity)})")
        return position["x"] + right, position["y"] + down

    def state(self, name: str, right: float = 0, down: float = 0) -> Point:
        return self.at("states", name, right, down)

    def empty(self) -> Point:
        """Screen position of an empty point."""
        (x1, y), (x2, _y) = self.state("Rest"), self.state("Stop")
        return (x1 + x2) / 2, y + 20

    def click(self, spot: Point, *held: Any, right: bool = False, double: bool = False) -> None:
        for key in held:
            self.page.keyboard.down(key)
        self.page.mouse.click(*spot, button="right" if right else "left", click_count=2 if double else 1)
        for key in held:
            self.page.keyboard.up(key)

    def press_and_move(self, start: Point, *on: Point, button: Any = "left") -> None:
        """Press and move without releasing the button."""
        self.page.mouse.move(*start)
        self.page.mouse.down(button=button)
        for spot in on:
            self.page.mouse.move(*spot, steps=4)

    def drag(self, start: Point, *on: Point, button: Any = "left") -> None:
        self.press_and_move(start, *on, button=button)
        self.page.mouse.up(button=button)

    def handle(self, name: str, index: int) -> Point:
        """Screen position of a handle of a state: 0 is the top one, then clockwise."""
        self.page.mouse.move(*self.state(name))
        return middle(self.page.locator(f'circle.handle-hit[data-handle="s:{name}"]').nth(index))

    def press(self, *keys: str) -> None:
        for key in keys:
            self.page.keyboard.press(key)

    def select(self, *names: str) -> None:
        """Select states by clicks."""
        self.view()
        for index, name in enumerate(names):
            self.click(self.state(name), *(["Shift"] if index else []))
        self.expect_selection(*(f"states/{name}" for name in names))

    def expect_selection(self, *items: str) -> None:
        """Wait until exactly these elements are selected."""
        wanted = json.dumps(sorted(items), separators=(",", ":"))
        self.wait_for(f"JSON.stringify(vicode.selection().map(i => i.of + '/' + i.id).sort()) === {json.dumps(wanted)}")

    def selection(self) -> set[str]:
        return {f"{item['of']}/{item['id']}" for item in self.evaluate("selection()")}

    def position(self, name: str) -> Point:
        """Position of a node in the design: `position("states/Go")`."""
        node = self.evaluate("positions()")[name]
        return node["x"], node["y"]

    def expect_position(self, name: str, x: float, y: float) -> None:
        """Wait until a node has a position."""
        self.wait_for(f"vicode.positions()['{name}']?.x === {x} && vicode.positions()['{name}'].y === {y}")

    def view(self) -> dict[str, Any]:
        self.wait_for("vicode.view().resting")
        return dict(self.evaluate("view()"))

    def element(self, kind: str, identity: str) -> Locator:
        return self.page.locator(f'g.item:not(.chip)[data-kind="{kind}"][data-id={json.dumps(identity)}]')

    def transition(self, identity: str) -> Locator:
        return self.element("transition", identity)

    def expect_message(self, text: str) -> None:
        """Wait for a text on the page."""
        expect(self.page.get_by_text(text).first).to_be_visible()

    def menu(self) -> Locator:
        return self.page.get_by_role("menu", name="Menu")

    def choose(self, entry: str) -> None:
        self.menu().get_by_role("menuitem", name=entry).click()

    def rename_to(self, name: str) -> None:
        field = self.page.locator("input.rename")
        expect(field).to_be_focused()
        field.fill(name)
        field.press("Enter")
        expect(self.element("state", name)).to_be_visible()

    def guard_with(self, guard: str = "") -> None:
        """Type the guard of a new transition."""
        expect(self.page.locator("input.guard-field")).to_be_focused()
        self.page.keyboard.type(guard)
        self.press("Enter")

    def expect_undone(self, steps: int = 1) -> None:
        """Undo edits, and check that exactly this many steps restore the saved design."""
        expect(self.page.get_by_text("Unsaved changes")).to_be_visible()
        self.press("Escape", "Escape")
        for step in range(steps):
            self.press("Control+z")
            if step < steps - 1:
                expect(self.page.get_by_text("Unsaved changes")).to_be_visible()
        expect(self.page.get_by_text("Saved", exact=True)).to_be_visible()
        # The canvas may be updated later than the text.
        self.page.wait_for_function(f"start => ({DRAWN})() === start", arg=self.start, timeout=WAIT_MS)

    def undo_all(self) -> None:
        """Undo the edits of an earlier test that failed."""
        canvas = self.page.locator(".vicode-canvas")
        while self.page.locator(".saved").inner_text() != "Saved":
            rev = canvas.get_attribute("data-rev") or ""
            self.press("Control+z")
            expect(canvas).not_to_have_attribute("data-rev", rev)

    def evaluate(self, call: str) -> Any:
        return self.page.evaluate(f"document.querySelector('.vicode-canvas').vicode.{call}")

    def wait_for(self, condition: str) -> None:
        self.page.wait_for_function(
            f"() => {{ const {{vicode}} = document.querySelector('.vicode-canvas'); return {condition}; }}",
            timeout=WAIT_MS,
        )


def box_of(locator: Locator) -> FloatRect:
    """Bounding box of an element; repeats the request if it was redrawn between two requests."""
    locator.wait_for()
    return locator.bounding_box() or box_of(locator)


def middle(locator: Locator) -> Point:
    box = box_of(locator)
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


@pytest.fixture(scope="session")
def sketches(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """An editor with a small design and with empty ones."""
    folder = tmp_path_factory.mktemp("sketches")
    shutil.copytree(ROOT / "designs" / "forward", folder / "designs" / "forward")
    (folder / "designs" / "forward" / "blank.yaml").write_text("vicode: 1\ncomponent: Blank\n", encoding="utf-8")
    (folder / "designs" / "forward" / "empty.yaml").write_text("vicode: 1\ncomponent: Empty\n", encoding="utf-8")
    (folder / "designs" / "forward" / "sketch.yaml").write_text(DESIGN, encoding="utf-8")
    with started_editor(folder / "designs", folder / "storage") as url:
        yield url


@pytest.fixture(scope="session")
def first_page(chromium: Browser) -> Page:
    """A page with clipboard access, for all tests: opening one for each would take most of the time."""
    clipboard = ["clipboard-read", "clipboard-write"]
    context = chromium.new_context(viewport={"width": 1366, "height": 768}, permissions=clipboard)
    context.set_default_timeout(WAIT_MS)
    return context.new_page()


@pytest.fixture
def sketch(sketches: str, first_page: Page) -> Iterator[EditorDriver]:
    """The page of the design as it is on disk; errors in the console fail the test."""
    errors: list[str] = []

    def on_console(message: Any) -> None:
        if message.type == "error":
            errors.append(message.text)

    def on_error(error: Any) -> None:
        errors.append(str(error))

    first_page.on("console", on_console)
    first_page.on("pageerror", on_error)
    yield EditorDriver(first_page, sketches)
    first_page.remove_listener("console", on_console)
    first_page.remove_listener("pageerror", on_error)
    assert not errors, "the browser reported errors:\n" + "\n".join(errors)
