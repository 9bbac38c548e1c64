"""Code that is edited in another program arrives in the open design, and nothing typed meanwhile is lost."""

from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.editor.player_page import open_player, select_state, state
from vicode.cli import main
from vicode.generators import generate
from vicode.output import apply_diffs, compare_files
from vicode.store import open_project

GENERATED = "self._distances: list[float] = []"


@pytest.fixture
def file(project: Path) -> Path:
    """The generated file of the player."""
    folder = project.parent / "generated"
    apply_diffs(compare_files(generate(open_project(project / "forward").project), folder), folder)
    return folder / "python" / "forward" / "player.py"


def edit(file: Path, new: str, old: str = GENERATED) -> None:
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))


def test_an_edit_arrives_while_a_name_is_typed_and_can_be_undone(file: Path, editor: str, page: Page) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    name = page.get_by_label("State", exact=True)
    name.press("End")
    name.press_sequentially("Hard")
    edit(file, "self._watched = 0")
    expect(page.get_by_text("Applied from player.py: WatchBall.enter")).to_be_visible()
    name.press_sequentially("er")
    name.press("Enter")
    expect(state(page, "KickHarder")).to_be_visible()
    expect(state(page, "WatchBall").locator(".badge.outside")).to_be_visible()
    select_state(page, "WatchBall")
    code = page.locator(".code-field", has_text="self._watched = 0")
    expect(code).to_be_visible()
    expect(page.get_by_text("changed outside the editor")).to_be_visible()
    select_state(page, "KickHarder")
    expect(page.locator(".badge.outside")).to_have_count(0)
    edit(file, "self._later = 1", "self._distances.append(self.perception.ball_distance)")
    expect(page.get_by_text("Applied from player.py: WatchBall.actions")).to_be_visible()
    page.locator(".undo-bar").get_by_role("button", name="Undo").click()
    select_state(page, "WatchBall")
    expect(code).to_be_visible()
    expect(page.locator(".code-field", has_text="self._distances.append")).to_be_visible()
    expect(state(page, "KickHarder")).to_be_visible()


def test_a_conflict_is_resolved_in_the_dialog(file: Path, editor: str, page: Page) -> None:
    open_player(page, editor)
    select_state(page, "WatchBall")
    code = page.locator(".code-field .cm-content", has_text=GENERATED)
    code.click()
    page.keyboard.press("End")
    page.keyboard.type("; mine = 1")
    edit(file, "theirs = 2")
    expect(page.get_by_text("Conflict: generated code edited")).to_be_visible()
    # A simulation would run something else than the edited code.
    dialog = page.get_by_role("dialog")
    page.get_by_role("tab", name="Simulate").click()
    page.get_by_role("button", name="Step (F10)").click()
    dialog.get_by_role("button", name="Cancel").click()
    expect(dialog).to_have_count(0)
    expect(page.get_by_text("Missing from the design: 1 edit of the generated code")).to_be_visible()
    page.get_by_role("button", name="Resolve…", exact=True).click()
    expect(dialog.get_by_role("button", name="Apply")).to_be_disabled()
    dialog.get_by_role("button", name="In the generated file").click()
    dialog.get_by_role("button", name="Apply").click()
    expect(dialog).to_have_count(0)
    expect(page.locator(".code-field", has_text="theirs = 2")).to_be_visible()
    expect(page.get_by_text("Conflict: generated code edited")).to_have_count(0)
    page.locator("header").get_by_role("button", name="Undo").click()
    expect(page.locator(".code-field", has_text="mine = 1")).to_be_visible()


def test_a_statement_that_both_sides_changed_is_resolved_when_generating(
    project: Path, editor: str, page: Page
) -> None:
    """All three texts are shown; that of the file goes into the design."""
    design = project / "forward" / "player.yaml"
    # The copies of the generated texts tell the edits of both sides apart.
    assert main(["gen", str(project / "forward")]) == 0
    file = project.parent / "generated" / "python" / "forward" / "player.py"
    edit(file, "self.perception.ball_age > 77:", "self.perception.ball_age > lost_after:")
    design.write_text(design.read_text().replace("ball_age > lost_after,", "ball_age > 88,"))
    open_player(page, editor)
    page.get_by_role("button", name="Generate").click()
    dialog = page.get_by_role("dialog")
    write = dialog.get_by_role("button", name="Apply and write")
    for side in ("In the generated file", "In the design"):
        expect(dialog.get_by_role("button", name=side)).to_have_count(2)
    before = dialog.locator(".conflict-side", has_text="Generated before")
    expect(before.first).to_contain_text("if self.perception.ball_age > lost_after")
    expect(write).to_be_disabled()
    dialog.get_by_role("button", name="In the generated file").first.click()
    expect(write).to_be_disabled()
    dialog.get_by_role("button", name="In the design").last.click()
    edited = file.read_text()
    write.click()
    expect(dialog).to_have_count(0)
    expect(page.get_by_text("Generated player.py")).to_be_visible()
    assert design.read_text().count("ball_age > 77") == 1
    assert design.read_text().count("ball_age > 88") == 1
    assert file.read_text().count("ball_age > 77") == 1
    assert file.with_name("player.py.edited").read_text() == edited
