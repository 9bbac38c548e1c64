"""Context menus, the help, and keyboard shortcuts."""

import re

from playwright.sync_api import expect

from tests.editor.gestures.conftest import EditorDriver, middle


def test_the_context_menu_shows_commands_with_their_shortcuts(sketch: EditorDriver) -> None:
    sketch.click(sketch.state("Go"), right=True)
    sketch.expect_selection("states/Go")
    entries = sketch.menu().get_by_role("menuitem")
    expect(entries.first).to_be_focused()
    expect(sketch.menu().get_by_role("menuitem", name="Duplicate")).to_contain_text("Ctrl+D")
    sketch.choose("Set as initial state")
    expect(sketch.element("state", "Go")).to_have_attribute("aria-label", re.compile("initial"))
    sketch.expect_undone()
    sketch.click(sketch.state("Go"), right=True)
    sketch.choose("Toggle final")
    expect(sketch.element("state", "Go")).to_have_attribute("aria-label", re.compile("final"))
    sketch.expect_undone()


def test_each_kind_of_element_has_its_menu(sketch: EditorDriver) -> None:
    for spot, entry in (
        (middle(sketch.page.locator('g.chip[data-id="Start/1"]')), "Edit guard"),
        (sketch.at("components", "walk"), "Open design"),
        (sketch.empty(), "New state"),
    ):
        sketch.click(spot, right=True)
        expect(sketch.menu().get_by_role("menuitem", name=entry)).to_be_visible()
        sketch.press("Escape")
        expect(sketch.menu()).to_be_hidden()
    sketch.select("Go", "Stop")
    sketch.click(sketch.state("Stop"), right=True)
    sketch.expect_selection("states/Go", "states/Stop")
    sketch.choose("Delete")
    expect(sketch.element("state", "Stop")).to_have_count(0)
    sketch.expect_undone()


def test_a_long_menu_is_shown_whole_over_the_panel_below(sketch: EditorDriver) -> None:
    tab = sketch.page.locator('[role="tab"][aria-selected="true"]').first.inner_text().strip()
    sketch.page.set_viewport_size({"width": 1366, "height": 600})
    sketch.page.get_by_role("tab", name="Simulate").click()
    sketch.click(sketch.state("Go"), right=True)
    expect(sketch.menu().get_by_role("menuitem", name="Toggle breakpoint")).to_be_in_viewport(ratio=1)
    assert sketch.menu().evaluate("menu => menu.scrollHeight <= menu.clientHeight")
    sketch.choose("Toggle breakpoint")
    expect(sketch.menu()).to_be_hidden()
    # The page is used by the next tests.
    sketch.page.get_by_role("tab", name=tab, exact=True).click()
    sketch.page.set_viewport_size({"width": 1366, "height": 768})


def test_a_menu_works_by_keys_alone(sketch: EditorDriver) -> None:
    sketch.select("Go")
    for keys in ("Shift+F10", "ContextMenu"):
        sketch.press(keys)
        entries = sketch.menu().get_by_role("menuitem")
        expect(entries.first).to_be_focused()
        sketch.press("ArrowUp")
        expect(entries.last).to_be_focused()
        sketch.press("Home", "ArrowDown")
        expect(entries.nth(1)).to_be_focused()
        sketch.press("Escape")
        expect(sketch.menu()).to_be_hidden()
    sketch.press("Shift+F10", "d", "d", "Enter")
    sketch.expect_selection("states/Go2")
    sketch.expect_undone()


def test_a_state_created_by_the_menu_is_where_the_menu_was_opened(sketch: EditorDriver) -> None:
    spot = sketch.empty()
    sketch.click(spot, right=True)
    sketch.choose("New state")
    sketch.rename_to("Wait")
    x, y = sketch.state("Wait")
    assert abs(x - spot[0]) + abs(y - spot[1]) < 20
    sketch.expect_undone()


