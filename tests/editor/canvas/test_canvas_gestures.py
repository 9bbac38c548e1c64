"""Pointer gestures on the canvas and the events that Python receives."""

import re
from collections.abc import Callable, Mapping
from typing import Any

import pytest
from playwright.sync_api import expect

from tests.editor.canvas.conftest import CanvasDriver
from tests.editor.canvas.player_scene import player


def test_a_dragged_state_follows_and_snaps_to_the_grid(canvas: CanvasDriver) -> None:
    x, y = canvas.at("states", "GiveUp")
    canvas.drag((x, y), (x + 143, y + 62))
    (moved,) = canvas.wait_for_gesture("move")["items"]
    assert (moved["of"], moved["id"]) == ("states", "GiveUp")
    assert moved["x"] % 10 == 0
    assert moved["y"] % 10 == 0
    assert moved["x"] > 180
    assert canvas.position("states/GiveUp") == (moved["x"], moved["y"])
    # The position is part of the coordinates, without a transform.
    drawn = canvas.page.locator('g.nodes > [data-id="GiveUp"]')
    expect(drawn).not_to_have_attribute("transform", re.compile("."))
    box = drawn.locator(".box")
    left, top, width, height = (float(box.get_attribute(name) or 0) for name in ("x", "y", "width", "height"))
    assert (left + width / 2, top + height / 2) == (moved["x"], moved["y"])


def test_alt_moves_freely(canvas: CanvasDriver) -> None:
    x, y = canvas.at("states", "GiveUp")
    scale = canvas.evaluate("view()")["k"]
    canvas.page.keyboard.down("Alt")
    canvas.drag((x, y), (x + 53 * scale, y))
    canvas.page.keyboard.up("Alt")
    assert canvas.wait_for_gesture("move")["items"][0]["x"] == pytest.approx(133, abs=1)


def test_escape_puts_a_dragged_state_back(canvas: CanvasDriver) -> None:
    x, y = canvas.at("states", "GiveUp")
    canvas.page.mouse.move(x, y)
    canvas.page.mouse.down()
    canvas.page.mouse.move(x + 90, y + 50, steps=4)
    canvas.wait_for("vicode.positions()['states/GiveUp'].x > 80")
    # In separate layers, so that the browser does not repaint the rest.
    assert canvas.page.locator('.held.nodes > [data-id="GiveUp"], .held.edges > [data-id="LookForBall/2"]').count() == 2
    canvas.press("Escape")
    assert canvas.page.locator(".held > *").count() == 0
    canvas.page.mouse.up()
    assert canvas.position("states/GiveUp") == (80, 330)
    canvas.press("Control+z")
    canvas.wait_for_gesture("command", name="undo")
    assert not canvas.gestures("move")


def test_the_common_badge_and_components_can_be_moved(canvas: CanvasDriver) -> None:
    x, y = canvas.at("common", "@common")
    canvas.drag((x, y), (x, y - 100))
    assert canvas.wait_for_gesture("move")["items"][0]["of"] == "common"
    x, y = canvas.at("components", "perception")
    canvas.drag((x, y), (x + 100, y))
    canvas.wait_for("vicode.positions()['components/perception'].x > 480")


def test_dragging_from_a_handle_to_the_same_node_adds_a_self_loop(canvas: CanvasDriver) -> None:
    canvas.drag_handle("states", "GiveUp", canvas.at("states", "GiveUp"))
    canvas.press("Enter")
    assert canvas.wait_for_gesture("connect")["target"] == "GiveUp"


def test_releasing_next_to_the_source_node_connects_nothing(canvas: CanvasDriver) -> None:
    canvas.drag_handle("states", "GiveUp", canvas.at("states", "GiveUp", 10, 58))
    canvas.press("Control+z")
    canvas.wait_for_gesture("command", name="undo")
    assert not canvas.gestures("connect")


def test_common_transitions_start_at_the_badge(canvas: CanvasDriver) -> None:
    canvas.drag_handle("common", "@common", canvas.at("states", "GiveUp"))
    canvas.press("Enter")
    assert canvas.wait_for_gesture("connect")["source"] == "@common"


def test_a_state_to_a_component_modulates_and_back_requires(canvas: CanvasDriver) -> None:
    canvas.drag_handle("states", "GiveUp", canvas.at("components", "follow_ball"))
    assert canvas.wait_for_gesture("link") == {
        "kind_of_link": "modulates",
        "state": "GiveUp",
        "component": "follow_ball",
    }
    canvas.drag_handle("components", "follow_ball", canvas.at("states", "GetUp"))
    canvas.wait_for_gesture("link", kind_of_link="requires", state="GetUp", component="follow_ball")


