"""Colors of states are chosen in the inspector, drawn, undone and saved."""

from pathlib import Path

from playwright.sync_api import Page, expect

from tests.editor.player_page import open_player, save, select_state, state


def test_a_state_is_colored(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    green = page.get_by_role("button", name="Color green")
    page.get_by_label("Inspector").get_by_role("button", name="More").click()
    green.click()
    expect(green).to_have_attribute("aria-pressed", "true")
    drawn = state(page, "Kick").locator(".box")
    expect(drawn).to_have_css("fill", "rgb(226, 245, 211)")
    assert "color: green" in save(page, project / "forward" / "player.yaml")
    page.get_by_role("button", name="Undo").click()
    expect(page.get_by_role("button", name="Color none")).to_have_attribute("aria-pressed", "true")
    expect(drawn).to_have_css("fill", "rgb(255, 255, 255)")