def test_the_help_lists_every_key(sketch: EditorDriver) -> None:
    sketch.page.locator(".stage").last.focus()
    sketch.press("?")
    help_ = sketch.page.locator(".help")
    texts = ("Ctrl+D", "Duplicate", "Ctrl+S", "Drag a label", "Shift+F10", "F6", "F9", "F10", "Page: Simulate tab")
    for text in texts:
        expect(help_.get_by_text(text, exact=True).first).to_be_visible()
    sketch.press("Escape")
    expect(help_).to_have_count(0)


def test_keys_work_initially_and_when_nothing_has_the_focus(sketch: EditorDriver) -> None:
    expect(sketch.page.locator(".stage").last).to_be_focused()
    sketch.press("Tab")
    sketch.expect_selection("states/Start")
    sketch.page.evaluate("document.activeElement.blur()")
    sketch.press("Control+ArrowRight")
    sketch.expect_selection("states/Go")
    sketch.press("Control+Shift+ArrowDown")
    sketch.expect_selection("states/Go", "states/Stop")
    sketch.press("d")
    expect(sketch.element("state", "Stop")).to_have_class(re.compile("disabled"))
    sketch.expect_undone()


def test_new_states_by_keys_are_at_free_positions(sketch: EditorDriver) -> None:
    for name in ("One", "Two"):
        sketch.press("s")
        sketch.rename_to(name)
    (x1, y1), (x2, y2) = sketch.position("states/One"), sketch.position("states/Two")
    assert abs(x1 - x2) >= 120 or abs(y1 - y2) >= 60
    sketch.expect_undone(2)


def test_a_component_is_used_by_keys_and_by_dragging_its_design(sketch: EditorDriver) -> None:
    sketch.press("u")
    field = sketch.page.get_by_label("Component", exact=True)
    expect(field).to_be_focused()
    field.fill("searchb")
    expect(sketch.page.get_by_role("dialog").locator(".choice")).to_have_count(1)
    field.press("Enter")
    expect(sketch.element("component", "search_ball")).to_be_visible()
    sketch.expect_selection("components/search_ball")
    expect(sketch.page.locator(".stage").last).to_be_focused()
    sketch.expect_undone()
    link = sketch.page.get_by_role("link", name="SearchNet")
    link.drag_to(sketch.page.locator(".vicode-canvas"), target_position={"x": 500, "y": 80})
    expect(sketch.element("component", "search_net")).to_be_visible()
    sketch.expect_selection("components/search_net")
    sketch.expect_undone()


def test_escape_moves_the_focus_from_a_field_to_the_canvas(sketch: EditorDriver) -> None:
    sketch.click(middle(sketch.page.locator('g.chip[data-id="Start/1"]')))
    sketch.press("Enter", "Tab")
    after = sketch.page.get_by_label("After (seconds in this state)")
    expect(after).to_be_focused()
    after.fill("5")
    expect(sketch.transition("Start/1")).to_have_attribute("aria-label", re.compile("5 s"))
    sketch.press("Escape")
    expect(sketch.page.locator(".stage").last).to_be_focused()
    sketch.expect_selection("transitions/Start/1")
    sketch.expect_undone()


def test_what_a_single_key_did_is_said_and_undone(sketch: EditorDriver) -> None:
    for key, done in (
        ("d", "Disabled Go"),
        ("i", "Go is the initial state"),
        ("f", "Go is final"),
        ("m", "Added a note"),
    ):
        sketch.select("Go")
        sketch.press(key)
        bar = sketch.page.locator(".undo-bar")
        expect(bar).to_contain_text(done)
        bar.get_by_role("button", name="Undo").click()
        expect(bar).to_be_hidden()
        expect(sketch.page.get_by_text("Saved", exact=True)).to_be_visible()
    sketch.click(middle(sketch.page.locator('g.chip[data-id="Start/0"]')))
    sketch.press("]")
    expect(sketch.page.locator(".undo-bar")).to_contain_text("Changed the order of transitions")
    sketch.page.locator(".undo-bar").get_by_role("button", name="Undo").click()
    expect(sketch.page.get_by_text("Saved", exact=True)).to_be_visible()
