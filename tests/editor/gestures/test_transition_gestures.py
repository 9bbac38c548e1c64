"""Connecting, reconnecting and reordering transitions and moving labels, by mouse and by keys."""

import re

from playwright.sync_api import expect

from tests.editor.gestures.conftest import EditorDriver, middle


def label(sketch: EditorDriver, identity: str) -> tuple[float, float]:
    return middle(sketch.page.locator(f'g.chip[data-id="{identity}"]'))


def expect_transition(sketch: EditorDriver, identity: str, description: str) -> None:
    expect(sketch.transition(identity)).to_have_attribute("aria-label", re.compile(description))


def test_both_ends_are_reconnected_by_mouse(sketch: EditorDriver) -> None:
    sketch.click(label(sketch, "Start/1"))
    sketch.drag(middle(sketch.page.locator('circle[data-end="target"]')), sketch.state("Go"))
    expect_transition(sketch, "Start/1", "from Start to Go: 3 s")
    sketch.expect_undone()
    sketch.click(label(sketch, "Start/1"))
    sketch.drag(middle(sketch.page.locator('circle[data-end="source"]')), sketch.state("Rest"))
    expect_transition(sketch, "Rest/0", "from Rest to Stop: 3 s")
    sketch.expect_selection("transitions/Rest/0")
    sketch.expect_undone()


def test_both_ends_are_reconnected_by_keys(sketch: EditorDriver) -> None:
    sketch.click(label(sketch, "Start/1"))
    sketch.press("r", "g", "o", "Enter")
    expect_transition(sketch, "Start/1", "from Start to Go: 3 s")
    sketch.expect_undone()
    sketch.click(label(sketch, "Start/1"))
    sketch.press("Shift+R", "ArrowDown", "Enter")
    expect_transition(sketch, "Rest/0", "from Rest to Stop: 3 s")
    sketch.expect_undone()


def test_states_are_connected_by_mouse_and_by_keys(sketch: EditorDriver) -> None:
    sketch.drag(sketch.handle("Rest", 1), sketch.state("Stop"))
    sketch.guard_with()
    expect_transition(sketch, "Rest/0", "from Rest to Stop")
    sketch.expect_undone()
    sketch.select("Rest")
    sketch.press("t", "Tab", "Tab", "Enter")
    sketch.guard_with()
    expect_transition(sketch, "Rest/0", "from Rest to Start")
    sketch.expect_undone()
    sketch.select("Rest")
    sketch.press("t", "ArrowRight")
    expect(sketch.page.locator(".message")).to_contain_text("Stop: press Enter")
    sketch.press("Enter")
    sketch.guard_with("state_time > 2 after 500 ms")
    expect_transition(sketch, "Rest/0", "from Rest to Stop: state_time > 2 and 0.5 s")
    sketch.expect_undone()
    sketch.select("Rest")
    sketch.press("t", "w", "a", "l", "Enter")
    expect(
        sketch.element("link", "requires/Rest/walk").or_(sketch.element("link", "modulates/Rest/walk"))
    ).to_have_count(1)
    sketch.expect_undone()


def test_a_connection_to_empty_space_creates_a_state(sketch: EditorDriver) -> None:
    sketch.drag(sketch.handle("Rest", 2), sketch.state("Rest", 0, 150))
    sketch.rename_to("Sleep")
    sketch.guard_with("20 s")
    expect_transition(sketch, "Rest/0", "from Rest to Sleep: 20 s")
    sketch.expect_undone()
    sketch.select("Rest")
    sketch.press("n")
    sketch.rename_to("Doze")
    sketch.guard_with()
    expect_transition(sketch, "Rest/0", "from Rest to Doze")
    sketch.expect_undone()


def test_a_guard_is_edited_on_its_label(sketch: EditorDriver) -> None:
    sketch.click(label(sketch, "Start/1"), double=True)
    expect(sketch.page.locator("input.guard-field")).to_have_value("after 3 s")
    sketch.guard_with("state_time > 1 after 250 ms")
    expect_transition(sketch, "Start/1", "from Start to Stop: state_time > 1 and 0.25 s")
    sketch.expect_selection("transitions/Start/1")
    sketch.expect_undone()


def test_a_label_is_moved_and_reset(sketch: EditorDriver) -> None:
    x, y = label(sketch, "Start/0")
    sketch.drag((x, y), (x - 20, y - 40))
    sketch.wait_for(f"Math.abs(vicode.screen('transitions', 'Start/0').y - {y - 40}) < 4")
    assert abs(label(sketch, "Start/0")[0] - (x - 20)) < 4
    sketch.expect_undone()
    sketch.wait_for(f"Math.abs(vicode.screen('transitions', 'Start/0').y - {y}) < 1")
    sketch.drag((x, y), (x, y - 40))
    expect(sketch.page.get_by_text("Unsaved changes")).to_be_visible()
    sketch.click(label(sketch, "Start/0"), right=True)
    sketch.choose("Reset label position")
    expect(sketch.page.get_by_text("Saved", exact=True)).to_be_visible()


