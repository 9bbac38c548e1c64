"""The canvas without a pointer."""

import pytest
from playwright.sync_api import expect

from tests.editor.canvas.conftest import CanvasDriver


@pytest.mark.parametrize(("keys", "kind"), [("Control+z", "undo"), ("Control+Shift+Z", "redo"), ("Control+y", "redo")])
def test_history_keys_are_reported(hand: CanvasDriver, keys: str, kind: str) -> None:
    hand.page.locator(".stage").focus()
    hand.press(keys)
    assert hand.wait_for_gesture(kind) == {}


@pytest.mark.parametrize("keys", [(), ("F2",)], ids=["on a state", "in its name"])
def test_the_key_to_save_reaches_the_page(hand: CanvasDriver, keys: tuple[str, ...]) -> None:
    hand.page.evaluate(
        """() => document.body.addEventListener("keydown", event => {
          if (event.key !== "s") return;
          document.body.dataset.saved = String(event.ctrlKey);
          event.preventDefault();
        })"""
    )
    hand.click(hand.at("states", "GiveUp"))
    hand.press(*keys)
    if keys:
        hand.page.locator("input.rename").fill("Resign")
    hand.press("Control+s")
    expect(hand.page.locator("body")).to_have_attribute("data-saved", "true")
    hand.page.evaluate("delete document.body.dataset.saved")
    assert not hand.gestures("create")
    if keys:
        assert hand.wait_for_gesture("rename")["name"] == "Resign"


def test_arrows_nudge_the_selection(hand: CanvasDriver) -> None:
    hand.click(hand.at("states", "GiveUp"))
    hand.press("ArrowRight", "Shift+ArrowDown")
    hand.wait_for("vicode.positions()['states/GiveUp'].y === 331")
    hand.wait_for_gesture("move", items=[{"of": "states", "id": "GiveUp", "x": 90, "y": 331}])


def test_select_all_takes_everything(hand: CanvasDriver) -> None:
    hand.page.locator(".stage").focus()
    hand.press("Control+a")
    assert len(hand.wait_for_gesture("select")["items"]) == 8 + 12 + 3 + 5 + 1


def test_tab_walks_from_a_state_to_what_leaves_it_and_enter_renames(hand: CanvasDriver) -> None:
    hand.page.locator(".stage").focus()
    hand.press("Tab")
    assert hand.selection() == {"states/LookForBall"}
    expect(hand.group("state", "LookForBall")).to_be_focused()
    hand.press("Enter")
    expect(hand.page.locator("input.rename")).to_have_value("LookForBall")
    hand.press("Escape", "Tab")
    assert hand.selection() == {"transitions/LookForBall/0"}
    hand.press("Enter")
    assert hand.wait_for_gesture("open") == {"of": "transitions", "id": "LookForBall/0"}
    hand.press("Shift+Tab", "Shift+Tab")
    assert hand.selection() == {"states/LookForBall"}
    expect(hand.page.locator(".stage")).to_be_focused()


def test_t_connects_to_the_state_clicked_next(hand: CanvasDriver) -> None:
    hand.click(hand.at("states", "GiveUp"))
    hand.press("t")
    expect(hand.page.locator(".message")).to_be_visible()
    hand.click(hand.at("states", "FollowBall"))
    assert hand.wait_for_gesture("connect")["target"] == "FollowBall"
    expect(hand.page.locator(".message")).to_be_hidden()


def test_t_connects_to_the_state_one_tabs_to(hand: CanvasDriver) -> None:
    hand.click(hand.at("states", "KickLeft"))
    hand.press("t", "Tab", "Enter")
    assert hand.wait_for_gesture("connect") == {"source": "KickLeft", "target": "KickRight", "x": None, "y": None}


def test_s_creates_a_state(hand: CanvasDriver) -> None:
    hand.page.locator(".stage").focus()
    hand.press("s")
    assert set(hand.wait_for_gesture("create")) == {"x", "y"}


def test_escape_clears_the_selection(hand: CanvasDriver) -> None:
    hand.click(hand.at("states", "GiveUp"))
    hand.press("Escape")
    assert hand.selection() == set()
    hand.wait_for_gesture("select", items=[])


def test_zoom_keys(hand: CanvasDriver) -> None:
    hand.page.locator(".stage").focus()
    fitted = hand.evaluate("view()")["k"]
    hand.press("+")
    assert hand.evaluate("view()")["k"] == pytest.approx(fitted * 1.25)
    hand.press("0")
    assert hand.evaluate("view()")["k"] == 1
    hand.press("1")
    assert hand.evaluate("view()")["k"] == pytest.approx(fitted)
