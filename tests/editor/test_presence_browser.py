"""Two people on one design, each in a browser of their own: seen by the other, never undone by the other."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.editor.player_page import create_state, open_player, select_state, select_transition, state

expect.set_options(timeout=20_000)


def take_name(page: Page, name: str) -> None:
    page.get_by_role("button", name="Change your name").click()
    page.get_by_role("dialog").get_by_label("Name").fill(name)
    page.get_by_role("button", name="Change name").click()
    expect(page.get_by_role("button", name=f"You are {name}")).to_be_visible()


def test_people_see_each_other(editor: str, page: Page, other: Page) -> None:
    open_player(page, editor)
    # Who is asked for a name goes on writing it while somebody comes.
    page.get_by_role("button", name="Change your name").click()
    page.get_by_role("dialog").get_by_label("Name").fill("Ada")
    open_player(other, editor)
    expect(page.get_by_role("img", name="Guest 2")).to_be_visible()
    expect(page.get_by_role("dialog").get_by_label("Name")).to_have_value("Ada")
    page.get_by_role("button", name="Cancel").click()
    expect(page.get_by_role("dialog")).to_have_count(0)
    take_name(other, "Ben <b>")
    expect(page.get_by_role("img", name="Ben <b>")).to_be_visible()

    # What the other selects is outlined, with the name beside it; what is typed into is said at the field.
    select_state(other, "Kick")
    expect(page.locator('.outline[data-at="s:Kick"]')).to_be_visible()
    expect(page.locator(".tag").get_by_text("Ben <b>")).to_be_visible()
    expect(page.get_by_role("img", name="Ben <b>: state Kick")).to_be_visible()
    select_state(page, "Kick")
    other.get_by_role("textbox", name="Description").click()
    expect(page.get_by_text("Ben <b> is also typing here")).to_be_visible()
    other.get_by_role("textbox", name="Description").blur()
    expect(page.get_by_text("is also typing here")).to_have_count(0)

    # Pointers are shown while they are over the drawing.
    other.mouse.move(700, 300)
    other.mouse.move(720, 310)
    expect(page.locator(".pointer").get_by_text("Ben <b>")).to_be_visible()

    # A chosen name outlives a reload; who leaves is gone.
    other.reload()
    expect(other.get_by_role("button", name="You are Ben <b>")).to_be_visible()
    other.goto("about:blank")
    expect(page.get_by_role("img", name="Ben <b>")).to_have_count(0)
    expect(page.locator(".outline")).to_have_count(0)


def test_a_browser_is_one_person(editor: str, page: Page, second_window: Page) -> None:
    open_player(page, editor)
    # Another program at this host sets the cookie of its sessions, which has the same name.
    page.context.add_cookies([{"name": "session", "value": "another", "url": editor}])
    open_player(second_window, editor)
    create_state(second_window, "Pause")
    expect(state(page, "Pause")).to_be_visible()
    page.get_by_role("button", name="Undo").click()
    expect(state(second_window, "Pause")).to_have_count(0)
    expect(page.get_by_role("group", name="Connected users").locator(".person")).to_have_count(1)


def test_windows_that_open_together_are_one_person(editor: str, page: Page, second_window: Page) -> None:
    open_player(page, editor)
    # The request of the second window is sent before the first one has an id.
    cookie = next(each for each in page.context.cookies() if each.get("name") == "vicode_browser")
    page.context.clear_cookies()
    second_window.add_init_script(f"document.cookie = 'vicode_browser={cookie.get('value')}; path=/'")
    open_player(second_window, editor)
    create_state(second_window, "Pause")
    expect(state(page, "Pause")).to_be_visible()
    page.get_by_role("button", name="Undo").click()
    expect(state(second_window, "Pause")).to_have_count(0)


def test_undo_takes_back_ones_own_work_only(editor: str, page: Page, other: Page) -> None:
    open_player(page, editor)
    open_player(other, editor)
    take_name(other, "Ben")
    create_state(page, "Pause")
    expect(state(other, "Pause")).to_be_visible()
    expect(other.get_by_role("button", name="Undo")).to_be_disabled()
    select_state(other, "LookForBall")
    other.get_by_role("textbox", name="Description").fill("theirs")
    other.get_by_role("textbox", name="Description").blur()
    expect(page.locator('.outline[data-at="s:LookForBall"]')).to_be_visible()
    select_state(page, "LookForBall")
    expect(page.get_by_role("textbox", name="Description")).to_have_value("theirs")

    # Ben's edit came last: this undo takes the state out below it.
    page.get_by_role("button", name="Undo").click()
    expect(state(other, "Pause")).to_have_count(0)
    expect(page.get_by_role("textbox", name="Description")).to_have_value("theirs")
    page.get_by_role("button", name="Redo").click()
    expect(state(other, "Pause")).to_be_visible()

    # What Ben changed since is not undone, and it is said.
    page.get_by_role("textbox", name="Description").fill("mine")
    page.get_by_role("textbox", name="Description").blur()
    expect(other.get_by_role("textbox", name="Description")).to_have_value("mine")
    other.get_by_role("textbox", name="Description").fill("changed again")
    other.get_by_role("textbox", name="Description").blur()
    expect(page.get_by_role("textbox", name="Description")).to_have_value("changed again")
    page.get_by_role("button", name="Undo").click()
    expect(page.get_by_text("Ben has since changed description of state LookForBall")).to_be_visible()
    expect(page.get_by_role("textbox", name="Description")).to_have_value("changed again")


def test_two_people_type_into_one_field(editor: str, page: Page, other: Page) -> None:
    open_player(page, editor)
    open_player(other, editor)
    for each in (page, other):
        select_state(each, "Kick")
    page.get_by_role("textbox", name="Description").fill("kick the ball")
    page.get_by_role("textbox", name="Description").blur()
    expect(other.get_by_role("textbox", name="Description")).to_have_value("kick the ball")

    mine, theirs = page.get_by_role("textbox", name="Description"), other.get_by_role("textbox", name="Description")
    mine.click()
    mine.press("End")
    theirs.click()
    theirs.press("Home")
    for here, there in zip(" hard", "then ", strict=True):
        mine.press_sequentially(here)
        theirs.press_sequentially(there)
    # So slowly that each letter is sent by itself, after what the other one typed.
    theirs.press_sequentially("we ", delay=300)
    for each in (mine, theirs):
        expect(each).to_have_value("then we kick the ball hard")
        expect(each).to_be_focused()


@pytest.mark.nightly
def test_typing_goes_on_while_the_form_around_it_changes(editor: str, page: Page, other: Page) -> None:
    open_player(page, editor)
    open_player(other, editor)
    select_state(page, "Kick")
    field = page.get_by_role("textbox", name="Description")
    field.fill("first")
    create_state(other, "Pause")
    expect(state(page, "Pause")).to_be_visible()
    expect(field).to_be_focused()
    field.press_sequentially(" and second")
    field.blur()
    expect(field).to_have_value("first and second")
    other.get_by_text("Kick", exact=True).first.click()
    expect(other.get_by_role("textbox", name="Description")).to_have_value("first and second")


@pytest.mark.nightly
def test_a_selection_follows_what_others_rename(editor: str, page: Page, other: Page) -> None:
    open_player(page, editor)
    open_player(other, editor)
    select_state(page, "Kick")
    select_state(other, "Kick")
    other.get_by_label("State", exact=True).fill("Shoot")
    other.get_by_label("State", exact=True).press("Enter")
    expect(page.get_by_label("State", exact=True)).to_have_value("Shoot")


def test_a_name_being_typed_on_the_drawing_outlives_what_others_call_it(editor: str, page: Page, other: Page) -> None:
    open_player(page, editor)
    open_player(other, editor)
    select_state(page, "Kick")
    select_state(other, "Kick")
    page.locator("main.design-view .stage").focus()
    page.keyboard.press("F2")
    box = page.locator("input.rename")
    expect(box).to_be_focused()
    page.keyboard.type("Strike")
    other.get_by_label("State", exact=True).fill("Shoot")
    other.get_by_label("State", exact=True).press("Enter")
    expect(
        page.get_by_text("Kick was renamed to Shoot by another user; your text will rename it again")
    ).to_be_visible()
    expect(box).to_be_focused()
    expect(box).to_have_value("Strike")
    page.keyboard.type("Hard")
    page.keyboard.press("Enter")
    expect(other.get_by_label("State", exact=True)).to_have_value("StrikeHard")


def test_a_wide_editor_stays_while_its_form_changes_until_its_state_is_gone(
    editor: str, page: Page, other: Page
) -> None:
    open_player(page, editor)
    open_player(other, editor)
    select_state(page, "WatchBall")
    page.get_by_role("button", name=re.compile("^Enlarge: ")).first.click()
    wide = page.get_by_role("dialog").locator(".cm-content")
    wide.click()
    page.keyboard.press("Control+End")
    page.keyboard.type(" or first")
    select_transition(other, "WatchBall/0")
    other.get_by_role("checkbox", name="Disabled").click()
    expect(page.locator('g[data-kind="transition"][data-id="WatchBall/0"]').first).to_have_class(re.compile("disabled"))
    page.keyboard.type(" and second")
    expect(wide).to_contain_text("or first and second")
    select_state(other, "WatchBall")
    other.get_by_label("State", exact=True).fill("GoRound")
    other.get_by_label("State", exact=True).press("Enter")
    expect(state(page, "GoRound")).to_be_visible()
    page.keyboard.type(" or third")
    expect(wide).to_contain_text("or first and second or third")
    expect(other.get_by_label("Inspector").locator(".cm-content").first).to_contain_text("or third")
    other.locator("main.design-view .stage").focus()
    other.keyboard.press("Delete")
    expect(page.get_by_role("dialog")).to_have_count(0)
    expect(page.get_by_text("Another user removed what you were editing")).to_be_visible()
