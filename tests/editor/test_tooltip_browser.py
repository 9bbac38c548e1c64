"""The card over a thing: by pointer and by keys, with its code, gone as soon as a hand does something."""

from pathlib import Path

from playwright.sync_api import Page, expect

from tests.editor.player_page import center_of, open_player
from tests.editor.test_design_page_browser import drag


def test_a_rest_of_the_pointer_shows_doc_and_code_and_a_press_hides_it(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    peek = page.locator(".tooltip")
    page.mouse.move(*center_of(page, "WatchBall"))
    expect(peek).to_be_visible()
    expect(peek.locator(".tooltip-title")).to_have_text("WatchBall")
    expect(peek.locator("pre").first).to_be_visible()
    before = center_of(page, "WatchBall")
    drag(page, before, (before[0] + 40, before[1] - 40))
    expect(peek).to_be_hidden()
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    assert center_of(page, "WatchBall") != before


def test_the_keys_show_it_and_escape_hides_it(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    page.locator(".canvas .stage").focus()
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    peek = page.locator(".tooltip")
    expect(peek).to_be_visible()
    focused = page.locator('.item[aria-describedby="tooltip"]')
    expect(focused).to_have_count(1)
    page.keyboard.press("Escape")
    expect(peek).to_be_hidden()
