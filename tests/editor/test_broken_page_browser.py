"""A file that cannot be read: found in the list, mended as text, opened as a design."""

from pathlib import Path

from playwright.sync_api import Page, expect

from tests.editor.player_page import open_player, state
from vicode.store import merge_file_texts


def test_a_broken_file_is_mended_in_the_browser(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "wave.yaml"
    file.write_text("vicode: 1\ncomponent: Wave\ninitial: Up\nstates: {Up: {}\n")
    page.goto(f"{editor}design/forward/Wave")
    expect(page.get_by_role("link", name="wave.yaml")).to_be_visible()
    open_player(page, editor)
    page.get_by_role("link", name="wave.yaml").click()
    text = page.get_by_label("Text of wave.yaml")
    expect(text).to_contain_text("component: Wave")
    expect(page.get_by_role("heading", name="wave.yaml")).to_be_visible()
    message = page.get_by_role("button", name="Line ")
    expect(message.first).to_be_visible()

    # A message leads to its place; what is typed is checked at once.
    message.first.press("Enter")
    expect(text).to_be_focused()
    page.keyboard.press("Control+End")
    page.keyboard.press("Backspace")
    page.keyboard.type("}")
    expect(page.get_by_text("No errors. Save to open the design.")).to_be_visible()
    page.keyboard.press("Control+s")
    expect(state(page, "Up")).to_be_visible()
    assert file.read_text() == "vicode: 1\ncomponent: Wave\ninitial: Up\nstates: {Up: {}}"


def test_what_another_program_wrote_is_not_overwritten(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "wave.yaml"
    file.write_text("component: [\n")
    page.goto(f"{editor}broken/forward/wave.yaml")
    expect(page.get_by_label("Text of wave.yaml")).to_contain_text("component")
    file.write_text("component: [[\n")
    page.get_by_role("button", name="Save").click()
    expect(page.get_by_text("was changed by another program")).to_be_visible()
    assert file.read_text() == "component: [[\n"


def test_no_address_leads_to_another_file(editor: str, page: Page, console_errors: list[str]) -> None:
    for path in ("forward/player.yaml", "forward/..%2F..%2Fsecret", "forward/../../../etc/passwd", "x/y"):
        page.goto(f"{editor}broken/{path}")
        expect(page.locator(".cm-editor")).to_have_count(0)
    console_errors.clear()


def test_merge_conflicts_are_resolved_by_taking_a_side(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "wave.yaml"
    base = "vicode: 1\ncomponent: Wave\ninitial: Up\ndoc: waves\nstates:\n  Up:\n    doc: up\n"
    ours, theirs = (base.replace("waves", side).replace("doc: up", f"doc: {side} up") for side in ("ours", "theirs"))
    merged = merge_file_texts(base, ours, theirs)
    assert merged is not None
    file.write_text(merged.text)
    page.goto(f"{editor}broken/forward/wave.yaml")
    expect(page.get_by_role("heading", name="Conflict in description of the design")).to_be_visible()
    expect(page.get_by_role("heading", name="Conflict in description of state Up")).to_be_visible()
    expect(page.get_by_text("2 errors")).to_be_visible()

    page.get_by_role("button", name="Take theirs").first.click()
    expect(page.get_by_role("heading", name="Conflict in")).to_have_count(1)
    page.get_by_role("button", name="Take ours").click()
    expect(page.get_by_text("No errors. Save to open the design.")).to_be_visible()
    page.get_by_role("button", name="Save").click()
    expect(state(page, "Up")).to_be_visible()
    assert file.read_text() == base.replace("waves", "theirs").replace("doc: up", "doc: ours up")
