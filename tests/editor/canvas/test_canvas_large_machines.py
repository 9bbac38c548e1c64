"""Machines of hundreds of states: names are readable at every zoom, and what is selected stands out."""

from collections.abc import Callable, Mapping
from itertools import combinations
from typing import Any

import pytest
from playwright.sync_api import expect

from tests.editor.canvas.conftest import CanvasDriver
from tests.editor.canvas.player_scene import machine
from tests.editor.canvas.run_js import run_js

Show = Callable[[Mapping[str, Any]], CanvasDriver]

COUNT_INK = """([x, y, w, h]) => {
    const canvas = document.querySelector('.vicode-canvas').shadowRoot.querySelector('.names');
    const box = canvas.getBoundingClientRect();
    const pixels = canvas.getContext('2d').getImageData(x - w / 2 - box.x, y - h / 2 - box.y, w, h).data;
    return pixels.filter((value, index) => index % 4 === 3 && value > 200).length / (w * h);
}"""
OPACITY = "each => getComputedStyle(each.closest('svg')).opacity"


@pytest.mark.parametrize("zoom", [0.06, 0.11, 0.28])
@pytest.mark.parametrize("count", [120, 300])
def test_names_are_readable_and_apart_at_small_zooms(show: Show, count: int, zoom: float) -> None:
    canvas = show(machine(count))
    canvas.page.evaluate("k => document.querySelector('.vicode-canvas').vicode.setView({ k, x: 300, y: 200 })", zoom)
    canvas.wait_for(
        "vicode.view().resting && vicode.names().length && vicode.names().every(({ text, x }) =>"
        " Math.abs(vicode.screen('states', text).x - x) < 1)"
    )
    names = canvas.evaluate("names()")
    assert len(names) > 8
    for name in names:
        assert name["size"] >= 9
        # The name is where its state is, and is painted there.
        x, y = canvas.at("states", name["text"])
        assert abs(x - name["x"]) < 1
        assert abs(y - name["y"]) < 1
    assert canvas.page.evaluate(COUNT_INK, [names[0][side] for side in ("x", "y", "w", "size")]) > 0.3
    for one, other in combinations(names, 2):
        is_beside = abs(one["x"] - other["x"]) >= (one["w"] + other["w"]) / 2
        assert is_beside or abs(one["y"] - other["y"]) >= (one["size"] + other["size"]) / 2, (one, other)


def test_names_inside_the_boxes_return_when_zoomed_in(show: Show) -> None:
    canvas = show(machine(120))
    canvas.page.evaluate("document.querySelector('.vicode-canvas').vicode.setView({ k: 0.2 })")
    canvas.wait_for("vicode.names().length > 8")
    expect(canvas.group("state", "State0").locator(".large").first).to_be_hidden()
    canvas.page.evaluate("document.querySelector('.vicode-canvas').vicode.setView({ k: 0.45 })")
    canvas.wait_for("vicode.names().length === 0")
    expect(canvas.group("state", "State0").locator(".large").first).to_be_visible()
    assert canvas.evaluate("names()") == []


def test_long_names_keep_their_ends() -> None:
    # Each character is one unit wide.
    texts = ["PrepareKickLeft", "PrepareKickRight", "Turn", "", "x" * 500 + "End"]
    ruler = (
        "document.createElement = () => ({ getContext: () => ({ measureText: (text) => ({ width: text.length }) }) })"
    )
    shown = run_js(
        "text_metrics.js",
        "truncateMiddle",
        f"({ruler}, args[0].map((text) => truncateMiddle(text, 'name', 12)))",
        texts,
    )
    assert shown[:4] == ["Prepar…kLeft", "Prepar…Right", "Turn", ""]
    assert shown[4].endswith("End")
    assert len(shown[4]) == 12


@pytest.mark.parametrize("zoom", [0.2, 0.8])
def test_the_selection_of_a_state_dims_what_is_not_connected_to_it(show: Show, zoom: float) -> None:
    canvas = show(machine(100))
    canvas.page.evaluate("k => document.querySelector('.vicode-canvas').vicode.setView({ k, x: 200, y: 100 })", zoom)
    canvas.wait_until_idle()
    state, neighbor, other = (canvas.group("state", f"State{number}") for number in (1, 2, 4))
    edge = canvas.group("transition", "State1/0")
    canvas.click(canvas.at("states", "State1"))
    for bright in (state, neighbor, edge):
        expect(bright).to_have_count(1)
        assert bright.evaluate(OPACITY) == "1"
    assert float(other.evaluate(OPACITY)) < 0.5
    # A drag leaves it so, and the state where it was dropped.
    x, y = canvas.at("states", "State1")
    canvas.drag((x, y), (x + 40, y + 20))
    canvas.wait_for_gesture("move")
    assert state.evaluate(OPACITY) == "1"
    box = state.locator(".box").last.bounding_box()
    assert box is not None
    assert box["x"] + box["width"] / 2 == pytest.approx(canvas.at("states", "State1")[0], abs=1)
    canvas.press("Escape")
    for each in (state, neighbor, other):
        assert each.evaluate(OPACITY) == "1"


