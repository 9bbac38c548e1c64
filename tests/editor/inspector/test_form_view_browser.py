"""One types into the form of a transition at once, at any speed and latency; nothing goes elsewhere."""

from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import label, open_player, save, select_transition
from tests.editor.slow_connection import SlowConnection

LOOK = "LookForBall/0"


def guard(page: Page) -> Locator:
    return page.get_by_label("When", exact=True)


@pytest.mark.parametrize("key_ms", [0, 30, 120])
def test_what_is_typed_after_a_double_click_is_the_guard(
    editor: str, page: Page, project: Path, line: SlowConnection, key_ms: int
) -> None:
    # D, I and N would disable a transition, set the initial state and add a transition.
    text = "not perception.ball_seen and din < 3"
    open_player(page, editor)
    # The browser has the forms.
    select_transition(page, "Kick/0")
    before = (project / "forward" / "player.yaml").read_text()
    line.hold()
    label(page, LOOK).dblclick()
    page.keyboard.press("Control+a")
    page.keyboard.type(text, delay=key_ms)
    expect(page.locator("input.guard-field")).to_have_value(text)
    line.release()
    saved = save(page, project / "forward" / "player.yaml")
    assert saved == before.replace(
        "{to: FollowBall, when: perception.ball_seen, doc: ball seen}",
        f"{{to: FollowBall, when: {text}, doc: ball seen}}",
    )


def test_tab_leads_through_the_form_and_letters_stay_in_it(
    editor: str, page: Page, project: Path, line: SlowConnection
) -> None:
    open_player(page, editor)
    select_transition(page, LOOK)
    line.hold()
    guard(page).click()
    page.keyboard.press("Control+a")
    page.keyboard.type("True")
    page.keyboard.press("Tab")
    page.keyboard.type("2")
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    page.keyboard.press("Control+a")
    page.keyboard.type("din")
    line.release()
    saved = save(page, project / "forward" / "player.yaml")
    assert "{to: FollowBall, when: 'True', after: 2, doc: din}" in saved.replace('"True"', "'True'").replace(
        "when: True", "when: 'True'"
    )


def test_the_key_that_saves_takes_the_last_letters(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    select_transition(page, LOOK)
    for count in range(5):
        guard(page).click()
        page.keyboard.press("Control+a")
        page.keyboard.type(f"perception.ball_seen and state_time > {count}")
        assert f"when: perception.ball_seen and state_time > {count}," in save(
            page, project / "forward" / "player.yaml"
        )


@pytest.mark.parametrize(
    ("typed", "guarded"),
    [
        ("after 20 s", "after: 20"),
        ("perception.ball_seen after 500 ms", "when: perception.ball_seen, after: 0.5"),
        ("perception.ball_seen or after 2 s", "when: perception.ball_seen or after 2 s"),
    ],
)
def test_a_time_typed_into_the_guard_becomes_the_time(
    editor: str, page: Page, project: Path, typed: str, guarded: str
) -> None:
    open_player(page, editor)
    select_transition(page, LOOK)
    guard(page).click()
    page.keyboard.press("Control+a")
    page.keyboard.type(typed)
    # While one types, the text stays in the field.
    expect(guard(page)).to_have_text(typed)
    page.keyboard.press("Enter")
    time = page.get_by_label("After (seconds in this state)")
    if "after:" in guarded:
        expect(time).to_have_value(guarded.partition("after: ")[2])
        expect(guard(page)).not_to_contain_text("after")
        expect(guard(page)).not_to_contain_text("always")
    else:
        expect(time).to_have_value("")
        expect(page.get_by_label("Inspector").locator(".field-message.error")).to_be_visible()
    assert f"{{to: FollowBall, {guarded}, doc: ball seen}}" in save(page, project / "forward" / "player.yaml")


def test_two_people_in_one_field_get_both_edits(editor: str, page: Page, other: Page) -> None:
    for each in (page, other):
        open_player(each, editor)
        select_transition(each, LOOK)
    field, theirs = (each.get_by_role("textbox", name="Description") for each in (page, other))
    field.fill("OLD TEXT")
    expect(theirs).to_have_value("OLD TEXT")
    theirs.press("End")
    field.press("Control+a")
    page.keyboard.type("NEW")
    other.keyboard.type("!!")
    for each in (field, theirs):
        expect(each).to_have_value("NEW!!")


def test_the_cursor_stays_between_its_letters_while_others_type(editor: str, page: Page, other: Page) -> None:
    for each in (page, other):
        open_player(each, editor)
        select_transition(each, LOOK)
    field, theirs = (each.get_by_role("textbox", name="Description") for each in (page, other))
    field.fill("the ball")
    expect(theirs).to_have_value("the ball")
    field.press("End")
    theirs.press("Home")
    other.keyboard.type("see ")
    expect(field).to_have_value("see the ball")
    page.keyboard.type(" roll")
    for each in (field, theirs):
        expect(each).to_have_value("see the ball roll")
