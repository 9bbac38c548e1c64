"""States are extracted by the context menu, edited in place in their new file, and inlined again."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.editor.player_page import state

LAMP = """\
vicode: 1
component: Lamp
initial: Off
uses: {eyes: Eyes}
states:
  Off: {at: [0, 0], transitions: [{to: Dim, when: eyes.seen}]}
  Dim: {at: [300, 0], transitions: [{to: Bright, after: 1}]}
  Bright: {at: [600, 0], transitions: [{to: Dim, after: 2}, {to: Off, when: not eyes.seen}]}
"""
PROJECT = "vicode: 1\nproject: Lamps\ncomponents: {Eyes: {implementation: world, outputs: {seen: bool}}}\n"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "designs"
    (folder / "lamps").mkdir(parents=True)
    (folder / "lamps" / "project.yaml").write_text(PROJECT)
    (folder / "lamps" / "lamp.yaml").write_text(LAMP)
    return folder


def extract(page: Page, url: str) -> None:
    """Open the lamp and extract two of its states."""
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(f"{url}design/lamps/Lamp")
    state(page, "Dim").click()
    page.wait_for_function("window.did_handshake")
    state(page, "Bright").click(modifiers=["Shift"])
    state(page, "Bright").click(button="right")
    page.get_by_role("menuitem", name="Extract component…").click()
    page.get_by_label("Name of the component").fill("Glow")
    page.get_by_role("button", name="Extract").click()
    expect(state(page, "Glow")).to_be_visible()


def test_extract_and_inline_by_the_menu_and_undo(editor: str, page: Page, project: Path) -> None:
    file = project / "lamps" / "glow.yaml"
    extract(page, editor)
    assert "Bright" in file.read_text()
    state(page, "Glow").click(button="right")
    page.get_by_role("menuitem", name="Inline component").click()
    expect(state(page, "Bright")).to_be_visible()
    expect(state(page, "Glow")).to_have_count(0)
    assert not file.exists()
    page.keyboard.press("Control+z")
    expect(state(page, "Glow")).to_be_visible()
    assert file.exists()


def test_a_used_component_is_edited_in_place_in_its_file(editor: str, page: Page, project: Path) -> None:
    file = project / "lamps" / "glow.yaml"
    extract(page, editor)
    caller = (project / "lamps" / "lamp.yaml").read_text()
    state(page, "Glow").click()
    page.keyboard.press("e")
    inside = page.get_by_role("group", name="Edit Glow")
    expect(page.locator(".inset-file")).to_have_text("glow.yaml")
    inner = inside.locator('g[data-kind="state"][data-id="Bright"]')
    inner.click()
    page.keyboard.press("F2")
    inside.locator("input").fill("Full")
    page.keyboard.press("Enter")
    renamed = inside.locator('g[data-kind="state"][data-id="Full"]')
    expect(renamed).to_be_visible()
    page.keyboard.press("s")
    expect(inside.locator('g[data-kind="state"]')).to_have_count(5)
    renamed.click()
    page.keyboard.press("t")
    inside.locator('g[data-kind="state"][data-id="Start"]').click()
    expect(inside.locator('g[data-kind="transition"][data-id="Full/2"]').first).to_be_attached()
    assert "Full" in file.read_text()
    assert "to: Start" in file.read_text()
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    expect(inner).to_be_visible()
    expect(inside.locator('g[data-kind="state"]')).to_have_count(4)
    box = inner.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y + 40, steps=4)
    page.mouse.up()
    expect(inner).to_have_class(re.compile("selected"))
    page.keyboard.press("d")
    expect(inner).to_have_class(re.compile("disabled"))
    assert "at: [600, 0]" not in file.read_text()
    page.keyboard.press("Delete")
    expect(inner).to_have_count(0)
    assert "Bright" not in file.read_text()
    assert (project / "lamps" / "lamp.yaml").read_text() == caller
