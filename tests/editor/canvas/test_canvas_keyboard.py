"""Keyboard operation of the canvas."""

import pytest
from playwright.sync_api import expect

from tests.editor.canvas.conftest import CanvasDriver


@pytest.mark.parametrize(("keys", "name"), [("Control+z", "undo"), ("Control+Shift+Z", "redo"), ("Control+y", "redo")])
def test_history_keys_are_reported(canvas: CanvasDriver, keys: str, name: str) -> None:
    canvas.page.locator(".stage").focus()
    canvas.press(keys)
    assert canvas.wait_for_gesture("command") == {"name": name}


@pytest.mark.parametrize("keys", [(), ("F2",)], ids=["on a state", "in its name"])
def test_ctrl_s_reaches_the_page(canvas: CanvasDriver, keys: tuple[str, ...]) -> None:
    canvas.page.evaluate(
        """() => document.body.addEventListener("keydown", event => {
          if (event.key !== "s") return;
          document.body.dataset.saved = String(event.ctrlKey);
          event.preventDefault();
        })"""
    )
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.press(*keys)
    if keys:
        canvas.page.locator("input.rename").fill("Resign")
    canvas.press("Control+s")
    expect(canvas.page.locator("body")).to_have_attribute("data-saved", "true")
    canvas.page.evaluate("delete document.body.dataset.saved")
    assert not canvas.gestures("create")
    if keys:
        assert canvas.wait_for_gesture("rename")["name"] == "Resign"


def test_select_all_takes_everything(canvas: CanvasDriver) -> None:
    canvas.page.locator(".stage").focus()
    canvas.press("Control+a")
    assert len(canvas.wait_for_gesture("select")["items"]) == 8 + 12 + 3 + 5 + 1


def test_tab_selects_states_and_their_transitions_and_enter_renames(canvas: CanvasDriver) -> None:
    canvas.page.locator(".stage").focus()
    canvas.press("Tab")
    assert canvas.selection() == {"states/LookForBall"}
    expect(canvas.group("state", "LookForBall")).to_be_focused()
    canvas.press("Enter")
    expect(canvas.page.locator("input.rename")).to_have_value("LookForBall")
    canvas.press("Escape", "Tab")
    assert canvas.selection() == {"transitions/LookForBall/0"}
    canvas.press("Enter")
    assert canvas.wait_for_gesture("open") == {"item": {"of": "transitions", "id": "LookForBall/0"}}
    canvas.press("Shift+Tab", "Shift+Tab")
    assert canvas.selection() == {"states/LookForBall"}
    expect(canvas.page.locator(".stage")).to_be_focused()


def test_t_connects_to_the_state_clicked_next(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.press("t")
    expect(canvas.page.locator(".message")).to_be_visible()
    canvas.click(canvas.at("states", "FollowBall"))
    assert canvas.wait_for_gesture("connect")["target"] == "FollowBall"
    expect(canvas.page.locator(".message")).to_be_hidden()


def test_keys_after_a_connection_are_for_it(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.press("t")
    canvas.page.keyboard.type("FollowB")
    # The second Enter is pressed before Python has selected the transition; here, it selects another one.
    canvas.press("Enter", "Enter")
    assert canvas.wait_for_gesture("connect")["target"] == "FollowBall"
    canvas.call("select", [{"of": "transitions", "id": "LookForBall/0"}])
    assert canvas.wait_for_gesture("open") == {"item": {"of": "transitions", "id": "LookForBall/0"}}
    expect(canvas.page.locator("input.rename")).to_be_hidden()


def test_escape_clears_the_selection(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.press("Escape")
    assert canvas.selection() == set()
    canvas.wait_for_gesture("select", items=[])
