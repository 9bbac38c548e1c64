"""What is typed or pressed in a form that the server has changed, before the browser has heard of it."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import open_player, save, select_state, state, wait_for_another
from tests.editor.slow_connection import SlowConnection

expect.set_options(timeout=20_000)


def rename_kick(page: Page, url: str, line: SlowConnection) -> None:
    """Begin to type into the doc of a state that was renamed, while the browser still shows the form before."""
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(url + "design/forward/Player?select=Kick")
    expect(page.get_by_label("State", exact=True)).to_have_value("Kick")
    expect(page.get_by_role("textbox", name="Description")).to_have_value("Kick, with the eyes on the ball.")
    line.hold()
    page.get_by_label("State", exact=True).fill("Shoot")
    page.keyboard.press("Tab")
    expect(page.get_by_role("textbox", name="Description")).to_be_focused()
    page.keyboard.press("End")
    page.keyboard.type(" Defend now.")


def doc_in(file: Path) -> str:
    return next(line for line in file.read_text().splitlines() if "Kick, with the eyes" in line).strip()


@pytest.mark.parametrize("way", ["to the next field", "to another panel", "saving"])
def test_what_was_left_before_the_new_form_came_is_kept(
    editor: str, page: Page, project: Path, line: SlowConnection, way: str
) -> None:
    rename_kick(page, editor, line)
    file = project / "forward" / "player.yaml"
    before = file.stat().st_ino
    match way:
        case "to the next field":
            page.keyboard.press("Tab")
        case "to another panel":
            page.get_by_role("tab", name="History").click()
        case _:
            page.keyboard.press("Control+s")
    line.release()
    expect(page.get_by_label("State", exact=True)).to_have_value("Shoot")
    expect(page.get_by_role("textbox", name="Description")).to_have_value(
        "Kick, with the eyes on the ball. Defend now."
    )
    if way == "saving":
        wait_for_another(page, file, before)
    else:
        save(page, file)
    assert doc_in(file).endswith("Defend now.")
    assert "  Shoot:" in file.read_text()


def test_who_stays_in_the_field_types_on_in_the_new_one(
    editor: str, page: Page, project: Path, line: SlowConnection
) -> None:
    rename_kick(page, editor, line)
    line.release()
    page.keyboard.type(" And then.")
    expect(page.get_by_role("textbox", name="Description")).to_have_value(
        "Kick, with the eyes on the ball. Defend now. And then."
    )
    expect(page.get_by_role("textbox", name="Description")).to_be_focused()
    expect(page.get_by_label("State", exact=True)).to_have_value("Shoot")
    file = project / "forward" / "player.yaml"
    save(page, file)
    assert doc_in(file).endswith("And then.")


def kick_hard(other: Page, url: str, name: str = "Shoot") -> Locator:
    """Another one's change of the same text, once the server has it; the field it stands in."""
    other.goto(f"{url}design/forward/Player?select={name}")
    doc = other.get_by_role("textbox", name="Description")
    expect(doc).to_have_value(re.compile("^Kick, with the eyes on the ball[.]"))
    doc.fill(doc.input_value().replace("Kick,", "Kick hard,"))
    doc.blur()
    # One's own edits can be undone: the server has it.
    expect(other.get_by_role("button", name="Undo")).to_be_enabled()
    return doc


def doc_of_kick(page: Page, url: str, line: SlowConnection) -> Locator:
    """The field of a doc that the window shows, from now on behind a slow line."""
    open_player(page, url)
    select_state(page, "Kick")
    doc = page.get_by_role("textbox", name="Description")
    expect(doc).to_have_value("Kick, with the eyes on the ball.")
    line.hold()
    return doc


def test_what_others_make_of_the_text_meanwhile_stays(
    editor: str, page: Page, other: Page, line: SlowConnection
) -> None:
    rename_kick(page, editor, line)
    doc = kick_hard(other, editor)
    line.release()
    page.keyboard.type(" And then.")
    for each in (page.get_by_role("textbox", name="Description"), doc):
        expect(each).to_have_value("Kick hard, with the eyes on the ball. Defend now. And then.")


def test_what_is_told_twice_is_in_the_text_once(editor: str, page: Page, other: Page, line: SlowConnection) -> None:
    rename_kick(page, editor, line)
    doc = kick_hard(other, editor)
    page.keyboard.press("Control+s")
    page.keyboard.type(" And then.")
    page.keyboard.press("Tab")
    line.release()
    both = "Kick hard, with the eyes on the ball. Defend now. And then."
    expect(doc).to_have_value(both)
    expect(page.get_by_role("textbox", name="Description")).to_have_value(both)


