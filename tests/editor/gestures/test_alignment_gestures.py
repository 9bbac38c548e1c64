"""Selecting, aligning, distributing, nudging and dragging nodes with guides; each is one edit."""

import pytest
from playwright.sync_api import expect

from tests.editor.gestures.conftest import EditorDriver

ALL = ("Start", "Go", "Stop", "Rest")


def test_a_marquee_selects_and_clicks_add_or_remove(sketch: EditorDriver) -> None:
    sketch.drag(sketch.state("Start", -90, -50), sketch.state("Go", 70, 40))
    assert {"states/Start", "states/Go"} <= sketch.selection()
    assert "states/Stop" not in sketch.selection()
    sketch.click(sketch.state("Go"), "Control")
    assert "states/Go" not in sketch.selection()
    sketch.click(sketch.state("Stop"), "Shift")
    assert "states/Stop" in sketch.selection()
    sketch.page.keyboard.down("Shift")
    sketch.drag(sketch.state("Rest", -90, 45), sketch.state("Rest", 80, -35))
    sketch.page.keyboard.up("Shift")
    assert {"states/Start", "states/Stop", "states/Rest"} <= sketch.selection()
    sketch.click(sketch.empty())
    sketch.expect_selection()


def test_a_selection_is_moved_and_deleted_in_one_edit(sketch: EditorDriver) -> None:
    sketch.select("Go", "Stop")
    start = sketch.state("Go")
    sketch.drag(start, (start[0] + 60, start[1] + 37))
    sketch.wait_for("vicode.positions()['states/Go'].x > 470 && vicode.positions()['states/Stop'].x > 470")
    sketch.expect_undone()
    sketch.select("Go", "Stop")
    sketch.press("Delete")
    expect(sketch.element("state", "Stop")).to_have_count(0)
    sketch.expect_undone()
    expect(sketch.element("state", "Stop")).to_be_visible()


def test_nodes_are_aligned_by_shortcut_and_by_button(sketch: EditorDriver) -> None:
    sketch.select("Start", "Go", "Stop")
    sketch.press("Alt+a")
    for name, (x, y) in {"Go": (120, 100), "Stop": (120, 320)}.items():
        sketch.expect_position(f"states/{name}", x, y)
    sketch.expect_undone()
    sketch.select("Start", "Go", "Stop")
    # Wait until the panel shows the buttons for three states.
    expect(sketch.page.get_by_text("3 states selected")).to_be_visible()
    sketch.page.get_by_role("button", name="Align bottom edges").click()
    for name, (x, y) in {"Start": (120, 320), "Go": (440, 320)}.items():
        sketch.expect_position(f"states/{name}", x, y)
    sketch.expect_undone()


def test_distributing_requires_three_nodes(sketch: EditorDriver) -> None:
    start = sketch.state("Go")
    sketch.drag(start, (start[0] - 120, start[1] + 33))
    sketch.wait_for("vicode.positions()['states/Go'].x < 400")
    expect(sketch.page.get_by_text("Unsaved changes")).to_be_visible()
    sketch.select("Start", "Stop")
    sketch.click(sketch.state("Stop"), right=True)
    expect(sketch.menu().get_by_role("menuitem", name="Align top edges")).to_be_visible()
    expect(sketch.menu().get_by_role("menuitem", name="Distribute horizontally")).to_have_count(0)
    sketch.press("Escape")
    sketch.select("Start", "Go", "Stop")
    sketch.press("Alt+Shift+H")
    sketch.wait_for("vicode.positions()['states/Go'].x === 280")
    sketch.press("Alt+Shift+V")
    sketch.expect_position("states/Go", 280, 210)
    sketch.expect_undone(3)