def test_a_focus_shows_what_is_within_some_transitions_until_escape(show: Show) -> None:
    """The expected states follow from the transitions of the scene."""
    scene = machine(100)
    canvas = show(scene)
    before = canvas.evaluate("view()")
    pairs = {(edge["source"], edge["target"]) for edge in scene["transitions"]}
    within_one = {name for pair in pairs if "State31" in pair for name in pair}
    within_two = {name for pair in pairs if within_one & set(pair) for name in pair}
    nodes = canvas.page.locator("g.node")
    canvas.click(canvas.at("states", "State31"))
    canvas.press("3")
    expect(nodes).to_have_count(len(within_one))
    assert {node.get_attribute("data-id") for node in nodes.all()} == within_one
    shown_edges = canvas.page.locator("g.edge")
    assert {edge.get_attribute("data-id") for edge in shown_edges.all()} == {
        edge["id"] for edge in scene["transitions"] if {edge["source"], edge["target"]} <= within_one
    }
    expect(canvas.page.get_by_text(f"Within 1 transition of State31: {len(within_one)} of 100 nodes")).to_be_visible()
    canvas.press("4")
    expect(nodes).to_have_count(len(within_two))
    canvas.press("Control+a")
    assert {name for name in canvas.selection() if name.startswith("states/")} == {f"states/{n}" for n in within_two}
    canvas.press("Escape")
    expect(nodes).to_have_count(100)
    assert canvas.evaluate("view()")["k"] == pytest.approx(before["k"])
    # What somebody looks for is shown, also when it was hidden.
    canvas.click(canvas.at("states", "State31"))
    canvas.press("3")
    expect(nodes).to_have_count(len(within_one))
    canvas.call("center", "states", "State99")
    expect(canvas.group("state", "State99")).to_be_visible()


def test_a_focus_ends_by_its_button_and_in_a_menu(show: Show) -> None:
    canvas = show(machine(100))
    canvas.page.mouse.click(*canvas.at("states", "State31"), button="right")
    canvas.page.get_by_role("menuitem", name="Focus on neighbors", exact=False).first.click()
    expect(canvas.group("state", "State99")).to_have_count(0)
    canvas.page.get_by_role("button", name="Show all").click()
    expect(canvas.group("state", "State99")).to_have_count(1)
    canvas.press("3", "3")
    expect(canvas.group("state", "State99")).to_have_count(1)


def test_edges_that_leave_the_view_name_their_ends_and_lead_there(show: Show) -> None:
    states = [{"id": name, "name": name, "x": x, "y": 0} for name, x in (("Here", 0), ("Far", 4000), ("Behind", -4000))]
    edges = [
        {"id": f"{source}/0", "source": source, "target": target, "label": "", "order": 1, "of": 1, "kind": "always"}
        for source, target in (("Here", "Far"), ("Behind", "Here"))
    ]
    canvas = show(
        {"rev": 1, "component": "Robot", "states": states, "transitions": edges, "components": [], "links": []}
    )
    labels = canvas.page.locator(".off-screen button")
    canvas.call("center", "states", "Here")
    canvas.wait_until_idle()
    expect(labels).to_have_count(0)
    canvas.click(canvas.at("states", "Here"))
    expect(labels).to_have_text(["→ Far", "← Behind"])
    far, behind = (label.bounding_box() for label in labels.all())
    assert far is not None
    assert behind is not None
    assert far["x"] > 1366 / 2 > behind["x"]
    labels.first.click()
    canvas.wait_until_idle()
    assert canvas.selection() == {"states/Far"}
    assert canvas.at("states", "Far")[0] == pytest.approx(1366 / 2, abs=2)
    expect(labels).to_have_text(["← Here"])


@pytest.mark.parametrize("y", [1500, 1900, 2300])
def test_labels_of_edges_that_leave_the_view_keep_clear_of_the_tools(show: Show, y: float) -> None:
    states = [{"id": name, "name": name, "x": x, "y": at} for name, x, at in (("Here", 0, 0), ("Low", 4000, y))]
    edge = {"id": "Here/0", "source": "Here", "target": "Low", "label": "", "order": 1, "of": 1, "kind": "always"}
    canvas = show(
        {"rev": 1, "component": "Robot", "states": states, "transitions": [edge], "components": [], "links": []}
    )
    canvas.call("center", "states", "Here")
    canvas.wait_until_idle()
    canvas.click(canvas.at("states", "Here"))
    label, tools = (canvas.page.locator(each).bounding_box() for each in (".off-screen button", ".corner"))
    assert label is not None
    assert tools is not None
    assert label["x"] + label["width"] <= tools["x"] or label["y"] + label["height"] <= tools["y"]
