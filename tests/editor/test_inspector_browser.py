"""The inspector keeps sections open and buttons in view; the message about a lost connection says what is kept."""

from pathlib import Path

from playwright.sync_api import Page, expect

from tests.editor.player_page import open_player, select_state


def test_sections_stay_open_for_other_states_and_after_a_reload(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    expect(page.get_by_label("Capacity (robots at once)")).to_have_count(0)
    page.get_by_label("Inspector").get_by_role("button", name="More").click()
    expect(page.get_by_label("Capacity (robots at once)")).to_be_visible()
    select_state(page, "GetUp")
    expect(page.get_by_label("Capacity (robots at once)")).to_be_visible()
    open_player(page, editor)
    select_state(page, "Kick")
    expect(page.get_by_label("Capacity (robots at once)")).to_be_visible()
    expect(page.locator("#popup")).to_contain_text("The editor keeps what you changed so far")


def test_a_long_name_leaves_its_remove_button_in_view(editor: str, page: Page, project: Path) -> None:
    alias = "a_component_with_a_name_that_is_much_longer_than_the_panel_is_wide"
    file = project / "forward" / "player.yaml"
    file.write_text(file.read_text().replace("\nuses:\n", f"\nuses:\n  {alias}: StandUp\n", 1))
    assert alias in file.read_text()
    open_player(page, editor)
    remove = page.get_by_role("button", name=f"Remove {alias}")
    remove.scroll_into_view_if_needed()
    box, side = remove.bounding_box(), page.locator(".side").bounding_box()
    assert box is not None
    assert side is not None
    assert box["x"] + box["width"] <= side["x"] + side["width"]
