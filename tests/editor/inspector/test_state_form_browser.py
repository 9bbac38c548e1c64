"""One types into the form of a state at once, at any speed and latency; nothing goes elsewhere or is dropped."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import (
    center_of,
    create_state,
    empty_corner,
    findings,
    open_player,
    save,
    select_state,
    state,
)
from tests.editor.slow_connection import SlowConnection

SPEEDS = pytest.mark.parametrize("key_ms", [0, 30, 120])
PAIRS = "parameter = expression, one per line"


def name_field(page: Page) -> Locator:
    return page.get_by_label("State", exact=True)


def card(page: Page, title: str) -> Locator:
    return page.locator(".card").filter(has=page.locator(".card-title", has_text=re.compile(f"^{title}$")))


def player_file(project: Path) -> Path:
    return project / "forward" / "player.yaml"


@SPEEDS
def test_what_is_typed_after_a_double_click_is_the_name(
    editor: str, page: Page, project: Path, line: SlowConnection, key_ms: int
) -> None:
    open_player(page, editor)
    before = player_file(project).read_text()
    line.hold()
    page.mouse.dblclick(*center_of(page, "Kick"))
    page.keyboard.type("Individual", delay=key_ms)
    page.keyboard.press("Enter")
    line.release()
    expect(name_field(page)).to_have_value("Individual")
    saved = save(page, player_file(project))
    assert re.sub(r"\bIndividual\b", "Kick", saved).replace("    id: Kick\n", "") == before


@SPEEDS
def test_what_is_typed_after_the_key_for_a_new_state_is_its_name(
    editor: str, page: Page, project: Path, line: SlowConnection, key_ms: int
) -> None:
    open_player(page, editor)
    page.mouse.click(*empty_corner(page))
    line.hold()
    page.keyboard.press("s")
    page.keyboard.type("Dinner", delay=key_ms)
    page.keyboard.press("Enter")
    line.release()
    expect(name_field(page)).to_have_value("Dinner")
    assert "  Dinner:" in save(page, player_file(project))


def test_a_state_that_is_renamed_meanwhile_is_the_source_of_the_new_transition(
    editor: str, page: Page, project: Path, line: SlowConnection
) -> None:
    open_player(page, editor)
    select_state(page, "GetUp")
    line.hold()
    name_field(page).fill("Rise")
    name_field(page).press("Enter")
    page.locator("main.design-view .stage").focus()
    page.keyboard.press("n")
    page.keyboard.type("Dinner")
    line.release()
    expect(state(page, "Rise")).to_be_visible()
    # The name, and a guard that stays empty.
    page.keyboard.press("Enter")
    page.keyboard.press("Enter")
    expect(state(page, "Dinner")).to_be_visible()
    text = save(page, player_file(project))
    assert "to: Dinner" in text[text.index("  Rise:") : text.index("  Dinner:")]


@SPEEDS
def test_the_form_of_another_state_is_typed_into_at_once(
    editor: str, page: Page, project: Path, line: SlowConnection, key_ms: int
) -> None:
    open_player(page, editor)
    select_state(page, "GetUp")
    line.hold()
    state(page, "Kick").click()
    expect(name_field(page)).to_have_value("Kick")
    name_field(page).click()
    page.keyboard.press("Control+a")
    page.keyboard.type("Dinner", delay=key_ms)
    page.keyboard.press("Tab")
    page.keyboard.press("Control+a")
    page.keyboard.type("dine in", delay=key_ms)
    page.get_by_role("checkbox", name="Final").click()
    state(page, "GetUp").click()
    expect(name_field(page)).to_have_value("GetUp")
    line.release()
    expect(state(page, "Dinner")).to_be_visible()
    text = save(page, player_file(project))
    changed = text[text.index("  Dinner:") :]
    assert "doc: dine in\n" in changed
    assert "final: true\n" in changed
    assert "to: Dinner" in text
    assert "Kick:" not in text


@SPEEDS
def test_a_new_action_is_typed_into_at_once(
    editor: str, page: Page, project: Path, line: SlowConnection, key_ms: int
) -> None:
    open_player(page, editor)
    select_state(page, "GetUp")
    line.hold()
    add = page.get_by_label("Inspector").get_by_role("button", name="Add to actions: Set")
    add.click()
    # The text of the new card is selected: typing replaces it.
    page.keyboard.type("side = Side.left", delay=key_ms)
    page.get_by_label("Inspector").get_by_role("button", name="Add to actions: Code").click()
    page.keyboard.type("self.done = 1", delay=key_ms)
    expect(card(page, "Set").locator(".cm-content")).to_have_text("side = Side.left")
    line.release()
    text = save(page, player_file(project))
    changed = text[text.index("  GetUp:") :]
    assert "    actions:\n      - set: {side: Side.left}\n      - code: self.done = 1\n" in changed


def test_a_component_is_modulated_and_its_parameters_typed_at_once(
    editor: str, page: Page, project: Path, line: SlowConnection
) -> None:
    open_player(page, editor)
    select_state(page, "GetUp")
    line.hold()
    page.get_by_label("Inspector").get_by_role("button", name="Add to modulates: Component").click()
    page.get_by_role("menuitem", name="follow_ball").click()
    expect(card(page, "follow_ball").locator(".cm-content")).to_be_focused()
    page.keyboard.type("speed = 90")
    line.release()
    assert "follow_ball: {speed: 90}" in save(page, player_file(project))
    expect(card(page, "follow_ball").locator(".cm-content")).to_have_text("speed = 90")


@pytest.mark.parametrize("text", ["= 0.7", "speed 0.7"])
def test_a_parameter_that_cannot_be_read_stays_in_sight_and_the_old_value_in_the_file(
    editor: str, page: Page, project: Path, text: str
) -> None:
    open_player(page, editor)
    before = player_file(project).read_text()
    select_state(page, "FollowBall")
    field = card(page, "follow_ball").locator(".cm-content")
    field.click()
    page.keyboard.press("Control+a")
    page.keyboard.type(text)
    page.get_by_role("textbox", name="Description").click()
    expect(card(page, "follow_ball").locator(".field-finding")).to_have_text(re.compile("^Write "))
    page.keyboard.press("End")
    page.keyboard.type(" Quick.")
    saved = save(page, player_file(project))
    assert saved == before.replace(
        "doc: Walk to the ball with the eyes on it.", "doc: Walk to the ball with the eyes on it. Quick."
    )
    # It is still there after a look at another state, and can be corrected.
    select_state(page, "Kick")
    select_state(page, "FollowBall")
    expect(field).to_have_text(text)
    field.click()
    page.keyboard.press("Control+a")
    page.keyboard.type("speed = 0.7")
    expect(card(page, "follow_ball").locator(".field-finding")).to_have_count(0)
    assert "follow_ball: {speed: 0.7}" in save(page, player_file(project))


def test_a_name_that_is_taken_stays_in_sight_with_the_reason(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    name_field(page).fill("GetUp")
    name_field(page).press("Enter")
    expect(page.get_by_label("Inspector").get_by_text("there is already a state GetUp", exact=False)).to_be_visible()
    expect(name_field(page)).to_have_value("GetUp")
    name_field(page).press("End")
    page.keyboard.type("Again")
    page.keyboard.press("Enter")
    expect(state(page, "GetUpAgain")).to_be_visible()
    assert "  GetUpAgain:" in save(page, player_file(project))


def test_a_name_being_typed_outlives_what_others_call_the_state(editor: str, page: Page, other: Page) -> None:
    for each in (page, other):
        open_player(each, editor)
        select_state(each, "Kick")
    name_field(page).click()
    page.keyboard.press("End")
    page.keyboard.type("Hard")
    name_field(other).fill("Shoot")
    name_field(other).press("Enter")
    expect(page.get_by_text("Another user renamed it to Shoot. Press Enter to use your name instead.")).to_be_visible()
    expect(name_field(page)).to_have_value("KickHard")
    page.keyboard.press("Enter")
    expect(name_field(other)).to_have_value("KickHard")


def test_a_section_with_a_value_opens_by_itself(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    more = page.get_by_label("Inspector").get_by_role("button", name="More")
    expect(page.get_by_role("checkbox", name="Disabled")).to_have_count(0)
    more.click()
    page.get_by_role("button", name="Color red").click()
    expect(page.get_by_role("button", name="Color red")).to_have_attribute("aria-pressed", "true")
    more.click()
    expect(page.get_by_role("checkbox", name="Disabled")).to_have_count(0)
    open_player(page, editor)
    select_state(page, "Kick")
    expect(page.get_by_role("checkbox", name="Disabled")).to_be_visible()
    select_state(page, "GetUp")
    expect(page.get_by_role("checkbox", name="Disabled")).to_have_count(0)


def test_a_requirement_is_chosen_and_removed(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    requires = page.locator('[data-path="requires"]')
    requires.get_by_role("combobox").click()
    page.get_by_role("option", name="walk").click()
    page.keyboard.press("Escape")
    expect(requires.locator(".q-chip")).to_have_text([re.compile("^perception"), re.compile("^walk")])
    text = save(page, player_file(project))
    assert "requires: [perception, walk]" in text[text.index("  Kick:") :]


def test_findings_stand_at_the_fields_of_the_form(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_state(page, "FollowBall")
    field = card(page, "follow_ball").locator(".cm-content")
    field.click()
    page.keyboard.press("Control+a")
    page.keyboard.type("speed = 1\nheight = 2")
    message = card(page, "follow_ball").get_by_role("button", name="has no parameter 'height'")
    expect(message).to_be_visible()
    expect(page.locator(".squiggle.error")).to_have_text("height")
    # From the list of findings to the form.
    select_state(page, "Kick")
    findings(page).get_by_text("has no parameter 'height'").click()
    expect(name_field(page)).to_have_value("FollowBall")
    expect(message).to_be_visible()


def test_a_state_that_is_created_is_edited_by_keys(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    create_state(page, "Celebrate")
    expect(name_field(page)).to_have_value("Celebrate")
    page.get_by_role("textbox", name="Description").fill("Dance.")
    page.get_by_role("checkbox", name="Initial").click()
    text = save(page, player_file(project))
    assert "initial: Celebrate\n" in text
    assert "doc: Dance." in text[text.index("  Celebrate:") :]