def test_a_component_without_parameters_can_only_be_required(show: Callable[[Mapping[str, Any]], CanvasDriver]) -> None:
    scene = player()
    scene["components"][2]["parameters"] = 0
    canvas = show(scene)
    canvas.drag_handle("states", "GiveUp", canvas.at("components", "follow_ball"))
    assert canvas.wait_for_gesture("link") == {
        "kind_of_link": "requires",
        "state": "GiveUp",
        "component": "follow_ball",
    }


def test_double_click_renames_a_state_in_place(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"), double=True)
    field = canvas.page.locator("input.rename")
    expect(field).to_have_value("GiveUp")
    field.fill("Resign")
    field.press("Enter")
    assert canvas.wait_for_gesture("rename") == {
        "item": {"of": "states", "id": "GiveUp"},
        "name": "Resign",
    }
    expect(canvas.group("state", "GiveUp").locator(".name")).to_have_text("Resign")


def test_escape_cancels_renaming(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.press("F2")
    canvas.page.locator("input.rename").fill("Resign")
    canvas.press("Escape", "Control+z")
    canvas.wait_for_gesture("command", name="undo")
    assert not canvas.gestures("rename")


def test_double_click_creates_states_and_opens_components(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "KickLeft", -160, 10), double=True)
    # No key is lost or taken for a shortcut, and the new state can be used before Python has answered.
    canvas.page.keyboard.type("Sound")
    assert not canvas.gestures("create")
    canvas.press("Enter", "n")
    canvas.page.keyboard.type("Use")
    canvas.press("Escape")
    assert canvas.wait_for_gesture("connect", source="Sound", name="")
    assert canvas.gestures("create")[0].items() >= {"name": "Sound", "select": True}.items()
    assert {gesture["kind"] for gesture in canvas.gestures()} == {"create", "connect"}
    canvas.click(canvas.at("components", "search_ball"), double=True)
    assert canvas.wait_for_gesture("open") == {"item": {"of": "components", "id": "search_ball"}}


def test_delete_reports_the_selection(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.page.keyboard.down("Shift")
    canvas.click(canvas.at("transitions", "Fixmove/1"))
    canvas.page.keyboard.up("Shift")
    canvas.press("Delete")
    items = canvas.wait_for_gesture("delete")["items"]
    assert {(item["of"], item["id"]) for item in items} == {("states", "GiveUp"), ("transitions", "Fixmove/1")}
    expect(canvas.group("state", "GiveUp")).to_have_count(0)
    # The edge to the deleted state is no longer drawn, although it was not removed.
    expect(canvas.group("transition", "LookForBall/2")).to_have_count(0)
    assert canvas.selection() == set()


def test_a_state_at_the_origin_is_clicked_at_its_center(show: Callable[[Mapping[str, Any]], CanvasDriver]) -> None:
    scene = player()
    placed = [{**state, "x": 0, "y": 0} if state["id"] == "GetUp" else state for state in scene["states"]]
    canvas = show({**scene, "states": placed})
    canvas.page.mouse.click(*canvas.at("states", "GetUp"))
    canvas.wait_for("vicode.selection()[0]?.id === 'GetUp'")


@pytest.mark.parametrize("depth", [-0.5, 1, 4])
@pytest.mark.parametrize("along", [0.3, 0.7])
def test_a_drag_from_the_border_connects_without_a_pause(canvas: CanvasDriver, depth: float, along: float) -> None:
    box = canvas.group("state", "GiveUp").locator("rect.box").bounding_box()
    assert box is not None
    # The pointer has not been here: no handle is drawn.
    canvas.page.mouse.move(5, 5)
    canvas.drag((box["x"] + along * box["width"], box["y"] + depth), canvas.at("states", "FollowBall"))
    expect(canvas.page.locator("input.guard-field")).to_be_focused()
    canvas.press("Enter")
    assert canvas.wait_for_gesture("connect", source="GiveUp", target="FollowBall")
    assert not canvas.gestures("move")


def test_a_drag_from_inside_the_border_moves(canvas: CanvasDriver) -> None:
    box = canvas.group("state", "GiveUp").locator("rect.box").bounding_box()
    assert box is not None
    start = box["x"] + 0.3 * box["width"], box["y"] + 7
    canvas.drag(start, (start[0] + 60, start[1] + 40))
    canvas.wait_for_gesture("move")
    assert not canvas.gestures("connect")


def test_a_click_on_what_is_selected_is_told(canvas: CanvasDriver) -> None:
    """Python may be about to select something else."""
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.wait_for_gesture("select", items=[{"of": "states", "id": "GiveUp"}])
    canvas.clear_gestures()
    canvas.page.wait_for_timeout(450)
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.wait_for_gesture("select", items=[{"of": "states", "id": "GiveUp"}])
