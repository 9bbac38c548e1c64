"""What a hand does on the canvas is what Python hears."""

import re
from collections.abc import Callable, Mapping
from typing import Any

import pytest
from playwright.sync_api import expect

from tests.editor.canvas.conftest import CanvasDriver
from tests.editor.canvas.player_scene import player


def test_a_dragged_state_follows_and_snaps_to_the_grid(hand: CanvasDriver) -> None:
    x, y = hand.at("states", "GiveUp")
    hand.drag((x, y), (x + 143, y + 62))
    (moved,) = hand.wait_for_gesture("move")["items"]
    assert (moved["of"], moved["id"]) == ("states", "GiveUp")
    assert moved["x"] % 10 == 0
    assert moved["y"] % 10 == 0
    assert moved["x"] > 180
    assert hand.position("states/GiveUp") == (moved["x"], moved["y"])
    # What rests stands there by its coordinates.
    drawn = hand.page.locator('g.nodes > [data-id="GiveUp"]')
    expect(drawn).not_to_have_attribute("transform", re.compile("."))
    box = drawn.locator(".box")
    left, top, width, height = (float(box.get_attribute(name) or 0) for name in ("x", "y", "width", "height"))
    assert (left + width / 2, top + height / 2) == (moved["x"], moved["y"])


def test_alt_moves_freely(hand: CanvasDriver) -> None:
    x, y = hand.at("states", "GiveUp")
    scale = hand.evaluate("view()")["k"]
    hand.page.keyboard.down("Alt")
    hand.drag((x, y), (x + 53 * scale, y))
    hand.page.keyboard.up("Alt")
    assert hand.wait_for_gesture("move")["items"][0]["x"] == pytest.approx(133, abs=1)


def test_escape_puts_a_dragged_state_back(hand: CanvasDriver) -> None:
    x, y = hand.at("states", "GiveUp")
    hand.page.mouse.move(x, y)
    hand.page.mouse.down()
    hand.page.mouse.move(x + 90, y + 50, steps=4)
    hand.wait_for("vicode.positions()['states/GiveUp'].x > 80")
    # On sheets of their own, so that the browser need not paint the rest with every movement.
    assert hand.page.locator('.held.nodes > [data-id="GiveUp"], .held.edges > [data-id="LookForBall/2"]').count() == 2
    hand.press("Escape")
    assert hand.page.locator(".held > *").count() == 0
    hand.page.mouse.up()
    assert hand.position("states/GiveUp") == (80, 330)
    hand.press("Control+z")
    assert hand.wait_for_gesture("undo") == {}
    assert not hand.gestures("move")


def test_a_frame_selects_and_the_selection_moves_together(hand: CanvasDriver) -> None:
    start = hand.at("states", "SearchNet", -130, -60)
    hand.drag(start, hand.at("states", "Fixmove", 100, 60))
    assert hand.selection() == {"states/SearchNet", "states/Fixmove", "transitions/SearchNet/0"}
    x, y = hand.at("states", "Fixmove")
    hand.drag((x, y), (x - 60, y + 20))
    moved = {item["id"]: item for item in hand.wait_for_gesture("move")["items"]}
    assert set(moved) == {"SearchNet", "Fixmove"}
    assert moved["SearchNet"]["x"] == moved["Fixmove"]["x"] < 760


def test_the_common_badge_and_components_can_be_moved(hand: CanvasDriver) -> None:
    x, y = hand.at("common", "@common")
    hand.drag((x, y), (x, y - 100))
    assert hand.wait_for_gesture("move")["items"][0]["of"] == "common"
    x, y = hand.at("components", "perception")
    hand.drag((x, y), (x + 100, y))
    hand.wait_for("vicode.positions()['components/perception'].x > 480")


def test_dragging_from_a_handle_connects(hand: CanvasDriver) -> None:
    hand.drag_handle("states", "GiveUp", hand.at("states", "KickLeft"))
    assert hand.wait_for_gesture("connect") == {"source": "GiveUp", "target": "KickLeft", "x": None, "y": None}


def test_dragging_from_a_handle_back_into_the_box_makes_a_self_loop(hand: CanvasDriver) -> None:
    hand.drag_handle("states", "GiveUp", hand.at("states", "GiveUp"))
    assert hand.wait_for_gesture("connect")["target"] == "GiveUp"


def test_dropping_a_connection_on_nothing_asks_for_a_new_state(hand: CanvasDriver) -> None:
    hand.drag_handle("states", "GiveUp", hand.at("states", "GiveUp", 200, 60))
    connect = hand.wait_for_gesture("connect")
    assert (connect["source"], connect["target"]) == ("GiveUp", None)
    assert connect["x"] % 10 == 0
    assert connect["x"] > 200


