"""One types into the forms of notes and frames at once, at any speed and latency; nothing goes elsewhere."""

from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.editor.player_page import open_player, save, select_state, state
from tests.editor.slow_connection import SlowConnection

SPEEDS = pytest.mark.parametrize("key_ms", [0, 30, 120])


@SPEEDS
def test_what_is_typed_after_a_double_click_on_a_note_is_its_text(
    editor: str, page: Page, project: Path, line: SlowConnection, key_ms: int
) -> None:
    file = project / "forward" / "player.yaml"
    file.write_text(file.read_text() + "notes:\n  note: {text: Look., at: [-300, 500]}\n")
    open_player(page, editor)
    select_state(page, "Kick")
    note = page.locator('g[data-kind="note"]')
    line.hold()
    note.dblclick()
    # D, I and S would be commands.
    page.keyboard.type("Did it see the ball?\nDistance.", delay=key_ms)
    expect(page.get_by_label("Text", exact=True)).to_have_value("Did it see the ball?\nDistance.")
    line.release()
    expect(note).to_contain_text("Did it see the ball?")
    assert "Distance." in save(page, file)


@SPEEDS
def test_the_form_of_a_frame_is_typed_into_at_once(
    editor: str, page: Page, project: Path, line: SlowConnection, key_ms: int
) -> None:
    file = project / "forward" / "player.yaml"
    file.write_text(file.read_text() + "frames:\n  Near: [AlignFront, Kick]\n  Far: [LookForBall]\n")
    open_player(page, editor)
    select_state(page, "Kick")
    line.hold()
    page.locator('g[data-kind="frame"][data-id="Near"] .handle-bar').click()
    title = page.get_by_label("Title", exact=True)
    expect(title).to_have_value("Near")
    title.click()
    page.keyboard.press("Control+a")
    page.keyboard.type("Far", delay=key_ms)
    page.keyboard.press("Tab")
    page.get_by_role("button", name="Color green").click()
    line.release()
    expect(page.get_by_label("Inspector").get_by_text("there is already a frame Far", exact=False)).to_be_visible()
    expect(title).to_have_value("Far")
    title.click()
    page.keyboard.press("End")
    page.keyboard.type(" off", delay=key_ms)
    page.keyboard.press("Enter")
    expect(page.locator('g[data-kind="frame"][data-id="Far off"]')).to_be_visible()
    states = page.locator('[data-path="states"]')
    states.get_by_role("combobox").click()
    page.get_by_role("option", name="GetUp").click()
    page.keyboard.press("Escape")
    expect(states.locator(".q-chip")).to_have_count(3)
    saved = save(page, file)
    assert "Far off: {color: green, states: [AlignFront, Kick, GetUp]}" in saved
    page.locator("button.remove").click()
    expect(page.locator('g[data-kind="frame"]')).to_have_count(1)
    expect(state(page, "Kick")).to_be_visible()
