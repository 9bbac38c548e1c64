"""Another design is shown in the same page: without a load, with its URL and title, and ready for keys."""

import re

from playwright.sync_api import Page, expect

from tests.editor.player_page import open_player, select_state, state

STAGE = 'document.querySelector(".vicode-canvas").shadowRoot.querySelector(".stage")'


def link(page: Page, name: str) -> None:
    page.get_by_role("navigation", name="Designs").get_by_role("link", name=name, exact=True).click()


def test_designs_are_switched_without_a_load(editor: str, page: Page) -> None:
    open_player(page, editor)
    page.evaluate("window.marker = 'kept'")
    select_state(page, "Kick")
    here = page.get_by_role("navigation", name="Designs").locator('[aria-current="page"]')

    link(page, "SearchNet")
    expect(state(page, "OtherSide")).to_be_visible()
    expect(state(page, "Kick")).to_have_count(0)
    expect(page).to_have_url(re.compile(r"/SearchNet$"))
    expect(page).to_have_title("SearchNet – vicode")
    expect(here).to_have_text("SearchNet")
    expect(page.get_by_label("Inspector").locator(".panel-title")).to_contain_text("SearchNet")
    select_state(page, "OtherSide")

    page.go_back()
    # The selection is that of the URL, as it was left.
    expect(page).to_have_url(re.compile(r"/Player\?select=Kick$"))
    expect(page.get_by_label("State", exact=True)).to_have_value("Kick")
    expect(page).to_have_title("Player – vicode")
    page.go_forward()
    expect(page).to_have_url(re.compile(r"/SearchNet\?select=OtherSide$"))
    expect(page.get_by_label("State", exact=True)).to_have_value("OtherSide")
    assert page.evaluate("window.marker") == "kept"


def test_keys_pressed_during_the_switch_are_for_the_new_design(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    # In one task, before the server can answer: Delete would remove the state that is still selected here.
    page.evaluate(
        """() => {
          document.querySelector('.design-link[href$="/SearchNet"]').click();
          for (const key of ["Delete", "s", "N", "e", "w", "Enter"]) {
            document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
          }
        }"""
    )
    expect(state(page, "New")).to_be_visible()
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    # The canvas has the focus: further keys need no click.
    page.keyboard.press("Control+z")
    expect(state(page, "New")).to_have_count(0)
    page.go_back()
    expect(state(page, "Kick")).to_be_visible()
    expect(page.get_by_text("Saved", exact=True)).to_be_visible()


def test_edits_and_their_undo_stay_with_their_design(editor: str, page: Page, other: Page) -> None:
    open_player(page, editor)
    description = page.get_by_role("textbox", name="Description", exact=True).first
    description.fill("Plays in front.")
    # Sent with the switch: the pause in which a field collects what is typed is not over.
    link(page, "Turn")
    expect(page.get_by_label("Inspector").locator(".panel-title")).to_contain_text("Turn")
    expect(page.get_by_role("button", name="Undo", exact=True)).to_be_disabled()
    player = page.get_by_role("navigation", name="Designs").get_by_role("link", name="Player")
    expect(player).to_have_accessible_name("Player, unsaved")
    other.goto(editor + "design/forward/Turn")
    people = page.get_by_role("group", name="Connected users")
    expect(people.get_by_role("img")).to_have_count(1)
    player.click()
    expect(description).to_have_value("Plays in front.")
    expect(people.get_by_role("img")).to_have_count(0)
    expect(other.get_by_role("group", name="Connected users").get_by_role("img")).to_have_count(0)
    page.get_by_role("button", name="Undo", exact=True).click()
    expect(player).to_have_accessible_name("Player")
