"""Automatic layout: shown before it is taken, taken or left by mouse and by keyboard, undone as one, called off."""

from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.diagram.diagram_designs import ring_design
from tests.editor.player_page import center_of, open_player, select_state, state
from vicode.store import save_design, write_text

PLACES = "document.querySelector('.vicode-canvas').vicode.positions()"


def begin(page: Page) -> None:
    page.get_by_role("button", name="Auto layout").click()
    expect(page.get_by_text("Preview:")).to_be_visible(timeout=40_000)
    # Keys are the drawing's from the moment it shows the preview.
    expect(page.locator("main.design-view .stage")).to_be_focused()


def test_a_layout_is_shown_and_left_with_escape_or_taken_with_enter(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    before = page.evaluate(PLACES)
    begin(page)
    expect(page.locator("path.before")).to_have_count(1)
    shown = page.evaluate(PLACES)
    assert shown != before
    # While it is shown one may look around, and changes nothing.
    page.mouse.dblclick(*center_of(page, "Kick"))
    page.keyboard.press("Delete")
    expect(page.locator("input.rename")).to_be_hidden()
    page.keyboard.press("Escape")
    expect(page.get_by_text("Preview:")).to_be_hidden()
    expect(page.locator("path.before")).to_have_count(0)
    assert page.evaluate(PLACES) == before
    expect(page.get_by_text("Saved", exact=True)).to_be_visible()

    begin(page)
    page.keyboard.press("Enter")
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    expect(page.locator("path.before")).to_have_count(0)
    assert page.evaluate(PLACES) == shown
    page.keyboard.press("Control+z")
    expect(page.get_by_text("Saved", exact=True)).to_be_visible()
    page.wait_for_function(f"before => JSON.stringify({PLACES}) === JSON.stringify(before)", arg=before)


def test_only_what_is_selected_is_laid_out_and_applied_by_mouse(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    before = page.evaluate(PLACES)
    select_state(page, "LookForBall")
    page.keyboard.down("Shift")
    page.mouse.click(*center_of(page, "WatchBall"))
    page.keyboard.up("Shift")
    begin(page)
    expect(page.get_by_text("Preview: 2 states")).to_be_visible()
    page.get_by_label("Layout").get_by_role("button", name="Apply").click()
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    after = page.evaluate(PLACES)
    moved = {name for name in after if after[name] != before[name]}
    assert moved
    assert moved <= {"states/LookForBall", "states/WatchBall"}


def test_an_edit_ends_the_preview(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    begin(page)
    page.get_by_label("Description").first.fill("Strike the ball.")
    expect(page.get_by_text("Preview:")).to_be_hidden()
    expect(page.locator("path.before")).to_have_count(0)


@pytest.mark.nightly
@pytest.mark.parametrize("way", ["button", "key"])
def test_a_layout_that_takes_long_is_called_off(editor: str, page: Page, project: Path, way: str) -> None:
    file = project / "forward" / "ring.yaml"
    write_text(file, save_design(ring_design(480, chords=4), ""))
    page.goto(editor + "design/forward/Ring", timeout=60_000)
    expect(page.locator(".vicode-canvas[data-ready]")).to_be_visible(timeout=40_000)
    before = page.evaluate(PLACES)
    page.get_by_role("button", name="Auto layout").click()
    expect(page.get_by_text("Laying out 480 states, 5 s at most")).to_be_visible()
    if way == "button":
        page.get_by_label("Layout").get_by_role("button", name="Cancel").click()
    else:
        page.keyboard.press("Escape")
    expect(page.get_by_label("Layout")).to_be_hidden()
    assert page.evaluate(PLACES) == before
    expect(state(page, "State0")).to_have_count(0)
    expect(page.get_by_text("Saved", exact=True)).to_be_visible()


def test_among_many_states_a_target_is_found_by_typing(editor: str, page: Page, project: Path) -> None:
    write_text(project / "forward" / "ring.yaml", save_design(ring_design(80, chords=0), ""))
    page.goto(editor + "design/forward/Ring", timeout=60_000)
    page.get_by_role("button", name="Common transitions and actions").click()
    find = page.get_by_label("Transition to")
    find.click()
    find.press_sequentially("State77")
    page.get_by_role("option", name="State77", exact=True).click()
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    expect(page.locator('g.edge[data-id="@common/0"]')).to_have_count(1)
