"""Findings on a real page: grouped and filtered, one after the other by keys, mended by quick fixes."""

import re
from pathlib import Path

from playwright.sync_api import Page, expect

from tests.editor.player_page import PLAYER, findings, open_player, state


def break_player(project: Path) -> None:
    """Two mistakes with a certain mend, and a warning."""
    file = project / "forward" / "player.yaml"
    text = file.read_text()
    file.write_text(
        text.replace("to: FollowBall", "to: FolowBall", 1).replace("variables:", "variables:\n  idle: 0", 1)
    )


def test_findings_are_worked_through_by_keys_and_mended(editor: str, page: Page, project: Path) -> None:
    break_player(project)
    open_player(page, editor)
    rows = findings(page).get_by_role("listitem")
    wrong = rows.filter(has_text="unknown state 'FolowBall'")
    expect(wrong).to_have_count(1)
    expect(findings(page).get_by_text(re.compile(r"\d+ error.*warning"))).to_be_visible()

    # F8 goes to the worst first, and back.
    page.keyboard.press("F8")
    expect(wrong).to_have_class(re.compile("is-current"))
    expect(page.get_by_label("Inspector").get_by_text("Transition from")).to_be_visible()
    page.keyboard.press("F8")
    expect(wrong).not_to_have_class(re.compile("is-current"))
    page.keyboard.press("Shift+F8")
    expect(wrong).to_have_class(re.compile("is-current"))

    # The fixes are those that are certain; one of them, one undo.
    wrong.get_by_role("button", name="Fix:").click()
    expect(page.get_by_role("menuitem")).to_have_text(
        ["Change the target to FollowBall", "Create the state FolowBall", "Remove the transition"]
    )
    page.get_by_role("menuitem", name="Change the target to FollowBall").click()
    expect(wrong).to_have_count(0)
    page.get_by_role("button", name="Undo").click()
    expect(wrong).to_have_count(1)

    # By keyboard alone: create the missing state.
    wrong.get_by_role("button", name="Fix:").press("Enter")
    page.get_by_role("menuitem", name="Create the state").press("Enter")
    expect(state(page, "FolowBall")).to_be_visible()


def test_findings_are_filtered(editor: str, page: Page, project: Path) -> None:
    break_player(project)
    open_player(page, editor)
    rows = findings(page).get_by_role("listitem")
    expect(rows.filter(has_text="FolowBall")).not_to_have_count(0)
    page.get_by_label("Filter findings").fill("idle")
    expect(rows).to_have_count(1)
    expect(findings(page).get_by_text("1 shown")).to_be_visible()
    page.get_by_label("Filter findings").fill("")
    findings(page).get_by_role("button", name="Show warnings").click()
    expect(rows.filter(has_text="idle")).to_have_count(0)
    expect(rows.filter(has_text="FolowBall")).not_to_have_count(0)


def test_a_sound_design_has_nothing_to_go_to(editor: str, page: Page) -> None:
    page.goto(editor + PLAYER)
    expect(state(page, "Kick")).to_be_visible()
    page.keyboard.press("F8")
    expect(page.get_by_text("No problems found").last).to_be_visible()


LAMP = """\
vicode: 1
component: Lamp
frequency: 10
parameters: {on: false}
initial: Dark
states:
  Dark: {transitions: [{to: Lit, when: on}]}
  Lit: {transitions: [{to: Dark, after: 2}]}
properties:
  - {after: Lit, reach: Dark, within: 1}
"""


def test_a_deep_check_finds_a_run_that_can_be_played(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "lamp.yaml"
    file.write_text(LAMP)
    page.goto(editor + "design/forward/Lamp")
    broken = findings(page).get_by_role("listitem").filter(has_text="D441")
    expect(findings(page).get_by_role("switch", name="Deep check")).to_be_visible()
    expect(broken).to_have_count(0)
    findings(page).get_by_role("switch", name="Deep check").click()
    expect(broken).to_contain_text("'after Lit, Dark is reached within 1' does not hold", timeout=30_000)

    broken.get_by_role("button", name="Play:").click()
    expect(page.get_by_label("Simulate with")).to_have_value("View a trace")
    # The run ends a second after the lamp was lit.
    expect(page.get_by_text("End of the recording")).to_be_visible()
    expect(page.get_by_text(re.compile(r"iteration \d+ · Lit"))).to_be_visible()

    # Each edit is checked again: the lamp goes out in time.
    page.get_by_role("tab", name="Findings").click()
    file.write_text(LAMP.replace("after: 2", "after: 0.8"))
    expect(broken).to_have_count(0, timeout=30_000)
    file.write_text(LAMP.replace("after: 2", "after: 1.5"))
    expect(broken).to_have_count(1, timeout=30_000)
