"""The page of the open design beside the editor: unsaved work is on it, and it follows what is edited."""

import urllib.request
from pathlib import Path
from urllib.error import HTTPError

import pytest
from playwright.sync_api import Page, expect

from tests.editor.player_page import open_player, select_state


def test_the_page_of_a_design_follows_what_is_edited(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    with page.context.expect_page() as opened:
        page.get_by_role("button", name="View", exact=True).click()
        page.get_by_role("menuitem", name="Open documentation").click()
    shown = opened.value
    expect(shown.locator("#state-Kick")).to_be_in_viewport()
    assert shown.url.endswith("/docs/forward/component-Player.html#state-Kick")

    page.bring_to_front()
    page.get_by_label("Description", exact=True).fill("Shoots <b>hard</b>.")
    page.keyboard.press("Tab")
    expect(page.get_by_text("Unsaved changes").first).to_be_visible()
    shown.bring_to_front()
    expect(shown.get_by_role("paragraph").filter(has_text="Shoots <b>hard</b>.")).to_be_visible()
    assert "Shoots" not in (project / "forward" / "player.yaml").read_text()

    # The other pages of the site are there, too, and its search.
    shown.get_by_role("link", name="SearchBall").first.click()
    expect(shown.get_by_role("heading", name="SearchBall", exact=True).first).to_be_visible()
    # Its script hears keys from then on.
    shown.wait_for_load_state()
    shown.keyboard.press("/")
    shown.keyboard.type("shoots")
    expect(shown.get_by_role("option").first).to_contain_text("Kick")


def test_another_program_may_write_the_file(editor: str, page: Page, project: Path) -> None:
    page.goto(f"{editor}docs/forward/component-SearchBall.html")
    file = project / "forward" / "search_ball.yaml"
    file.write_text(file.read_text().replace("component: SearchBall", "component: SearchBall\ndoc: From elsewhere.", 1))
    expect(page.get_by_text("From elsewhere.").first).to_be_visible()


def test_where_no_page_is_a_way_leads_home(editor: str, page: Page, project: Path, console_errors: list[str]) -> None:
    page.goto(f"{editor}docs/forward/component-Nobody.html")
    expect(page.get_by_role("heading", name="Page not found")).to_be_visible()
    expect(page.get_by_text("The documentation of Forward has no such page.")).to_be_visible()
    page.get_by_role("link", name="Go to the home page").click()
    expect(page.get_by_role("heading", name="Forward", exact=True)).to_be_visible()
    # The browser tells of every page that is not there.
    assert all("404" in error for error in console_errors)
    console_errors.clear()


@pytest.mark.parametrize(
    "path", ["forward/nothing.html", "forward/..%2fplayer.yaml", "nobody/index.html", "%2e%2e/forward", "forward/"]
)
def test_there_is_no_other_address(editor: str, path: str) -> None:
    with pytest.raises(HTTPError) as refused:
        urllib.request.urlopen(f"{editor}docs/{path}")
    refused.value.close()
    assert refused.value.code == 404
