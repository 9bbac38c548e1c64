"""Touch gestures: tap, drag, long press and pinch; touch targets are large enough."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, CDPSession, Page, expect

from tests.editor.gestures.conftest import WAIT_MS, EditorDriver, Point, box_of, middle

# Visible controls that are less than 40 pixels high or wide, with their sizes.
SMALL_TARGETS = """() => {
  const controls = "button, a[href], [role=button]:not(g), [role=tab], input, textarea, .q-field__control";
  const besides = ".q-field__control > *, .visually-hidden, .skip-link";
  const canvas = document.querySelector(".vicode-canvas").shadowRoot;
  return [...document.querySelectorAll(controls), ...canvas.querySelectorAll(controls)]
    .filter(each => each.checkVisibility({visibilityProperty: true}) && !each.closest(besides))
    .map(each => ({ each, box: each.getBoundingClientRect() }))
    .filter(({ box }) => box.width && (box.width < 39.5 || box.height < 39.5))
    .map(({ each, box }) => `${each.className} ${each.ariaLabel ?? each.textContent}: ${box.width} x ${box.height}`);
}"""


class TouchInput:
    """Sends touch events."""

    def __init__(self, page: Page) -> None:
        self.session: CDPSession = page.context.new_cdp_session(page)

    def send(self, kind: str, *points: Point) -> None:
        fingers = [{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(points)]
        self.session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})

    def drag(self, start: Point, end: Point) -> None:
        self.send("touchStart", start)
        for step in (0.3, 0.7, 1):
            self.send("touchMove", (start[0] + (end[0] - start[0]) * step, start[1] + (end[1] - start[1]) * step))
        self.send("touchEnd")

    def tap(self, spot: Point) -> None:
        self.send("touchStart", spot)
        self.send("touchEnd")


@pytest.fixture(scope="module")
def first_page(chromium: Browser, first_page: Page) -> Iterator[Page]:
    """A touch screen of the user of the other modules, as only the same user can undo edits of a failed test."""
    user = first_page.context.storage_state()
    context = chromium.new_context(storage_state=user, viewport={"width": 1180, "height": 820}, has_touch=True)
    context.set_default_timeout(WAIT_MS)
    yield context.new_page()
    context.close()


@pytest.fixture
def fingers(sketch: EditorDriver) -> TouchInput:
    return TouchInput(sketch.page)


def test_one_finger_selects_and_drags_and_pans(sketch: EditorDriver, fingers: TouchInput) -> None:
    fingers.tap(sketch.state("Go"))
    sketch.expect_selection("states/Go")
    x, y = sketch.state("Go")
    fingers.drag((x, y), (x + 60, y + 50))
    sketch.wait_for("vicode.positions()['states/Go'].x > 470")
    sketch.expect_undone()
    before = sketch.state("Stop")
    spot = sketch.empty()
    fingers.drag(spot, (spot[0] + 40, spot[1] - 30))
    sketch.wait_for(f"Math.abs(vicode.screen('states', 'Stop').x - {before[0] + 40}) < 12")
    expect(sketch.page.get_by_text("Saved", exact=True)).to_be_visible()


def test_a_long_press_opens_the_menu(sketch: EditorDriver, fingers: TouchInput) -> None:
    fingers.send("touchStart", sketch.state("Rest"))
    expect(sketch.menu()).to_be_visible()
    fingers.send("touchEnd")
    expect(sketch.menu()).to_be_visible()
    sketch.expect_selection("states/Rest")
    entry = sketch.menu().get_by_role("menuitem", name="Duplicate")
    box = entry.bounding_box()
    assert box is not None
    assert box["height"] >= 40
    fingers.tap(middle(entry))
    sketch.expect_selection("states/Rest2")
    sketch.expect_undone()


@pytest.mark.parametrize("size", [(820, 1180), (844, 390)], ids=["portrait", "landscape"])
def test_lifting_the_finger_chooses_nothing_in_the_menu(
    sketch: EditorDriver, fingers: TouchInput, size: tuple[int, int]
) -> None:
    resize(sketch, *size)
    box = box_of(sketch.page.locator(".vicode-canvas"))
    center, bottom, right = box["x"] + box["width"] / 2, box["y"] + box["height"] - 12, box["x"] + box["width"] - 90
    for spot in ((center, bottom), (right, box["y"] + box["height"] / 2), (right, bottom), sketch.state("Stop")):
        fingers.send("touchStart", spot)
        expect(sketch.menu()).to_be_visible()
        fingers.send("touchEnd")
        fingers.tap((box["x"] + 30, box["y"] + 70))
        expect(sketch.menu()).to_be_hidden()
    expect(sketch.page.locator("input.rename")).to_be_hidden()
    expect(sketch.page.get_by_text("Saved", exact=True)).to_be_visible()
    resize(sketch, 1180, 820)


def resize(sketch: EditorDriver, width: int, height: int) -> None:
    """Resize the window, and fit the diagram."""
    sketch.page.set_viewport_size({"width": width, "height": height})
    sketch.page.wait_for_function(f"innerWidth === {width}")
    sketch.page.wait_for_timeout(100)
    sketch.press("Escape", "1")
    sketch.view()


def test_two_fingers_zoom_and_a_finger_drags_a_transition_from_a_state(
    sketch: EditorDriver, fingers: TouchInput
) -> None:
    before = sketch.view()["k"]
    fingers.send("touchStart", (500, 600), (600, 600))
    fingers.send("touchMove", (520, 600), (580, 600))
    fingers.send("touchMove", (525, 600), (575, 600))
    fingers.send("touchEnd")
    sketch.wait_for(f"vicode.view().k < {before} * 0.7")
    sketch.press("1")
    sketch.wait_for(f"vicode.view().k === {before}")
    fingers.tap(sketch.state("Rest"))
    sketch.expect_selection("states/Rest")
    disc = sketch.page.locator('circle.handle-hit[data-handle="s:Rest"]').nth(1)
    box = box_of(disc)
    assert min(box["width"], box["height"]) >= 40 * min(1, before)
    fingers.drag(middle(disc), sketch.state("Stop"))
    sketch.guard_with()
    expect(sketch.transition("Rest/0")).to_have_count(1)
    sketch.expect_undone()


def test_several_elements_are_selected_by_touch(sketch: EditorDriver, fingers: TouchInput) -> None:
    fingers.tap(sketch.state("Go"))
    several = sketch.page.get_by_role("button", name="Select several")
    several.click()
    expect(several).to_have_attribute("aria-pressed", "true")
    fingers.tap(sketch.state("Stop"))
    sketch.expect_selection("states/Go", "states/Stop")
    fingers.tap(sketch.state("Go"))
    sketch.expect_selection("states/Stop")
    fingers.drag(sketch.state("Rest", -70, 50), sketch.state("Rest", 70, -20))
    sketch.wait_for("vicode.selection().some(item => item.id === 'Rest')")
    several.click()
    expect(several).to_have_attribute("aria-pressed", "false")


def test_touch_targets_are_large(sketch: EditorDriver) -> None:
    sketch.select("Go")
    expect(sketch.page.get_by_label("State", exact=True)).to_have_value("Go")
    assert sketch.page.evaluate(SMALL_TARGETS) == []
