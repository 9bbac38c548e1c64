"""One types into the forms of the project and of used components at once; nothing goes elsewhere or is dropped."""

from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import component as used
from tests.editor.player_page import open_player, save, select_state
from tests.editor.slow_connection import SlowConnection

SPEEDS = pytest.mark.parametrize("key_ms", [0, 30, 120])


def open_project(page: Page, url: str) -> Locator:
    open_player(page, url)
    inspector = page.get_by_label("Inspector")
    inspector.get_by_text("Project Forward").click()
    expect(inspector.get_by_role("group", name="enumeration Side", exact=True)).to_be_visible()
    return inspector


@SPEEDS
def test_a_new_constant_is_named_and_filled_in_at_once(
    editor: str, page: Page, project: Path, line: SlowConnection, key_ms: int
) -> None:
    file = project / "forward" / "project.yaml"
    inspector = open_project(page, editor)
    line.hold()
    inspector.get_by_role("button", name="Add Constant to the project").click()
    # D, I, F, M, N and S are commands of the canvas.
    page.keyboard.type("mid_dist", delay=key_ms)
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    page.keyboard.press("Control+a")
    page.keyboard.type("12", delay=key_ms)
    page.keyboard.press("Tab")
    page.keyboard.type("mm", delay=key_ms)
    page.keyboard.press("Tab")
    page.keyboard.type("in mid field", delay=key_ms)
    page.keyboard.press("Enter")
    line.release()
    constant = inspector.get_by_role("group", name="constant mid_dist", exact=True)
    expect(constant.get_by_label("Unit")).to_have_value("mm")
    expect(page.get_by_text("project.yaml saved: edit mid_dist")).to_be_visible()
    page.wait_for_function("() => !document.querySelector('.field-finding')")
    assert "mid_dist: {value: 12, unit: mm, doc: in mid field}" in file.read_text()
    expect(page.get_by_text("Unsaved changes")).to_have_count(0)


@SPEEDS
def test_the_alias_of_a_component_is_typed_at_once(
    editor: str, page: Page, project: Path, line: SlowConnection, key_ms: int
) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    line.hold()
    used(page, "perception").click()
    alias = page.get_by_label("Alias", exact=True)
    expect(alias).to_have_value("perception")
    alias.click()
    page.keyboard.press("Control+a")
    page.keyboard.type("find", delay=key_ms)
    page.keyboard.press("Enter")
    line.release()
    expect(used(page, "find")).to_be_visible()
    expect(alias).to_have_value("find")
    text = save(page, project / "forward" / "player.yaml")
    assert "find: {component: Perception" in text
    assert "when: find.ball_seen" in text
    assert "when: perception." not in text


def test_an_alias_that_is_taken_stays_in_sight_with_the_reason(editor: str, page: Page) -> None:
    open_player(page, editor)
    used(page, "walk").click()
    alias = page.get_by_label("Alias", exact=True)
    alias.fill("kicker")
    alias.press("Enter")
    expect(page.get_by_label("Inspector").get_by_text("already", exact=False)).to_be_visible()
    expect(alias).to_have_value("kicker")
    expect(used(page, "walk")).to_be_visible()


def test_a_new_parameter_of_a_component_opens_with_the_focus_in_its_name(
    editor: str, page: Page, project: Path, line: SlowConnection
) -> None:
    file = project / "forward" / "project.yaml"
    open_player(page, editor)
    used(page, "perception").click()
    inspector = page.get_by_label("Inspector")
    expect(inspector.get_by_role("group", name="component Perception", exact=True)).to_be_visible()
    line.hold()
    inspector.get_by_role("button", name="Add parameter").click()
    page.keyboard.type("noise")
    page.keyboard.press("Enter")
    line.release()
    # The class may say the name.
    page.get_by_role("dialog").get_by_role("button", name="Rename everywhere").click()
    expect(inspector.get_by_role("group", name="parameter noise", exact=True)).to_be_visible()
    assert "noise: {type: float}" in file.read_text() or "noise: float" in file.read_text()


def test_an_input_that_is_refused_stays_in_its_fields_with_the_reason(
    editor: str, page: Page, project: Path, line: SlowConnection
) -> None:
    file = project / "forward" / "project.yaml"
    before = file.read_text()
    open_player(page, editor)
    inspector = page.get_by_label("Inspector")
    name = inspector.get_by_label("New input")
    expect(name).to_be_visible()
    line.hold()
    name.fill("no name")
    page.keyboard.press("Enter")
    line.release()
    expect(inspector.get_by_text("use letters, digits and underscores")).to_be_visible()
    expect(name).to_have_value("no name")
    assert file.read_text() == before
    # It is still there after a look at a state, and can be corrected.
    select_state(page, "Kick")
    page.keyboard.press("Escape")
    page.locator("main.design-view .stage").focus()
    page.keyboard.press("Escape")
    expect(name).to_have_value("no name")
    name.fill("order")
    page.keyboard.press("Enter")
    expect(inspector.get_by_text("sensors.order")).to_be_visible()
    expect(name).to_have_value("")


def test_others_see_what_is_written_into_the_project(editor: str, page: Page, other: Page) -> None:
    mine, theirs = open_project(page, editor), open_project(other, editor)
    field = mine.get_by_role("group", name="constant net_x", exact=True).get_by_label("Unit")
    field.click()
    page.keyboard.type("x")
    theirs.get_by_role("group", name="enumeration Side", exact=True).get_by_label("Description").fill("Left or right.")
    other.keyboard.press("Tab")
    expect(mine.get_by_role("group", name="enumeration Side", exact=True).get_by_label("Description")).to_have_value(
        "Left or right."
    )
    expect(field).to_be_focused()
    page.keyboard.type("y")
    page.keyboard.press("Enter")
    expect(theirs.get_by_role("group", name="constant net_x", exact=True).get_by_label("Unit")).to_have_value("mmxy")
