"""Comparing the languages of the open design: found in the palette, and a difference leads to its state."""

from pathlib import Path

from playwright.sync_api import Page, expect

from tests.editor.player_page import open_player, state


def test_a_difference_leads_to_its_state(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    for name, text in (("project.yaml", PROJECT), ("player.yaml", COUNTER)):
        (project / "forward" / name).write_text(text, encoding="utf-8")
    expect(state(page, "Far")).to_be_visible()
    page.keyboard.press("Control+k")
    page.keyboard.type("compare languages")
    page.keyboard.press("Enter")
    dialog = page.get_by_role("dialog", name="Compare languages of Player")
    expect(dialog.get_by_role("status")).to_contain_text(
        "Reference, Python, C++ and simulator: the traces differ", timeout=60_000
    )
    words = [
        "Python agrees with reference",
        "C++ differs from reference",
        "Simulator agrees with reference",
        "XABSL is not compared: this code is missing",
    ]
    expect(dialog.get_by_role("listitem")).to_contain_text(words)
    difference = dialog.get_by_role("region", name="reference and C++ differ in run 1")
    expect(difference.get_by_text("Player: values.n: reference")).to_be_visible()
    difference.get_by_role("button", name="Player Far").last.click()
    expect(dialog).to_be_hidden()
    expect(page.get_by_label("State", exact=True)).to_have_value("Far")
    # The result stays.
    page.get_by_role("tab", name="Generated code").click()
    page.get_by_role("button", name="Compare languages").click()
    expect(dialog.get_by_text("the traces differ")).to_be_visible()


PROJECT = """
vicode: 1
project: forward
components:
  Eye: {outputs: {distance: float}}
"""
COUNTER = """
vicode: 1
component: Player
uses: {eye: Eye}
outputs: {n: {type: int}}
initial: Near
states:
  Near:
    at: [160, 80]
    actions: [{set: {n: n + 1}}]
    transitions: [{to: Far, when: eye.distance > 7}]
  Far:
    at: [160, 200]
    actions: [{code: {python: self.n -= 1, cpp: n -= 2;}}]
    transitions: [{to: Near, when: eye.distance < 3}]
"""
