"""What a person does: open, drag, add, connect, guard, undo, generate, save, reload; and two windows on one design."""

import re
from pathlib import Path
from typing import Literal

import pytest
from playwright.sync_api import Page, expect

from tests.editor.player_page import (
    PLAYER,
    Point,
    center_of,
    create_state,
    empty_corner,
    label,
    open_player,
    save,
    select_state,
    state,
)
from tests.editor.slow_connection import SlowConnection
from tests.editor.test_theme import contrast

# The page's socket seems to be open only when the test says so.
SPEAKS_LATE = """
let isOpen = false;
Object.defineProperty(window, "did_handshake", {
  get: () => isOpen && Boolean(window.maySpeak),
  set: (value) => { isOpen = value; },
});
"""


def drag(page: Page, start: Point, end: Point) -> None:
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
    page.mouse.move(*end)
    page.mouse.up()


def test_what_a_person_does(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "player.yaml"
    before = file.read_text()
    open_player(page, editor)

    # Drag a state.
    x, y = center_of(page, "LookForBall")
    drag(page, (x, y), (x - 40, y + 30))
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    assert center_of(page, "LookForBall") != (x, y)

    # Add a state where nothing is, and name it at once.
    create_state(page, "Celebrate")
    expect(state(page, "Celebrate")).to_be_visible()
    expect(page.get_by_label("Findings").get_by_text("Celebrate").first).to_be_visible()

    # Connect it from Kick, by the list of the inspector, and guard the transition.
    select_state(page, "Kick")
    page.get_by_label("Inspector").get_by_role("button", name="Transition").click()
    page.get_by_text("to Celebrate", exact=True).click()
    guard = page.get_by_label("When", exact=True)
    guard.fill("perception.ball_sen")
    expect(page.get_by_label("Findings").get_by_text("did you mean 'ball_seen'?")).to_be_visible()
    guard.fill("perception.ball_seen")
    expect(page.get_by_label("Findings").get_by_text("did you mean 'ball_seen'?")).to_have_count(0)
    page.get_by_label("After (seconds in this state)").fill("7")
    expect(page.locator('g[data-kind="transition"][aria-label*="7 s"]').first).to_be_visible()

    # Undo and redo.
    page.get_by_role("button", name="Undo").click()
    expect(page.locator('g[data-kind="transition"][aria-label*="7 s"]')).to_have_count(0)
    page.get_by_role("button", name="Redo").click()
    expect(page.locator('g[data-kind="transition"][aria-label*="7 s"]').first).to_be_visible()

    # See the code, generate, reload: all is there.
    page.get_by_role("tab", name="Generated code").click()
    expect(page.locator(".preview").get_by_text("Celebrate").first).to_be_visible()
    page.get_by_role("button", name="Generate").click()
    expect(page.get_by_text("Saved", exact=True).first).to_be_visible()
    page.get_by_role("dialog").get_by_role("button", name="Write").click()
    expect(page.locator(".q-notification__message", has_text="Generated")).to_be_visible()
    page.reload()
    expect(state(page, "Celebrate")).to_be_visible()
    after = file.read_text()
    assert "  Celebrate:" in after
    assert "perception.ball_seen" in after
    assert after.splitlines()[:5] == before.splitlines()[:5]


def test_who_renames_a_state_types_on_in_the_next_field(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    page.get_by_label("State", exact=True).fill("Shoot")
    page.keyboard.press("Tab")
    # D disables what is selected, F makes it final, N makes a transition: not while one types.
    page.keyboard.type(" Defend now.")
    expect(page.get_by_label("State", exact=True)).to_have_value("Shoot")
    expect(page.get_by_role("textbox", name="Description")).to_have_value(
        "Kick, with the eyes on the ball. Defend now."
    )
    page.get_by_role("tab", name="History").click()
    expect(page.get_by_role("group", name="History").get_by_role("button")).to_have_count(3)


def test_a_declaration_without_a_name_is_told_and_not_taken(editor: str, page: Page) -> None:
    open_player(page, editor)
    name = page.get_by_role("group", name="variable kick").get_by_role("textbox", name="Name")
    name.fill("")
    name.press("Enter")
    expect(page.get_by_text("enter a name")).to_be_visible()
    expect(page.get_by_text("Unsaved changes")).to_have_count(0)


def test_escape_calls_off_a_dialog_that_is_still_on_its_way(editor: str, page: Page) -> None:
    open_player(page, editor)
    # The dialog of a busy machine comes seconds after the key.
    page.evaluate(
        """() => {
            const send = window.emitEvent;
            window.emitEvent = (...message) => setTimeout(() => send(...message), 3000);
        }"""
    )
    page.keyboard.press("Control+Shift+E")
    page.keyboard.press("Escape")
    # When this is answered, the dialog has come.
    page.evaluate("emitEvent('command-save')")
    expect(page.locator(".q-notification").get_by_text("Saved", exact=True)).to_be_visible()
    expect(page.get_by_role("dialog")).to_have_count(0)
    page.keyboard.press("Control+Shift+E")
    expect(page.get_by_role("dialog")).to_be_visible()


def test_tab_leads_from_the_label_of_a_timer_to_its_duration(editor: str, page: Page, project: Path) -> None:
    design = project / "forward" / "player.yaml"
    design.write_text(
        design.read_text().replace("{to: WatchBall, when: not kicker.busy, after: 0.5,", "{to: WatchBall, after: 3,")
    )
    open_player(page, editor)
    label(page, "Kick/0").dblclick()
    expect(page.locator("input.guard-field")).to_have_value("after 3 s")
    page.keyboard.press("Tab")
    expect(page.get_by_label("After (seconds in this state)")).to_be_focused()


def test_a_double_click_on_a_label_opens_its_guard(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    label(page, "Kick/0").dblclick()
    expect(page.locator("input.guard-field")).to_have_value("not kicker.busy after 0.5 s")
    page.keyboard.press("Tab")
    expect(page.get_by_label("When", exact=True)).to_be_focused()
    expect(page.get_by_label("When", exact=True)).to_have_text("not kicker.busy")

    # What was typed just now is taken over by a press on the drawing, and by the key that saves.
    kick = center_of(page, "Kick")
    page.get_by_label("After (seconds in this state)").fill("8")
    page.mouse.click(*kick)
    expect(page.get_by_label("State", exact=True)).to_have_value("Kick")
    page.get_by_label("Description", exact=True).fill("Shoots.")
    saved = save(page, project / "forward" / "player.yaml")
    assert "after: 8" in saved
    assert "doc: Shoots." in saved

    # A press elsewhere takes a name over, and what it selects stays selected: here nothing.
    select_state(page, "GetUp")
    page.keyboard.press("F2")
    page.locator("input.rename").fill("StandUp")
    page.mouse.click(kick[0], kick[1] + 70)
    expect(page.get_by_label("Frequency, Hz")).to_be_visible()
    expect(state(page, "StandUp")).to_be_visible()
    expect(page.locator("g.selected")).to_have_count(0)


def test_what_is_asked_before_the_page_can_speak_is_done_when_it_can(editor: str, page: Page) -> None:
    page.add_init_script(SPEAKS_LATE)
    page.goto(editor + PLAYER)
    expect(state(page, "LookForBall")).to_be_visible()
    page.get_by_role("button", name="Table").click()
    page.keyboard.press("Control+k")
    page.keyboard.type("show or hide li")
    page.evaluate("window.maySpeak = true")
    expect(page.get_by_role("option", name="Show or hide links")).to_be_visible()
    page.keyboard.press("Escape")
    expect(page.get_by_role("treegrid")).to_be_visible()


def test_a_name_is_typed_at_once_over_a_slow_line(editor: str, page: Page, line: SlowConnection) -> None:
    open_player(page, editor)
    line.hold()
    page.mouse.dblclick(*empty_corner(page))
    page.keyboard.type("Sound")
    page.keyboard.press("Enter")
    expect(state(page, "Sound")).to_be_visible()
    page.keyboard.press("n")
    page.keyboard.type("Duck")
    line.release()
    page.keyboard.type("Pond")
    page.keyboard.press("Enter")
    page.keyboard.type("20 s")
    page.keyboard.press("Enter")
    expect(label(page, "Sound/0").or_(page.locator('g[data-id="Sound/0"]')).first).to_be_visible()
    expect(state(page, "DuckPond")).to_be_visible()
    expect(page.get_by_role("dialog")).to_have_count(0)
    page.get_by_role("button", name="Undo").click()
    page.get_by_role("button", name="Undo").click()
    expect(page.get_by_text("Saved", exact=True)).to_be_visible()


def test_keys_after_a_gesture_belong_to_the_field_that_it_opens(editor: str, page: Page, line: SlowConnection) -> None:
    open_player(page, editor)
    line.hold()
    page.keyboard.press("u")
    page.keyboard.type("searx")
    page.keyboard.press("Backspace")
    page.keyboard.type("chn")
    line.release()
    field = page.get_by_label("Component", exact=True)
    expect(field).to_have_value("searchn")
    page.keyboard.type("et")
    expect(field).to_have_value("searchnet")

    expect(page.locator(".use-dialog .choice")).to_have_count(1)
    page.keyboard.press("Escape")
    expect(field).to_have_count(0)
    label(page, "LookForBall/0").click()
    line.hold()
    page.keyboard.press("Enter")
    guard = page.locator("input.guard-field")
    expect(guard).to_be_focused()
    page.keyboard.press("Home")
    page.keyboard.type("not ")
    page.keyboard.press("Enter")
    line.release()
    expect(page.get_by_label("When", exact=True)).to_contain_text("not ")
    expect(guard).to_be_hidden()
    expect(page.locator("input.rename")).to_be_hidden()


def test_two_windows_stay_in_step(editor: str, page: Page, second_window: Page) -> None:
    open_player(page, editor)
    open_player(second_window, editor)
    create_state(page, "Pause")
    expect(state(second_window, "Pause")).to_be_visible()
    second_window.get_by_role("button", name="Undo").click()
    expect(state(page, "Pause")).to_have_count(0)
    expect(page.get_by_text("Saved", exact=True)).to_be_visible()


def test_a_file_changed_outside_is_not_overwritten(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "player.yaml"
    open_player(page, editor)
    select_state(page, "LookForBall")
    page.get_by_label("Description").fill("mine")
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    theirs = file.read_text().replace("component: Player", "component: Player  # the striker")
    theirs = theirs.replace("Look around until the ball is seen.", "theirs")
    file.write_text(theirs)
    page.get_by_role("button", name="Save").click()
    expect(page.get_by_text("was changed by another program")).to_be_visible()
    assert file.read_text() == theirs
    page.get_by_role("button", name="Keep your version").click()
    expect(page.get_by_text("Saved your version")).to_be_visible()
    assert "# the striker" in file.read_text()
    assert "mine" in file.read_text()


def test_texts_from_strangers_stay_texts(editor: str, page: Page) -> None:
    evil = "<img src=x onerror=\"document.title='owned'\">"
    open_player(page, editor)
    select_state(page, "LookForBall")
    page.get_by_label("Description").fill(evil)
    page.locator(".decision").first.click()
    page.get_by_label("When", exact=True).fill(evil)
    expect(page.get_by_label("Findings").locator(".finding").first).to_be_visible()
    page.get_by_label("When", exact=True).blur()
    page.get_by_role("tab", name="Generated code").click()
    expect(page.locator(".preview .cm-editor")).to_be_visible()
    expect(page.locator(".code-note")).to_contain_text("No code yet")
    assert page.locator("img[src=x]").count() == 0
    assert "owned" not in page.title()


def test_keys_work_wherever_the_focus_is(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    page.get_by_label("Description").first.fill("by keys")
    page.get_by_label("Description").first.blur()
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    page.keyboard.press("Control+s")
    expect(page.get_by_text("Unsaved changes")).to_have_count(0)
    assert "by keys" in (project / "forward" / "player.yaml").read_text()
    page.keyboard.press("Control+z")
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    expect(page.get_by_label("Description").first).not_to_have_value("by keys")
    page.keyboard.press("Control+Shift+Z")
    expect(page.get_by_label("Description").first).to_have_value("by keys")
    expect(page.get_by_text("Unsaved changes")).to_have_count(0)


def test_messages_hide_no_list_and_take_no_press(editor: str, page: Page) -> None:
    open_player(page, editor)
    page.get_by_role("tab", name="History").click()
    page.keyboard.press("Control+s")
    message = page.locator(".q-notification", has_text="Saved")
    # It comes from below.
    page.wait_for_function(
        """() => {
          const message = document.querySelector(".q-notification")?.getBoundingClientRect();
          return message && message.bottom <= document.querySelector(".dock").getBoundingClientRect().top;
        }"""
    )
    assert message.evaluate(
        """(message) => {
          const {x, y, width, height} = message.getBoundingClientRect();
          return document.elementFromPoint(x + width / 2, y + height / 2).closest("main") !== null;
        }"""
    )


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_messages_are_readable_and_above_dialogs(editor: str, page: Page, scheme: Literal["light", "dark"]) -> None:
    page.emulate_media(color_scheme=scheme)
    open_player(page, editor)
    page.keyboard.press("?")
    expect(page.locator(".help")).to_be_visible()
    page.keyboard.press("Control+s")
    message = page.locator(".q-notification", has_text="Saved")
    expect(message).to_be_visible()
    for kind in ("positive", "negative", "warning", "info"):
        # Quasar marks the kind by these classes.
        text, back = message.evaluate(
            """(message, kind) => {
              message.classList.remove("bg-positive", "bg-negative", "bg-warning", "bg-info");
              message.classList.add("bg-" + kind);
              const {color, backgroundColor} = getComputedStyle(message);
              return [color, backgroundColor];
            }""",
            kind,
        )
        assert contrast(hex_color(text), hex_color(back)) >= 4.5, kind
    above = "([one, other]) => [one, other].map((each) => +getComputedStyle(document.querySelector(each)).zIndex)"
    message_z, dialog_z = page.evaluate(above, [".q-notifications__list--bottom", ".q-dialog"])
    assert message_z > dialog_z


def hex_color(color: str) -> str:
    """A color such as "rgb(255, 0, 16)" as in a style sheet."""
    return "#" + "".join(f"{int(part):02x}" for part in re.findall(r"\d+", color)[:3])


def test_what_is_no_frequency_is_told_and_stays_to_be_mended(editor: str, page: Page) -> None:
    open_player(page, editor)
    field = page.get_by_label("Frequency, Hz")
    field.fill("1O")
    field.blur()
    expect(page.get_by_text("'1O' is not a number")).to_be_visible()
    expect(field).to_have_value("1O")
    field.fill("10")
    expect(page.get_by_text("is not a number")).to_have_count(0)
    expect(page.get_by_text("Saved", exact=True)).to_be_visible()


def test_looking_at_what_is_unknown_changes_nothing(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "odd.yaml"
    file.write_text("vicode: 1\ncomponent: Odd\ninitial: Nowhere\nstates:\n  A: {requires: [nobody]}\n  B: {}\n")
    expect_nothing_done = expect(page.get_by_role("button", name="Undo"))
    page.goto(editor + "design/forward/Odd")
    expect(page.get_by_label("Initial state")).to_have_value("Nowhere")
    expect_nothing_done.to_be_disabled()
    select_state(page, "A")
    expect(page.get_by_label("Inspector").get_by_text("nobody", exact=True).first).to_be_visible()
    expect_nothing_done.to_be_disabled()
    file.write_text("vicode: 1\ncomponent: Odd\nstates: {A: {}}\n")
    expect(state(page, "B")).to_have_count(0)
    expect_nothing_done.to_be_disabled()


def test_other_programs_are_followed(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    file = project / "forward" / "player.yaml"
    file.write_text(file.read_text().replace("WatchBall", "Rest"))
    (project / "forward" / "wave.yaml").write_text("vicode: 1\ncomponent: Wave\nstates: {Up: {}}\n")
    expect(state(page, "Rest")).to_be_visible()
    expect(page.get_by_role("link", name="Wave")).to_be_visible()
    expect(page.get_by_text("Saved", exact=True)).to_be_visible()
