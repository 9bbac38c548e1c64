"""The machines of used components are shown in place, hidden again, and opened by a double-click."""

from pathlib import Path

from playwright.sync_api import Page, expect

from tests.editor.player_page import component, open_player, select_state


def test_a_state_shows_the_machines_that_it_uses(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "player.yaml"
    before = file.read_text()
    open_player(page, editor)
    select_state(page, "AlignFront")
    page.keyboard.press("e")
    inside = page.locator(".inset-figure")
    expect(inside).to_have_count(2)
    expect(page.get_by_role("group", name="Inside fixmove: state machine Fixmove").locator("g.state")).to_have_count(4)
    page.keyboard.press("e")
    expect(inside).to_have_count(0)
    component(page, "search_ball").click()
    page.keyboard.press("e")
    expect(inside.get_by_text("search_ball: SearchBall")).to_be_visible()
    inside.dblclick()
    page.wait_for_url("**/design/forward/SearchBall*")
    assert file.read_text() == before


def test_a_simulation_marks_the_active_state_inside(editor: str, page: Page) -> None:
    open_player(page, editor)
    page.get_by_role("tab", name="Simulate").click()
    page.keyboard.press("F10")
    expect(page.locator('g.active[data-id="LookForBall"]')).to_be_visible()
    component(page, "search_ball").click()
    page.keyboard.press("e")
    inside = page.locator(".inset-figure .node.active")
    expect(inside).to_have_attribute("data-id", "LookAhead")


def test_nothing_inside_hand_written_components_is_said(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_state(page, "GetUp")
    page.keyboard.press("e")
    expect(page.get_by_text("No component that GetUp uses has a design")).to_be_visible()
