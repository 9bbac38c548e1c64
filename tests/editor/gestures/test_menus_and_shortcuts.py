"""Menus, the help, and what keys alone can do."""

import re

from playwright.sync_api import expect

from tests.editor.gestures.conftest import EditorDriver, middle


def test_a_right_click_shows_what_can_be_done_with_its_keys(sketch: EditorDriver) -> None:
    sketch.click(sketch.state("Go"), right=True)
    sketch.expect_selection("states/Go")
    entries = sketch.menu().get_by_role("menuitem")
    expect(entries.first).to_be_focused()
    expect(sketch.menu().get_by_role("menuitem", name="Duplicate")).to_contain_text("Ctrl+D")
    sketch.choose("Start here")
    expect(sketch.thing("state", "Go")).to_have_attribute("aria-label", re.compile("initial"))
    sketch.expect_undone()
    sketch.click(sketch.state("Go"), right=True)
    sketch.choose("Final")
    expect(sketch.thing("state", "Go")).to_have_attribute("aria-label", re.compile("final"))
    sketch.expect_undone()


def test_each_kind_of_thing_has_its_menu(sketch: EditorDriver) -> None:
    for spot, entry in (
        (middle(sketch.page.locator('g.chip[data-id="Start/1"]')), "Edit the guard"),
        (sketch.at("components", "walk"), "Open its design"),
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
    expect(sketch.thing("state", "Stop")).to_have_count(0)
    sketch.expect_undone()


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


def test_what_was_made_by_the_menu_stands_where_it_was_opened(sketch: EditorDriver) -> None:
    spot = sketch.empty()
    sketch.click(spot, right=True)
    sketch.choose("New state")
    sketch.rename_to("Wait")
    x, y = sketch.state("Wait")
    assert abs(x - spot[0]) + abs(y - spot[1]) < 20
    sketch.expect_undone(2)


def test_the_help_lists_every_key(sketch: EditorDriver) -> None:
    sketch.page.locator(".stage").last.focus()
    sketch.press("?")
    help_ = sketch.page.locator(".help")
    for words in ("Ctrl+D", "Duplicate", "Ctrl+S", "Drag a label", "Shift+F10"):
        expect(help_.get_by_text(words, exact=True).first).to_be_visible()
    sketch.press("Escape")
    expect(help_).to_have_count(0)


def test_keys_work_from_the_first_moment_and_when_nothing_has_the_focus(sketch: EditorDriver) -> None:
    expect(sketch.page.locator(".stage").last).to_be_focused()
    sketch.press("Tab")
    sketch.expect_selection("states/Start")
    sketch.page.evaluate("document.activeElement.blur()")
    sketch.press("Control+ArrowRight")
    sketch.expect_selection("states/Go")
    sketch.press("Control+Shift+ArrowDown")
    sketch.expect_selection("states/Go", "states/Stop")
    sketch.press("d")
    expect(sketch.thing("state", "Stop")).to_have_class(re.compile("disabled"))
    sketch.expect_undone()


def test_new_states_by_keys_find_a_free_place(sketch: EditorDriver) -> None:
    for name in ("One", "Two"):
        sketch.press("s")
        sketch.rename_to(name)
    (x1, y1), (x2, y2) = sketch.position("states/One"), sketch.position("states/Two")
    assert abs(x1 - x2) >= 120 or abs(y1 - y2) >= 60
    sketch.expect_undone(4)


def test_a_component_is_used_by_keys_and_by_dragging_its_design(sketch: EditorDriver) -> None:
    sketch.press("u")
    field = sketch.page.get_by_label("Component", exact=True)
    expect(field).to_be_focused()
    field.fill("searchb")
    expect(sketch.page.locator(".choice")).to_have_count(1)
    field.press("Enter")
    expect(sketch.thing("component", "search_ball")).to_be_visible()
    sketch.expect_selection("components/search_ball")
    expect(sketch.page.locator(".stage").last).to_be_focused()
    sketch.expect_undone()
    link = sketch.page.get_by_role("link", name="SearchNet")
    link.drag_to(sketch.page.locator(".vicode-canvas"), target_position={"x": 500, "y": 80})
    expect(sketch.thing("component", "search_net")).to_be_visible()
    sketch.expect_selection("components/search_net")
    sketch.expect_undone()


def test_escape_leads_from_a_field_back_to_the_drawing(sketch: EditorDriver) -> None:
    sketch.click(middle(sketch.page.locator('g.chip[data-id="Start/1"]')))
    sketch.press("Enter")
    expect(sketch.page.get_by_label("When", exact=True)).to_be_focused()
    after = sketch.page.get_by_label("After, seconds in this state")
    after.fill("5")
    expect(sketch.arrow("Start/1")).to_have_attribute("aria-label", re.compile("5 s"))
    sketch.press("Escape")
    expect(sketch.page.locator(".stage").last).to_be_focused()
    sketch.expect_selection("transitions/Start/1")
    sketch.expect_undone()