def test_a_slip_beside_the_box_connects_nothing(hand: CanvasDriver) -> None:
    hand.drag_handle("states", "GiveUp", hand.at("states", "GiveUp", 10, 58))
    hand.press("Control+z")
    hand.wait_for_gesture("undo")
    assert not hand.gestures("connect")


def test_common_transitions_start_at_the_badge(hand: CanvasDriver) -> None:
    hand.drag_handle("common", "@common", hand.at("states", "GiveUp"))
    assert hand.wait_for_gesture("connect")["source"] == "@common"


def test_a_state_to_a_component_modulates_and_back_requires(hand: CanvasDriver) -> None:
    hand.drag_handle("states", "GiveUp", hand.at("components", "follow_ball"))
    assert hand.wait_for_gesture("link") == {"kind_of_link": "modulates", "state": "GiveUp", "component": "follow_ball"}
    hand.drag_handle("components", "follow_ball", hand.at("states", "GetUp"))
    hand.wait_for_gesture("link", kind_of_link="requires", state="GetUp", component="follow_ball")


def test_a_component_without_parameters_can_only_be_required(show: Callable[[Mapping[str, Any]], CanvasDriver]) -> None:
    scene = player()
    scene["components"][2]["parameters"] = 0
    hand = show(scene)
    hand.drag_handle("states", "GiveUp", hand.at("components", "follow_ball"))
    assert hand.wait_for_gesture("link") == {"kind_of_link": "requires", "state": "GiveUp", "component": "follow_ball"}


def test_the_end_of_a_selected_transition_is_taken_elsewhere(hand: CanvasDriver) -> None:
    hand.click(hand.at("transitions", "Fixmove/0"))
    hand.wait_for_gesture("select", items=[{"of": "transitions", "id": "Fixmove/0"}])
    hand.page.mouse.move(*hand.at("states", "KickLeft", 0, 150))
    box = hand.page.locator('circle[data-end="target"]').bounding_box()
    assert box is not None
    hand.drag((box["x"] + box["width"] / 2, box["y"] + box["height"] / 2), hand.at("states", "GetUp"))
    assert hand.wait_for_gesture("reconnect") == {"id": "Fixmove/0", "end": "target", "state": "GetUp"}


def test_double_click_renames_a_state_in_place(hand: CanvasDriver) -> None:
    hand.click(hand.at("states", "GiveUp"), double=True)
    field = hand.page.locator("input.rename")
    expect(field).to_have_value("GiveUp")
    field.fill("Resign")
    field.press("Enter")
    assert hand.wait_for_gesture("rename") == {"of": "states", "id": "GiveUp", "name": "Resign"}
    expect(hand.group("state", "GiveUp").locator(".name")).to_have_text("Resign")


def test_escape_ends_renaming_without_a_word(hand: CanvasDriver) -> None:
    hand.click(hand.at("states", "GiveUp"))
    hand.press("F2")
    hand.page.locator("input.rename").fill("Resign")
    hand.press("Escape", "Control+z")
    hand.wait_for_gesture("undo")
    assert not hand.gestures("rename")


def test_double_click_creates_states_and_opens_other_things(hand: CanvasDriver) -> None:
    hand.click(hand.at("states", "KickLeft", -160, 10), double=True)
    assert set(hand.wait_for_gesture("create")) == {"x", "y"}
    hand.click(hand.at("components", "search_ball"), double=True)
    assert hand.wait_for_gesture("open") == {"of": "components", "id": "search_ball"}


def test_delete_reports_what_is_selected(hand: CanvasDriver) -> None:
    hand.click(hand.at("states", "GiveUp"))
    hand.page.keyboard.down("Shift")
    hand.click(hand.at("transitions", "Fixmove/1"))
    hand.page.keyboard.up("Shift")
    hand.press("Delete")
    items = hand.wait_for_gesture("delete")["items"]
    assert {(item["of"], item["id"]) for item in items} == {("states", "GiveUp"), ("transitions", "Fixmove/1")}
    expect(hand.group("state", "GiveUp")).to_have_count(0)
    # The edge that led there has no end any more, although nobody removed it.
    expect(hand.group("transition", "LookForBall/2")).to_have_count(0)
    assert hand.selection() == set()


def test_a_state_at_the_origin_is_taken_by_its_middle(show: Callable[[Mapping[str, Any]], CanvasDriver]) -> None:
    scene = player()
    placed = [{**each, "x": 0, "y": 0} if each["id"] == "GetUp" else each for each in scene["states"]]
    hand = show({**scene, "states": placed})
    hand.page.mouse.click(*hand.at("states", "GetUp"))
    hand.wait_for("vicode.selection()[0]?.id === 'GetUp'")
