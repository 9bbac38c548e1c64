"""Finding things and going there: the palette, links that select, double clicks, the way back."""

import re
from pathlib import Path

from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import component, open_player, save, select_state, state
from tests.editor.slow_connection import SlowConnection


def palette(page: Page) -> Locator:
    return page.get_by_role("dialog", name="Find anything")


def selected_option(page: Page) -> Locator:
    return palette(page).locator('[role="option"][aria-selected="true"]')


def open_palette(page: Page, query: str) -> None:
    """Press the keys and type; what is typed last decides what is found."""
    page.keyboard.press("Control+k")
    field = palette(page).get_by_role("combobox")
    expect(field).to_be_focused()
    page.keyboard.type(query)


def test_a_state_of_this_design_is_found_by_its_letters(editor: str, page: Page) -> None:
    open_player(page, editor)
    open_palette(page, "wb")
    expect(selected_option(page)).to_contain_text("WatchBall")
    page.keyboard.press("Enter")
    expect(palette(page)).to_be_hidden()
    expect(page.get_by_label("State", exact=True)).to_have_value("WatchBall")
    expect(page).to_have_url(re.compile(r"\?select=WatchBall$"))
    # A new design needs no mouse either.
    open_palette(page, "new design")
    expect(selected_option(page)).to_contain_text("New design")
    page.keyboard.press("Enter")
    expect(page.get_by_role("dialog", name="New design in Forward")).to_be_visible()


def test_keys_choose_among_what_is_found(editor: str, page: Page) -> None:
    open_player(page, editor)
    open_palette(page, "ball lost")
    field = palette(page).get_by_role("combobox")
    # The list of all that was typed: one of fewer letters may be shown before it.
    expect(palette(page).get_by_role("option")).to_have_count(4)
    expect(palette(page).get_by_role("option").nth(1)).to_contain_text("FollowBall → LookForBall")
    page.keyboard.press("ArrowDown")
    second = palette(page).get_by_role("option").nth(1)
    expect(second).to_have_attribute("aria-selected", "true")
    # The field keeps the focus and tells screen readers which option is meant.
    expect(field).to_be_focused()
    assert field.get_attribute("aria-activedescendant") == second.get_attribute("id")
    page.keyboard.press("ArrowUp")
    page.keyboard.press("ArrowUp")
    expect(palette(page).get_by_role("option").last).to_have_attribute("aria-selected", "true")
    page.keyboard.press("Escape")
    expect(palette(page)).to_be_hidden()
    expect(page).to_have_url(re.compile(r"Player$"))


def test_what_is_chosen_in_a_list_is_meant_though_a_newer_list_comes(
    editor: str, page: Page, line: SlowConnection
) -> None:
    open_player(page, editor)
    open_palette(page, "look")
    options = palette(page).get_by_role("option")
    expect(options).to_have_count(15)
    line.hold()
    page.keyboard.type("f")
    for _ in range(4):
        page.keyboard.press("ArrowDown")
    expect(selected_option(page)).to_contain_text("GetUp → LookForBall")
    line.release()
    expect(options).to_have_count(6)
    expect(options.nth(2)).to_have_attribute("aria-selected", "true")
    expect(options.nth(2)).to_contain_text("GetUp → LookForBall")

    line.hold()
    page.keyboard.press("Backspace")
    for _ in range(2):
        page.keyboard.press("ArrowDown")
    expect(selected_option(page)).to_contain_text("GetUp → LookForBall")
    page.keyboard.press("Enter")
    line.release()
    expect(page.get_by_role("heading", name="Transition from GetUp")).to_be_visible()


def test_what_is_found_in_another_design_is_opened_and_selected(editor: str, page: Page) -> None:
    open_player(page, editor)
    open_palette(page, "SearchNet OtherSide Complete 6 s")
    expect(selected_option(page)).to_contain_text("OtherSide → Complete")
    selected_option(page).click()
    expect(page).to_have_url(re.compile(r"/SearchNet\?select=OtherSide/1$"))
    expect(page.get_by_label("After (seconds in this state)")).to_have_value("6")


