"""Creating a first design with four states, a timer and a component, by mouse and by keyboard."""

import re

from playwright.sync_api import Page, expect

from tests.editor.gestures.conftest import Point, middle


class FirstDesignDriver:
    """Simulates a user who starts with an empty design."""

    def __init__(self, page: Page, url: str) -> None:
        self.page = page
        page.goto(url)
        page.wait_for_selector(".vicode-canvas[data-ready]")
        expect(page.locator(".stage").last).to_be_focused()

    def at(self, of: str, identity: str, right: float = 0, down: float = 0) -> Point:
        spot = self.page.evaluate(
            "([of, id]) => document.querySelector('.vicode-canvas').vicode.screen(of, id)", [of, identity]
        )
        return spot["x"] + right, spot["y"] + down

    def type_name(self, name: str) -> None:
        expect(self.page.locator("input.rename")).to_be_focused()
        self.page.keyboard.type(name)
        self.page.keyboard.press("Enter")
        self.expect_selected(name)

    def type_guard(self, guard: str = "") -> None:
        expect(self.page.locator("input.guard-field")).to_be_focused()
        self.page.keyboard.type(guard)
        self.page.keyboard.press("Enter")

    def expect_selected(self, identity: str) -> None:
        self.page.wait_for_function(
            "id => document.querySelector('.vicode-canvas').vicode.selection()[0]?.id === id", arg=identity
        )

    def drag_from(self, name: str, side: int, end: Point) -> None:
        self.page.mouse.move(*self.at("states", name))
        start = middle(self.page.locator(f'circle.handle-hit[data-handle="s:{name}"]').nth(side))
        self.page.mouse.move(*start)
        self.page.mouse.down()
        self.page.mouse.move(*end, steps=6)
        self.page.mouse.up()

    def expect_complete(self) -> None:
        for key, description in (
            ("Idle/0", "from Idle to Search"),
            ("Search/0", "from Search to Found"),
            ("Found/0", "from Found to Rest"),
            ("Rest/0", "from Rest to Idle: 3 s"),
        ):
            transition = self.page.locator(f'g.item:not(.chip)[data-kind="transition"][data-id="{key}"]')
            expect(transition).to_have_attribute("aria-label", re.compile(description))
        expect(self.page.locator('g.item[data-kind="link"][data-id$="/Search/search_ball"]')).to_have_count(1)
        expect(self.page.get_by_label("Findings", exact=True).get_by_text("No problems found")).to_be_visible()


def test_by_mouse(sketches: str, first_page: Page) -> None:
    page = first_page
    user = FirstDesignDriver(page, f"{sketches}design/forward/Blank")
    page.mouse.dblclick(330, 250)
    user.type_name("Idle")
    user.drag_from("Idle", 1, user.at("states", "Idle", right=220))
    user.type_name("Search")
    user.type_guard()
    user.drag_from("Search", 2, user.at("states", "Search", down=180))
    user.type_name("Found")
    user.type_guard()
    user.drag_from("Found", 3, user.at("states", "Found", right=-220))
    user.type_name("Rest")
    user.type_guard()
    user.drag_from("Rest", 0, user.at("states", "Idle"))
    user.type_guard()
    user.expect_selected("Rest/0")
    page.get_by_label("After (seconds in this state)").click()
    page.keyboard.type("3")
    expect(page.locator('g.item[data-id="Rest/0"][aria-label*="3 s"]')).to_have_count(1)
    page.get_by_role("link", name="SearchBall").drag_to(
        page.locator(".vicode-canvas"), target_position={"x": 560, "y": 110}
    )
    user.expect_selected("search_ball")
    user.drag_from("Search", 0, user.at("components", "search_ball"))
    user.expect_complete()


def test_by_keys_alone(sketches: str, first_page: Page) -> None:
    page = first_page
    user = FirstDesignDriver(page, f"{sketches}design/forward/Empty")
    press = page.keyboard.press
    press("s")
    user.type_name("Idle")
    for name in ("Search", "Found", "Rest"):
        press("n")
        user.type_name(name)
        user.type_guard()
    press("t")
    page.keyboard.type("idle")
    press("Enter")
    user.type_guard("3 s")
    user.expect_selected("Rest/0")
    press("u")
    expect(page.get_by_label("Component", exact=True)).to_be_focused()
    page.keyboard.type("searchb")
    expect(page.locator(".choice")).to_have_count(1)
    press("Enter")
    user.expect_selected("search_ball")
    expect(page.locator(".stage").last).to_be_focused()
    press("t")
    page.keyboard.type("sear")
    press("Enter")
    user.expect_complete()
