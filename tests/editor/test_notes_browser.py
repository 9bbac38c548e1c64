"""Notes are added, edited, moved and deleted on the canvas, and kept in the file."""

from pathlib import Path

from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import empty_corner, open_player, save


def test_a_note_is_added_edited_moved_and_deleted(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    page.mouse.click(*empty_corner(page))
    page.keyboard.press("m")
    text = page.get_by_label("Text", exact=True)
    expect(text).to_be_focused()
    page.keyboard.type("Looks twice.")
    note = page.locator('g[data-kind="note"]')
    expect(note).to_contain_text("Looks twice.")
    before = _center(note)
    page.mouse.move(*before)
    page.mouse.down()
    page.mouse.move(before[0] + 90, before[1] - 60, steps=4)
    page.mouse.up()
    assert _center(note) != before
    page.mouse.dblclick(*_center(note))
    expect(text).to_be_focused()
    text.blur()
    saved = save(page, project / "forward" / "player.yaml")
    assert "text: Looks twice." in saved
    page.mouse.click(*_center(note))
    page.keyboard.press("Delete")
    expect(note).to_have_count(0)
    page.keyboard.press("Control+z")
    expect(note).to_contain_text("Looks twice.")


def _center(drawn: Locator) -> tuple[float, float]:
    drawn.wait_for()
    box = drawn.bounding_box()
    if box is None:
        # It was drawn again between the two questions.
        return _center(drawn)
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