def test_commands_are_found_with_their_keys_and_done(editor: str, page: Page) -> None:
    open_player(page, editor)
    open_palette(page, "show or hide links")
    expect(selected_option(page)).to_contain_text("command")
    page.keyboard.press("Enter")
    expect(page.locator('g[data-kind="link"]')).to_have_count(0)
    open_palette(page, "save")
    expect(selected_option(page).locator("kbd")).to_have_text("Ctrl+S")


def test_nothing_found_is_said(editor: str, page: Page) -> None:
    open_player(page, editor)
    open_palette(page, "<img src=x onerror=alert(1)>")
    expect(palette(page).get_by_role("status")).to_contain_text("No results")
    expect(palette(page).get_by_role("option")).to_have_count(0)


def test_a_link_selects_and_shows_a_thing(editor: str, page: Page) -> None:
    page.goto(editor + "design/forward/Player?select=Kick")
    expect(page.get_by_label("State", exact=True)).to_have_value("Kick")
    expect(state(page, "Kick")).to_have_class(re.compile("selected"))
    page.goto(editor + "design/forward/Player?select=Nobody")
    expect(page.get_by_label("Description").first).to_be_visible()


def test_double_clicks_lead_down_and_crumbs_and_back_lead_up(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    component(page, "face_ball").dblclick()
    expect(page).to_have_url(re.compile(r"/FaceBall\?from=Player$"))
    way = page.get_by_role("navigation", name="Breadcrumb")
    expect(way).to_contain_text("Forward/Player/FaceBall")
    page.go_back()
    # The double click selected what was opened: that is what one comes back to.
    expect(page).to_have_url(re.compile(r"/Player\?select=components:face_ball$"))
    expect(component(page, "face_ball")).to_have_class(re.compile("selected"))
    page.go_forward()
    way.get_by_role("link", name="Player").click()
    expect(page).to_have_url(re.compile(r"/Player$"))
    expect(state(page, "Kick")).to_be_visible()


def test_back_shows_the_drawing_as_it_was_left(editor: str, page: Page) -> None:
    open_player(page, editor)
    view = 'document.querySelector(".vicode-canvas").vicode.view()'
    stage = page.locator("main.design-view").bounding_box()
    assert stage is not None
    page.mouse.move(stage["x"] + 200, stage["y"] + 200)
    page.keyboard.down("Control")
    page.mouse.wheel(0, -300)
    page.keyboard.up("Control")
    page.wait_for_function("history.state?.view?.k > 0.8")
    left = page.evaluate(view)
    page.get_by_role("link", name="Turn").click()
    expect(page).to_have_url(re.compile(r"/Turn$"))
    expect(page.locator('g[data-kind="state"]').first).to_be_visible()
    page.go_back()
    expect(page).to_have_url(re.compile(r"/Player$"))
    expect(state(page, "LookForBall")).to_be_visible()
    same = "left => { const now = %s; return [...'xyk'].every(key => now[key] === left[key]); }"
    page.wait_for_function(same % view, arg=left)


def test_a_line_typed_into_the_palette_is_created_as_one_edit(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    open_palette(page, "Kick -20 s-> Cheer -sensors.done after 500 ms-> LookForBall")
    offer = palette(page).get_by_role("option").first
    expect(offer).to_contain_text("Create Cheer and 2 transitions")
    page.keyboard.press("Enter")
    expect(state(page, "Cheer")).to_be_in_viewport()
    saved = save(page, project / "forward" / "player.yaml")
    assert "{to: Cheer, after: 20}" in saved
    assert "{to: LookForBall, when: sensors.done, after: 0.5}" in saved
    # The drawing has the focus again, and one step takes everything back.
    page.keyboard.press("Control+z")
    expect(state(page, "Cheer")).to_have_count(0)


def test_a_line_that_cannot_be_read_stays_in_the_palette_with_the_reason(editor: str, page: Page) -> None:
    open_player(page, editor)
    # Enter is pressed before the answer.
    open_palette(page, "Kick -distance <-> Cheer")
    page.keyboard.press("Enter")
    offer = palette(page).get_by_role("option").first
    expect(offer).to_contain_text("This line cannot be read")
    expect(offer).to_contain_text("'distance <' is not a guard")
    page.keyboard.press("Enter")
    expect(palette(page).get_by_role("combobox")).to_have_value("Kick -distance <-> Cheer")
    expect(palette(page)).to_be_visible()
    page.keyboard.press("Escape")
    expect(state(page, "Cheer")).to_have_count(0)
