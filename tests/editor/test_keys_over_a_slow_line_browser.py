"""Keys over a slow line: what the server says of an earlier key does not undo a later one."""

from pathlib import Path

from playwright.sync_api import Page, expect

from tests.editor.player_page import open_player, save, select_state
from tests.editor.slow_connection import SlowConnection

PLACE = "document.querySelector('.vicode-canvas').vicode.positions()['states/GetUp'].x"


def test_steps_add_up_over_a_slow_line(editor: str, page: Page, project: Path, line: SlowConnection) -> None:
    file = project / "forward" / "player.yaml"
    open_player(page, editor)
    select_state(page, "GetUp")
    start = page.evaluate(PLACE)
    line.hold()
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    assert page.evaluate(PLACE) == start + 30
    line.release_until(page, f'"x":{start + 10}')
    page.wait_for_function(f"{PLACE} === {start + 10}")
    # Longer than anybody waits between two presses of a key.
    page.wait_for_timeout(600)
    page.keyboard.press("ArrowRight")
    assert page.evaluate(PLACE) == start + 40
    line.release()
    page.wait_for_function(f"{PLACE} === {start + 40}")
    assert f"at: [{start + 40}, " in save(page, file)


def test_a_renamed_state_stays_selected_before_the_server_selects_it(
    editor: str, page: Page, line: SlowConnection
) -> None:
    open_player(page, editor)
    select_state(page, "GetUp")
    line.hold()
    page.keyboard.press("F2")
    page.keyboard.type("Rise")
    page.keyboard.press("Enter")
    line.release_until(page, '"id":"Rise"')
    page.wait_for_function("'states/Rise' in document.querySelector('.vicode-canvas').vicode.positions()")
    page.keyboard.press("n")
    expect(page.locator("input.rename")).to_be_focused()
    page.keyboard.press("Escape")
    line.release()
