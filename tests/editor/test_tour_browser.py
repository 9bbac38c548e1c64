"""The tour: once for each browser, followed by doing, never in the way, and begun again by a command."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from tests.editor.conftest import started_editor
from tests.editor.player_page import state

expect.set_options(timeout=20_000)
PLAYER = "design/forward/Player"


@pytest.fixture
def editor(project: Path, tmp_path: Path) -> Iterator[str]:
    """As it is started without options."""
    with started_editor(project, tmp_path / "storage", options=()) as url:
        yield url


def expect_step(page: Page, number: int, title: str) -> None:
    card = page.get_by_role("region", name="Tour")
    expect(card).to_contain_text(f"{number} of 10")
    expect(card.get_by_role("heading")).to_have_text(title)


def test_the_tour_follows_what_is_done(editor: str, page: Page, project: Path) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(editor + PLAYER)
    expect_step(page, 1, "A state machine")
    page.keyboard.press("Enter")
    expect_step(page, 2, "Select a state")
    # To make one is not what was asked.
    page.keyboard.press("s")
    page.locator("input.rename").fill("Early")
    page.keyboard.press("Enter")
    expect(page.get_by_label("State", exact=True)).to_have_value("Early")
    expect_step(page, 2, "Select a state")
    state(page, "Kick").click()
    expect_step(page, 3, "Add a state")
    page.keyboard.press("s")
    page.locator("input.rename").fill("Cheer")
    page.keyboard.press("Enter")
    expect_step(page, 4, "Add a transition")
    page.get_by_role("region", name="Tour").get_by_role("button", name="Back").click()
    expect_step(page, 3, "Add a state")
    page.get_by_role("region", name="Tour").get_by_role("button", name="Skip").click()
    page.get_by_label("Inspector").get_by_role("button", name="Transition").click()
    page.get_by_text("to Kick", exact=True).click()
    expect_step(page, 5, "Undo")
    for _edit in range(3):
        page.get_by_role("button", name="Undo").click()
    expect_step(page, 6, "Findings")
    page.get_by_role("button", name="Next").click()
    expect_step(page, 7, "Inputs and commands")
    page.get_by_role("button", name="Next").click()
    expect_step(page, 8, "Simulate")
    page.get_by_role("button", name="Next").click()
    expect_step(page, 9, "Table view")
    page.keyboard.press("F4")
    expect_step(page, 10, "Generate code")
    assert Axe().run(page, context=".tour", options={"resultTypes": ["violations"]}).response["violations"] == []
    page.get_by_role("button", name="Done").click()
    expect(page.get_by_role("region", name="Tour")).to_have_count(0)


def test_escape_ends_it_for_ever_and_a_command_begins_it_again(editor: str, page: Page) -> None:
    page.goto(editor + PLAYER)
    expect_step(page, 1, "A state machine")
    page.keyboard.press("Escape")
    expect(page.get_by_role("region", name="Tour")).to_have_count(0)
    page.reload()
    expect(page.locator(".vicode-canvas[data-ready]")).to_be_attached()
    expect(page.get_by_label("Description").first).to_be_visible()
    expect(page.get_by_role("region", name="Tour")).to_have_count(0)
    page.keyboard.press("Control+k")
    page.keyboard.type("tour")
    expect(page.get_by_role("option").first).to_contain_text("Start tour")
    page.keyboard.press("Enter")
    expect_step(page, 1, "A state machine")