def test_what_is_typed_into_a_wide_editor_is_kept_when_its_state_is_renamed(
    editor: str, page: Page, other: Page, line: SlowConnection
) -> None:
    open_player(page, editor)
    select_state(page, "WatchBall")
    page.get_by_role("button", name=re.compile("^Enlarge: ")).first.click()
    page.get_by_role("dialog").locator(".cm-content").click()
    page.keyboard.type("first")
    open_player(other, editor)
    select_state(other, "WatchBall")
    code = other.get_by_label("Inspector").locator(".cm-content").first
    expect(code).to_contain_text("first")
    line.hold()
    name = other.get_by_label("State", exact=True)
    name.fill("GoRound")
    name.press("Enter")
    expect(state(other, "GoRound")).to_be_visible()
    page.keyboard.type(" and second")
    line.release()
    expect(page.get_by_label("State", exact=True)).to_have_value("GoRound")
    expect(code).to_contain_text("first and second")
    page.keyboard.type(" and third")
    expect(code).to_contain_text("first and second and third")
    expect(page.get_by_label("Inspector").locator(".cm-content").first).to_contain_text("first and second and third")


def test_what_is_typed_before_the_field_was_heard_of_is_not_written_over(
    editor: str, page: Page, other: Page, line: SlowConnection
) -> None:
    mine = doc_of_kick(page, editor, line)
    doc = kick_hard(other, editor, "Kick")
    mine.focus()
    page.keyboard.press("End")
    page.keyboard.type(" Defend now.")
    line.release()
    for each in (doc, mine):
        expect(each).to_have_value("Kick hard, with the eyes on the ball. Defend now.")
    page.keyboard.type(" And then.")
    mine.blur()
    both = "Kick hard, with the eyes on the ball. Defend now. And then."
    expect(doc).to_have_value(both)
    expect(mine).to_have_value(both)


def test_what_was_typed_and_taken_back_gives_way_to_what_came_meanwhile(
    editor: str, page: Page, other: Page, line: SlowConnection
) -> None:
    mine = doc_of_kick(page, editor, line)
    mine.focus()
    page.keyboard.press("End")
    kick_hard(other, editor, "Kick")
    page.keyboard.type("x")
    line.release()
    page.keyboard.press("Backspace")
    mine.blur()
    expect(mine).to_have_value("Kick hard, with the eyes on the ball.")


def final(page: Page) -> Locator:
    return page.get_by_role("checkbox", name="Final")


def test_a_press_that_comes_too_early_for_the_new_form_is_done_there(
    editor: str, page: Page, line: SlowConnection
) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    line.hold()
    state(page, "GetUp").click()
    final(page).click()
    line.release()
    expect(page.get_by_label("State", exact=True)).to_have_value("GetUp")
    expect(final(page)).to_be_checked()
    expect(state(page, "GetUp")).to_have_attribute("aria-label", "State GetUp, final, requires 1, modulates 1")
    select_state(page, "Kick")
    expect(final(page)).not_to_be_checked()


def test_several_presses_that_come_too_early_are_all_done(editor: str, page: Page, line: SlowConnection) -> None:
    open_player(page, editor)
    select_state(page, "GetUp")
    line.hold()
    for _ in range(3):
        page.get_by_role("button", name="Add Stay").click()
    line.release()
    expect(page.get_by_label("Inspector").get_by_text("stay", exact=True)).to_have_count(3)


def test_a_press_on_what_is_built_anew_before_the_hand_lets_go(editor: str, page: Page, line: SlowConnection) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    line.hold()
    state(page, "GetUp").click()
    final(page).hover()
    page.mouse.down()
    line.release()
    expect(page.get_by_label("State", exact=True)).to_have_value("GetUp")
    page.mouse.up()
    expect(final(page)).to_be_checked()


def test_a_press_on_what_moves_away_before_the_hand_lets_go(editor: str, page: Page, line: SlowConnection) -> None:
    open_player(page, editor)
    select_state(page, "GetUp")
    add = page.get_by_role("button", name="Add Stay")
    rows = page.get_by_label("Inspector").get_by_text("stay", exact=True)
    line.hold()
    add.click()
    add.hover()
    page.mouse.down()
    line.release()
    expect(rows).to_have_count(1)
    page.mouse.up()
    expect(rows).to_have_count(2)


def test_each_press_on_what_is_there_is_done_once(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    select_state(page, "GetUp")
    for _ in range(3):
        page.get_by_role("button", name="Add Stay").click()
    expect(page.get_by_label("Inspector").get_by_text("stay", exact=True)).to_have_count(3)
    assert save(page, project / "forward" / "player.yaml").count("stay: true") == 3


def test_a_connection_that_breaks_loses_no_key(editor: str, page: Page, project: Path, line: SlowConnection) -> None:
    """The letters, the new state and the command that saves wait for the next connection, in their order."""
    open_player(page, editor)
    select_state(page, "Kick")
    page.get_by_role("textbox", name="Description").press("Control+a")
    page.keyboard.type("Kick as hard", delay=20)
    line.cut()
    page.keyboard.type(" as you can", delay=20)
    page.keyboard.press("Escape")
    page.keyboard.press("s")
    page.keyboard.type("Defend")
    page.keyboard.press("Enter")
    page.keyboard.press("Control+s")
    file = project / "forward" / "player.yaml"
    for _attempt in range(600):
        if "\n  Defend:" in file.read_text():
            break
        page.wait_for_timeout(100)
    assert "doc: Kick as hard as you can\n" in file.read_text()
    assert "\n  Defend:" in file.read_text()
    expect(state(page, "Defend")).to_be_visible()
