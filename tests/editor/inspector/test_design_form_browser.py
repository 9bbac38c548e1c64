"""One types into the form of the design at once, at any speed and latency; nothing goes elsewhere or is dropped."""

from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import empty_corner, open_player, save, select_state, state
from tests.editor.slow_connection import SlowConnection

SPEEDS = pytest.mark.parametrize("key_ms", [0, 30, 120])


def open_design_form(page: Page, url: str) -> None:
    open_player(page, url)
    expect(page.get_by_label("Initial state")).to_be_visible()


def declared(page: Page, group: str) -> Locator:
    return page.get_by_role("group", name=group, exact=True)


def name_of(page: Page, group: str) -> Locator:
    return declared(page, group).get_by_role("textbox", name="Name", exact=True)


def player_file(project: Path) -> Path:
    return project / "forward" / "player.yaml"


@SPEEDS
def test_a_new_variable_is_named_and_filled_in_at_once(
    editor: str, page: Page, project: Path, line: SlowConnection, key_ms: int
) -> None:
    open_design_form(page, editor)
    line.hold()
    page.get_by_role("button", name="Add variable").click()
    # D, I, F, M, N and S are commands of the canvas.
    page.keyboard.type("find_mid", delay=key_ms)
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    page.keyboard.press("Control+a")
    page.keyboard.type("3", delay=key_ms)
    page.keyboard.press("Tab")
    page.keyboard.type("mm", delay=key_ms)
    page.keyboard.press("Tab")
    page.keyboard.type("distance in mm", delay=key_ms)
    page.get_by_role("button", name="Add variable").click()
    page.keyboard.type("served", delay=key_ms)
    page.keyboard.press("Enter")
    line.release()
    expect(name_of(page, "variable served")).to_have_value("served")
    expect(declared(page, "variable find_mid")).to_be_visible()
    saved = save(page, player_file(project))
    assert "find_mid: {initial: 3, unit: mm, doc: distance in mm}" in saved
    assert "served: {initial: 0}" in saved or "served: 0" in saved or "served:\n    initial: 0" in saved
    expect(page.locator('g[data-kind="state"].disabled')).to_have_count(0)


@SPEEDS
def test_the_fields_of_the_design_are_typed_into_while_the_server_is_silent(
    editor: str, page: Page, project: Path, line: SlowConnection, key_ms: int
) -> None:
    open_design_form(page, editor)
    select_state(page, "Kick")
    line.hold()
    page.mouse.click(*empty_corner(page))
    doc = page.get_by_role("textbox", name="Description").first
    doc.click()
    page.keyboard.press("Control+a")
    page.keyboard.type("Finds, dribbles, shoots.", delay=key_ms)
    page.get_by_label("Frequency, Hz").click()
    page.keyboard.press("Control+a")
    page.keyboard.type("25", delay=key_ms)
    page.get_by_role("checkbox", name="Resume where it left off").click()
    unit = declared(page, "variable side").get_by_label("Unit")
    unit.click()
    page.keyboard.type("legs", delay=key_ms)
    line.release()
    expect(doc).to_have_value("Finds, dribbles, shoots.")
    saved = save(page, player_file(project))
    assert "Finds, dribbles, shoots.\n" in saved
    assert "frequency: 25\n" in saved
    assert "resume: true\n" in saved
    assert "unit: legs" in saved


def test_a_value_that_cannot_be_read_stays_in_sight_and_the_old_one_in_the_file(
    editor: str, page: Page, project: Path
) -> None:
    open_design_form(page, editor)
    before = player_file(project).read_text()
    frequency = page.get_by_label("Frequency, Hz")
    frequency.fill("10 x")
    doc = page.get_by_role("textbox", name="Description").first
    doc.fill("Plays.")
    expect(page.locator('[data-path="frequency_hz"] .field-finding')).to_be_visible()
    expect(frequency).to_have_value("10 x")
    assert "frequency: 10\n" in before
    assert "frequency: 10\n" in save(page, player_file(project))
    # It is still there after a look at a state, and can be corrected.
    select_state(page, "Kick")
    page.mouse.click(*empty_corner(page))
    expect(frequency).to_have_value("10 x")
    frequency.fill("20")
    expect(page.locator('[data-path="frequency_hz"] .field-finding')).to_have_count(0)
    assert "frequency: 20\n" in save(page, player_file(project))


def test_a_name_that_is_taken_stays_in_sight_with_the_reason(editor: str, page: Page, project: Path) -> None:
    open_design_form(page, editor)
    page.get_by_role("button", name="Add variable").click()
    page.keyboard.type("side")
    page.keyboard.press("Tab")
    group = page.locator(".declaration").filter(has=page.get_by_text("there is already a variable side", exact=False))
    expect(group).to_have_attribute("aria-label", "variable variable")
    name = group.get_by_role("textbox", name="Name", exact=True)
    expect(name).to_have_value("side")
    name.click()
    page.keyboard.press("End")
    page.keyboard.type("ways")
    page.keyboard.press("Enter")
    expect(name_of(page, "variable sideways")).to_be_visible()
    assert "sideways:" in save(page, player_file(project))


def test_what_others_add_and_remove_moves_no_text(editor: str, page: Page, other: Page) -> None:
    for each in (page, other):
        open_design_form(each, editor)
    side = declared(page, "variable side").get_by_label("Unit")
    side.click()
    page.keyboard.type("le")
    other.get_by_role("button", name="Remove kick", exact=True).click()
    other.get_by_role("button", name="Add variable").click()
    expect(declared(page, "variable variable")).to_be_visible()
    page.keyboard.type("gs")
    expect(declared(other, "variable side").get_by_label("Unit")).to_have_value("legs")
    expect(side).to_be_focused()


def test_components_and_arguments_are_added_and_removed(editor: str, page: Page, project: Path) -> None:
    open_design_form(page, editor)
    page.get_by_role("button", name="Add Component").click()
    page.get_by_role("menuitem", name="Turn").click()
    expect(page.get_by_role("button", name="Remove turn")).to_be_visible()
    page.get_by_role("button", name="Remove walk").click()
    expect(page.get_by_role("button", name="Remove walk")).to_have_count(0)
    kicks = declared(page, "output kicks")
    kicks.get_by_role("button", name="More").click()
    kicks.get_by_role("button", name="Add Argument to kicks").click()
    page.keyboard.type("since")
    page.keyboard.press("Enter")
    expect(name_of(page, "argument since")).to_have_value("since")
    saved = save(page, player_file(project))
    assert "turn: Turn" in saved
    assert "walk: Walk" not in saved
    assert "since" in saved
    kicks.get_by_role("button", name="Remove arguments").click()
    expect(declared(page, "argument since")).to_have_count(0)


def test_the_code_of_the_design_is_written_in_its_section(editor: str, page: Page, project: Path) -> None:
    open_design_form(page, editor)
    page.get_by_label("Inspector").get_by_role("button", name="Code", exact=False).first.click()
    members = page.locator('[data-path="members/python"] .cm-content')
    members.click()
    page.keyboard.press("Control+End")
    page.keyboard.press("Enter")
    page.keyboard.type("DINNER = 1")
    state(page, "Kick").click()
    page.mouse.click(*empty_corner(page))
    expect(members).to_contain_text("DINNER = 1")
    assert "DINNER = 1" in save(page, player_file(project))