def test_a_label_is_nudged_by_keys(sketch: EditorDriver) -> None:
    sketch.click(label(sketch, "Start/0"))
    before = label(sketch, "Start/0")[1]
    sketch.press("ArrowDown")
    sketch.wait_for(f"vicode.screen('transitions', 'Start/0').y > {before + 4}")
    sketch.press("ArrowDown")
    sketch.wait_for(f"vicode.screen('transitions', 'Start/0').y > {before + 9}")
    sketch.expect_undone()


def test_a_label_dropped_on_another_changes_the_priority(sketch: EditorDriver) -> None:
    sketch.drag(label(sketch, "Start/2"), label(sketch, "Start/0"))
    expect_transition(sketch, "Start/0", "1 of 3 from Start to Rest")
    expect_transition(sketch, "Start/1", "2 of 3 from Start to Go")
    sketch.expect_selection("transitions/Start/0")
    sketch.expect_undone()


def test_brackets_change_the_priority(sketch: EditorDriver) -> None:
    sketch.click(label(sketch, "Start/0"))
    sketch.press("]")
    sketch.expect_selection("transitions/Start/1")
    expect_transition(sketch, "Start/1", "2 of 3 from Start to Go")
    sketch.press("]")
    sketch.expect_selection("transitions/Start/2")
    sketch.press("[")
    sketch.expect_selection("transitions/Start/1")
    sketch.expect_undone(3)


def test_rows_of_the_inspector_are_reordered_by_dragging(sketch: EditorDriver) -> None:
    sketch.select("Start")
    rows = sketch.page.get_by_label("Inspector").locator(".decision-row")
    expect(rows).to_have_count(3)
    rows.nth(2).drag_to(rows.nth(0))
    expect_transition(sketch, "Start/0", "1 of 3 from Start to Rest")
    expect(rows.nth(0)).to_contain_text("Rest")
    sketch.page.locator(".stage").last.focus()
    sketch.expect_undone()


def test_escape_cancels_every_gesture(sketch: EditorDriver) -> None:
    x, y = sketch.state("Go")
    sketch.press_and_move((x, y), (x + 80, y + 50))
    sketch.wait_for("vicode.positions()['states/Go'].x > 450")
    sketch.press("Escape")
    sketch.page.mouse.up()
    sketch.expect_position("states/Go", 440, 100)
    sketch.press_and_move(sketch.handle("Go", 1), sketch.state("Go", 160, 60))
    expect(sketch.page.locator("path.preview")).to_be_visible()
    sketch.press("Escape")
    sketch.page.mouse.up()
    expect(sketch.page.locator("path.preview")).to_have_count(0)
    x, y = label(sketch, "Start/0")
    sketch.press_and_move((x, y), (x, y - 60))
    sketch.press("Escape")
    sketch.page.mouse.up()
    assert abs(label(sketch, "Start/0")[1] - y) < 1
    sketch.press_and_move(sketch.empty(), sketch.state("Stop"))
    expect(sketch.page.locator("rect.marquee")).to_be_visible()
    sketch.press("Escape")
    sketch.page.mouse.up()
    expect(sketch.page.locator("rect.marquee")).to_have_count(0)
    sketch.select("Rest")
    sketch.press("t")
    expect(sketch.page.locator(".message")).to_be_visible()
    sketch.press("Escape")
    expect(sketch.page.locator(".message")).to_be_hidden()
    sketch.expect_selection("states/Rest")
    expect(sketch.page.get_by_text("Saved", exact=True)).to_be_visible()


def test_an_undo_shows_what_it_changes_off_screen(sketch: EditorDriver) -> None:
    sketch.select("Go")
    sketch.press("ArrowRight")
    sketch.expect_position("states/Go", 450, 100)
    here = sketch.view()
    sketch.evaluate(f"setView({{ x: -4000, y: {here['y']}, k: {here['k']} }})")
    sketch.press("Control+z")
    sketch.expect_position("states/Go", 440, 100)
    sketch.wait_for("vicode.view().x > -1000")
    # What is in view already stays where it is.
    before = sketch.view()
    sketch.press("Control+Shift+Z")
    sketch.expect_position("states/Go", 450, 100)
    assert sketch.view() == before
    sketch.press("Control+z", "1")
    sketch.view()
