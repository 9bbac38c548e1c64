"""Searching a design on a real page, by keyboard and by mouse."""

import re
from pathlib import Path

from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import open_player


def hits(page: Page) -> Locator:
    return page.get_by_role("list", name="Results").get_by_role("listitem")


def test_search_and_replace_by_keyboard(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    page.keyboard.press("Control+Shift+F")
    expect(page.get_by_label("Search for")).to_be_focused()
    page.keyboard.type("ball_seen")
    expect(hits(page).first).to_contain_text("perception.ball_seen")
    expect(hits(page).first.locator("mark")).to_have_text("ball_seen")

    # Enter selects what the first hit is about.
    page.keyboard.press("Enter")
    expect(page.get_by_label("Inspector").get_by_text("Transition from")).to_be_visible()

    before = hits(page).count()
    assert before > 1
    page.get_by_label("Replace with").fill("fallen")
    page.get_by_role("button", name="Replace all").press("Enter")
    expect(hits(page)).to_have_count(0)
    expect(page.get_by_label("When", exact=True)).to_have_text("perception.fallen")

    # One edit: one undo.
    page.get_by_role("button", name="Undo").click()
    expect(hits(page)).to_have_count(before)
    expect(page.get_by_text("Saved", exact=True)).to_be_visible()
    hits(page).first.get_by_role("button", name="Replace in").click()
    expect(hits(page)).to_have_count(before - 1)


def test_ways_of_searching_and_mistakes(editor: str, page: Page) -> None:
    open_player(page, editor)
    page.keyboard.press("Control+Shift+F")
    box = page.get_by_label("Search for")
    box.fill("SELF.")
    expect(hits(page)).not_to_have_count(0)
    page.get_by_role("button", name="Match case").click()
    expect(hits(page)).to_have_count(0)
    page.get_by_role("button", name="Match case").click()
    page.get_by_role("button", name="Search in code").click()
    expect(hits(page)).to_have_count(0)
    page.get_by_role("button", name="Search in code").click()
    page.get_by_role("button", name="Use regular expression").click()
    box.fill("(")
    expect(page.get_by_text(re.compile("invalid pattern"))).to_be_visible()
    box.fill(r"self\.(kick|side)s?\b")
    expect(hits(page)).not_to_have_count(0)


def test_texts_from_strangers_are_only_shown(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "player.yaml"
    evil = "<img src=x onerror=document.title=1>"
    file.write_text(file.read_text().replace("doc: Look around", f"doc: {evil} Look around", 1))
    open_player(page, editor)
    page.keyboard.press("Control+Shift+F")
    page.get_by_label("Search for").fill("<img")
    expect(hits(page).first).to_contain_text(evil)
    assert page.locator("img[src=x]").count() == 0