def test_a_dragged_node_snaps_to_other_nodes_and_shows_guides(sketch: EditorDriver) -> None:
    k = sketch.view()["k"]
    x, y = sketch.state("Rest")
    # Off the grid, so that snapping to the node differs from snapping to the grid.
    sketch.page.keyboard.down("Alt")
    sketch.drag((x, y), (x + 23 * k, y + 41 * k))
    sketch.page.keyboard.up("Alt")
    sketch.wait_for("vicode.positions()['states/Rest'].x !== 120 && vicode.positions()['states/Rest'].x % 10 !== 0")
    rest = sketch.position("states/Rest")
    sketch.press("Escape")
    x, y = sketch.state("Stop")
    sketch.press_and_move((x, y), (x - 60 * k, y + 70 * k), sketch.state("Rest", 260, 4 * k))
    guides = sketch.page.locator("path.guide")
    expect(guides).not_to_have_count(0)
    sketch.page.mouse.up()
    expect(guides).to_have_count(0)
    sketch.wait_for(f"vicode.positions()['states/Stop'].y === {rest[1]}")
    sketch.expect_undone(2)


def test_a_dragged_node_snaps_to_equal_gaps_and_shows_them(sketch: EditorDriver) -> None:
    k = sketch.view()["k"]
    x, y = sketch.state("Rest")
    # Off the grid, so that equal gaps differ from the grid.
    sketch.page.keyboard.down("Alt")
    sketch.drag((x, y), (x + 14 * k, y))
    sketch.page.keyboard.up("Alt")
    sketch.wait_for("vicode.positions()['states/Rest'].x > 125")
    rest, stop = sketch.position("states/Rest"), sketch.position("states/Stop")
    middle = round((rest[0] + stop[0]) / 2)
    assert middle % 10
    sketch.press("Escape")
    x, y = sketch.state("Go")
    (left, row), (right, _row) = sketch.state("Rest"), sketch.state("Stop")
    sketch.press_and_move((x, y), (x - 30, y + 60), ((left + right) / 2 - 3 * k, row + 23 * k))
    gaps = sketch.page.locator("path.guide.gap")
    expect(gaps).to_have_count(2)
    sketch.page.mouse.up()
    expect(gaps).to_have_count(0)
    sketch.wait_for(f"vicode.positions()['states/Go'].x === {middle}")
    sketch.expect_undone(2)


def test_arrow_keys_nudge_as_one_edit(sketch: EditorDriver) -> None:
    sketch.select("Go", "Stop")
    sketch.press("ArrowRight", "ArrowRight", "Shift+ArrowDown")
    sketch.expect_position("states/Go", 460, 101)
    sketch.expect_position("states/Stop", 460, 321)
    sketch.expect_undone()
    sketch.expect_position("states/Go", 440, 100)


def test_all_ways_to_pan_and_zoom(sketch: EditorDriver) -> None:
    before, spot = sketch.view(), sketch.state("Go")
    sketch.page.keyboard.down(" ")
    sketch.drag(sketch.empty(), (sketch.empty()[0] + 50, sketch.empty()[1] - 40))
    sketch.page.keyboard.up(" ")
    sketch.drag(sketch.state("Go"), sketch.state("Go", 30, 10), button="middle")
    sketch.page.mouse.wheel(-7, 13)
    sketch.wait_for(f"Math.abs(vicode.view().x - {before['x'] + 87}) < 2")
    assert sketch.state("Go") == pytest.approx((spot[0] + 87, spot[1] - 43), abs=2)
    spot = sketch.state("Stop")
    sketch.page.mouse.move(*spot)
    # Wheel events in quick succession are attributed to the same device.
    sketch.page.wait_for_timeout(300)
    sketch.page.mouse.wheel(0, -200)
    sketch.wait_for(f"vicode.view().k > {before['k']}")
    assert sketch.state("Stop") == pytest.approx(spot, abs=2)
    sketch.press("0")
    sketch.wait_for("vicode.view().k === 1")
    sketch.press("-")
    sketch.wait_for("vicode.view().k < 1")
    sketch.select("Go", "Stop")
    sketch.press("2")
    sketch.wait_for("vicode.view().k === 1 && vicode.view().resting")
    box = sketch.page.locator(".vicode-canvas").bounding_box()
    assert box is not None
    for x, y in (sketch.state("Go"), sketch.state("Stop")):
        assert box["x"] + 60 < x < box["x"] + box["width"] - 60
        assert box["y"] + 30 < y < box["y"] + box["height"] - 30
    sketch.press("1")
    sketch.wait_for(f"Math.abs(vicode.view().x - {before['x']}) < 1")
    expect(sketch.page.get_by_text("Saved", exact=True)).to_be_visible()
