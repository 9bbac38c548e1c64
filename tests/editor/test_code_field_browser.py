"""Editing guards and code: completion, marks under errors, and keyboard access."""

import re
from pathlib import Path

from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import findings, open_player, save, select_state, select_transition
from tests.editor.slow_connection import SlowConnection

LOOK = "LookForBall/0"


def guard(page: Page) -> Locator:
    """The field of the selected transition's guard."""
    return page.get_by_label("When", exact=True)


def options(page: Page) -> Locator:
    """The options of the completion list."""
    return page.locator(".cm-tooltip-autocomplete li")


def accept(page: Page, label: str) -> None:
    """Accept the first option, which must have this label."""
    expect(options(page).first).to_contain_text(label)
    # A list that has just opened ignores Enter for 75 ms, so that it does not swallow a line break.
    page.wait_for_timeout(150)
    page.keyboard.press("Enter")


def retype(page: Page, field: Locator, text: str) -> None:
    """Replace the text of a code editor, key by key."""
    field.click()
    page.keyboard.press("Control+a")
    page.keyboard.type(text)


def test_enter_ends_a_guard_and_tab_accepts_a_name(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_transition(page, LOOK)
    retype(page, guard(page), "not perception.ball_s")
    expect(options(page).first).to_contain_text("ball_seen")
    page.wait_for_timeout(150)
    page.keyboard.press("Tab")
    expect(guard(page)).to_have_text("not perception.ball_seen")
    expect(guard(page)).to_be_focused()
    page.keyboard.press("Enter")
    expect(guard(page)).not_to_be_focused()
    expect(guard(page).locator(".cm-line")).to_have_count(1)

    # A list that has only just opened is no reason for a line break.
    retype(page, guard(page), "perception.ball_seen")
    expect(options(page).first).to_be_visible()
    page.keyboard.press("Enter")
    expect(guard(page).locator(".cm-line")).to_have_count(1)


def test_a_guard_is_completed_marked_and_left_by_keyboard(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_transition(page, LOOK)
    expect(guard(page)).to_have_text("perception.ball_seen")

    # Available names with type, unit and description.
    retype(page, guard(page), "perception.ball_a")
    expect(options(page).first).to_contain_text("float s output")
    expect(page.locator(".cm-completionInfo")).to_be_visible()
    accept(page, "ball_age")
    expect(guard(page)).to_have_text("perception.ball_age")

    # Not a condition yet: there is a message below and a mark under the characters.
    inspector = page.get_by_label("Inspector")
    expect(page.locator(".squiggle.error")).to_have_text("perception.ball_age")
    expect(inspector.get_by_role("button", name="expected bool, found float")).to_be_visible()
    expect(guard(page)).to_have_attribute("aria-invalid", "true")
    page.keyboard.type(" > lost_af")
    accept(page, "lost_after")
    expect(page.locator(".squiggle")).to_have_count(0)
    expect(findings(page).get_by_text("No problems found")).to_be_visible()

    # Several lines; Tab leaves the field.
    page.keyboard.press("Shift+Enter")
    page.keyboard.type("and sta")
    page.keyboard.press("Control+Space")
    expect(options(page).filter(has_text="state_time")).to_have_count(1)
    page.keyboard.press("Escape")
    page.keyboard.type("te_time > 1")
    page.keyboard.press("Tab")
    expect(guard(page)).not_to_be_focused()
    expect(guard(page).locator(".cm-line")).to_have_count(2)


def test_a_message_moves_the_cursor_to_its_characters_by_keyboard(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_transition(page, LOOK)
    retype(page, guard(page), "perception.ball_seen and nobody")
    message = page.get_by_label("Inspector").get_by_role("button", name="'nobody' is not declared")
    message.press("Enter")
    expect(guard(page)).to_be_focused()
    page.keyboard.type("not ")
    expect(guard(page)).to_have_text("perception.ball_seen and not nobody")


def test_an_unknown_name_becomes_an_input(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    select_transition(page, LOOK)
    retype(page, guard(page), "perception.ball_seen and order_given")
    inspector = page.get_by_label("Inspector")
    expect(inspector.locator(".field-message")).to_have_text(
        "'order_given' is not declared – declare it or correct the name"
    )
    inspector.get_by_role("button", name="Quick fixes").click()
    page.get_by_role("menuitem", name="Create input order_given (bool)").click()
    expect(guard(page)).to_have_text("perception.ball_seen and sensors.order_given")
    expect(findings(page).get_by_text("No problems found")).to_be_visible()
    assert "order_given" in (project / "forward" / "project.yaml").read_text()
    page.get_by_role("button", name="Undo").click()
    expect(guard(page)).to_have_text("perception.ball_seen and order_given")
    assert "order_given" not in (project / "forward" / "project.yaml").read_text()


def test_fast_typing_is_neither_lost_nor_reordered(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    select_transition(page, LOOK)
    text = "perception.ball_seen and state_time > 0.25 and not kicker.busy and component_time < 1000"
    retype(page, guard(page), text)
    expect(guard(page)).to_have_text(text)
    assert text in re.sub(r"\s+", " ", save(page, project / "forward" / "player.yaml"))


def test_the_linter_marks_code_and_knows_declared_names(editor: str, page: Page, line: SlowConnection) -> None:
    open_player(page, editor)
    select_state(page, "LookForBall")
    # Typed immediately after adding the action: the letters are not shortcuts of the canvas, and the field is empty.
    line.hold()
    page.get_by_label("Inspector").get_by_role("button", name="Add to actions: Code").first.click()
    page.keyboard.type("log.")
    line.release()
    code = page.get_by_label("Python", exact=True).first
    expect(code).to_have_text("log.")
    expect(code).to_be_focused()
    page.keyboard.type("info(Side.left, wrong)")
    expect(code).to_have_text("log.info(Side.left, wrong)")
    expect(page.locator(".squiggle.warning")).to_have_text("wrong")
    expect(page.get_by_label("Inspector").get_by_role("button", name="F821")).to_have_count(1)
    retype(page, code, "self.percep")
    accept(page, "perception")
    page.keyboard.type(".ball_s")
    accept(page, "ball_seen")
    expect(code).to_have_text("self.perception.ball_seen")
    # Tab indents. Escape moves the focus to the canvas, or closes the completion list; then Tab leaves.
    page.keyboard.press("Escape")
    page.keyboard.press("Tab")
    expect(page.locator(".cm-content:focus")).to_have_count(0)


def test_code_keeps_focus_and_action_while_others_move_it(editor: str, page: Page, other: Page) -> None:
    open_player(page, editor)
    open_player(other, editor)
    for each in (page, other):
        select_state(each, "LookForBall")
    for _ in range(2):
        page.get_by_role("button", name="Add to actions: Code").click()
    code = page.get_by_label("Inspector").get_by_label("Python", exact=True)
    expect(code).to_have_count(2)
    retype(page, code.nth(1), "first")
    expect(other.get_by_label("Inspector").get_by_label("Python", exact=True).nth(1)).to_have_text("first")
    other.get_by_role("button", name=re.compile("^Move up: [0-9] Code")).last.click()
    expect(code.nth(0)).to_have_text("first")
    expect(code.nth(0)).to_be_focused()
    page.keyboard.type(" and second")
    expect(other.get_by_label("Inspector").get_by_label("Python", exact=True).nth(0)).to_have_text("first and second")


def test_code_is_edited_in_a_wide_editor(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_transition(page, LOOK)
    page.get_by_role("button", name="Enlarge: When").click()
    large = page.get_by_role("dialog").get_by_label("When", exact=True)
    retype(page, large, "perception.ball_seen and True")
    expect(page.get_by_label("Inspector").get_by_label("When", exact=True)).to_have_text(
        "perception.ball_seen and True"
    )
    page.get_by_role("dialog").get_by_role("button", name="Close").click()
    expect(page.get_by_role("dialog")).to_have_count(0)
    expect(guard(page)).to_have_text("perception.ball_seen and True")


def test_panels_are_resized_and_keep_their_size(editor: str, page: Page) -> None:
    open_player(page, editor)
    side, grip = page.locator(".side"), page.get_by_role("separator", name="Width of the side panel")
    box = grip.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 4, 300)
    page.mouse.down()
    page.mouse.move(box["x"] - 96, 300, steps=4)
    page.mouse.up()
    expect(side).to_have_css("width", "468px")
    grip.press("ArrowLeft")
    expect(side).to_have_css("width", "500px")
    dock, grip_below = page.locator(".dock-panels"), page.get_by_role("separator", name="Height of the bottom panel")
    expect(dock).to_have_css("height", "104px")
    grip_below.press("ArrowUp")
    expect(dock).to_have_css("height", "128px")
    page.reload()
    expect(side).to_have_css("width", "500px")
    expect(dock).to_have_css("height", "128px")
    grip.dblclick()
    expect(side).to_have_css("width", "368px")


def test_html_in_names_is_shown_as_text_in_completion_and_marks(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "project.yaml"
    evil = "<img src=x onerror=\"document.title='owned'\">"
    file.write_text(file.read_text().replace("components:", f"components:\n  Zebra: {{doc: '{evil.replace(chr(39), chr(39) * 2)}', implementation: 'a:B', outputs: {{stripes: {{type: bool, doc: '<b>{evil.replace(chr(39), chr(39) * 2)}'}}}}}}", 1))  # fmt: skip  # noqa: E501
    player = project / "forward" / "player.yaml"
    player.write_text(player.read_text().replace("uses:", "uses:\n  zebra: {component: Zebra, at: [300, 300]}", 1))
    open_player(page, editor)
    select_transition(page, LOOK)
    retype(page, guard(page), "zebra.str")
    expect(page.locator(".cm-completionInfo")).to_contain_text("<img")
    page.keyboard.press("Escape")
    retype(page, guard(page), evil)
    expect(page.locator(".squiggle").first).to_be_visible()
    page.locator(".squiggle").first.hover()
    expect(page.locator(".squiggle-tip")).to_be_visible()
    assert page.locator("img[src=x]").count() == 0
    assert "owned" not in page.title()


def test_each_language_of_the_code_has_a_tab(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    select_state(page, "WatchBall")
    tabs = page.get_by_role("tablist", name="Languages of the code").first
    expect(tabs.get_by_role("tab", name="Python")).to_have_attribute("aria-selected", "true")
    tabs.get_by_role("tab", name="C++").click()
    # All codes of a form are shown in the same language.
    code = page.get_by_label("Inspector").get_by_label("C++", exact=True).first
    expect(code).to_have_text("distances_[distance_count_++ % distances_.size()] = perception.ball_distance;")
    retype(page, code, "distance_count_ += 2;")
    text = save(page, project / "forward" / "player.yaml")
    assert "cpp: distance_count_ += 2;" in text
    assert "python: self._distances.append(self.perception.ball_distance)" in text
