"""Nothing is lost: a killed server, a file changed under unsaved work, saving by itself, and the history as a list."""

import socket
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.editor.conftest import started_editor
from tests.editor.player_page import open_player, select_state, wait_for_another

expect.set_options(timeout=20_000)


def type_doc(page: Page, text: str) -> None:
    page.get_by_role("textbox", name="Description").fill(text)
    page.get_by_role("textbox", name="Description").blur()


def test_unsaved_work_survives_a_killed_server(
    page: Page, project: Path, tmp_path: Path, console_errors: list[str]
) -> None:
    # Leaving a started editor kills it without a word.
    with started_editor(project, tmp_path / "storage") as url:
        open_player(page, url)
        select_state(page, "Kick")
        type_doc(page, "worth keeping")
        expect(page.get_by_text("Unsaved changes")).to_be_visible()
        _wait_for_journal(page, tmp_path / "storage" / "state", "worth keeping")
    # A window that was not open before remembers nothing that was typed.
    page.evaluate("sessionStorage.clear()")
    page.goto("about:blank")
    console_errors.clear()
    with started_editor(project, tmp_path / "storage") as url:
        open_player(page, url)
        expect(page.get_by_text("Recover the unsaved changes to Player")).to_be_visible()
        page.get_by_text("Show differences").click()
        expect(page.locator(".diff-line.added").get_by_text("worth keeping")).to_be_visible()
        page.get_by_role("button", name="Recover").click()
        expect(page.get_by_text("Recovered the changes to Player")).to_be_visible()
        expect(page.get_by_role("dialog")).to_have_count(0)
        select_state(page, "Kick")
        expect(page.get_by_role("textbox", name="Description")).to_have_value("worth keeping")
        page.reload()
        expect(page.get_by_text("Unsaved changes")).to_be_visible()
        expect(page.get_by_text("Recover the unsaved changes")).to_have_count(0)
        page.goto("about:blank")


def _select_description(page: Page) -> None:
    page.get_by_role("textbox", name="Description").press("ControlOrMeta+A")


def _add_code(page: Page) -> None:
    # The ids of the actions that stay are not their indices any more.
    page.get_by_role("button", name="Remove: 1 Set").click()
    page.get_by_role("button", name="Add to enter: Code").click()


@pytest.mark.parametrize(
    ("start", "waits_for_journal"), [(_select_description, True), (_select_description, False), (_add_code, True)]
)
def test_who_types_while_the_server_is_killed_loses_no_letter(
    page: Page,
    project: Path,
    tmp_path: Path,
    console_errors: list[str],
    start: Callable[[Page], None],
    waits_for_journal: bool,
) -> None:
    options = ("--no-tour", "--port", str(_free_port()))
    typed = "the_ball_is_near_and_nobody_of_the_other_team_is_between_it_and_the_goal"
    with started_editor(project, tmp_path / "storage", options) as url:
        open_player(page, url)
        select_state(page, "Kick")
        start(page)
        page.keyboard.type(typed[:20], delay=20)
        if waits_for_journal:
            _wait_for_journal(page, tmp_path / "storage" / "state", typed[:12])
    # What is typed while the page loads anew, after the restart, has no page that could keep it.
    page.keyboard.type(typed[20:], delay=20)
    opened_ms = page.evaluate("performance.timeOrigin")
    with started_editor(project, tmp_path / "storage", options):
        page.wait_for_function(f"performance.timeOrigin > {opened_ms}")
        page.wait_for_selector(".vicode-canvas[data-ready]")
        expect(page.get_by_text("Unsaved changes")).to_be_visible()
        expect(page.get_by_role("dialog")).to_have_count(0)
        # The server has it, and nothing is typed a second time.
        page.wait_for_timeout(300)
        page.reload()
        page.wait_for_selector(".vicode-canvas[data-ready]")
        expect(page.get_by_text("Unsaved changes")).to_be_visible()
        page.keyboard.press("ControlOrMeta+S")
        expect(page.locator(".saved")).to_have_text("Saved")
        saved = (project / "forward" / "player.yaml").read_text()
        assert saved.count("the_ball") == saved.count(typed) == 1
        page.goto("about:blank")
    console_errors.clear()


def _free_port() -> int:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return int(free.getsockname()[1])


def _wait_for_journal(page: Page, state: Path, text: str) -> None:
    for _attempt in range(200):
        if any(text in file.read_text() for file in state.glob("unsaved/*/*.json")):
            return
        page.wait_for_timeout(50)
    raise AssertionError("no journal was written")


def test_a_clash_with_the_file_is_settled_place_by_place(
    editor: str, page: Page, second_window: Page, project: Path
) -> None:
    file = project / "forward" / "player.yaml"
    open_player(page, editor)
    second_window.goto(page.url)
    select_state(page, "LookForBall")
    type_doc(page, "mine of LookForBall")
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    text = file.read_text().replace("Look around until the ball is seen.", "theirs of LookForBall")
    text = text.replace("frequency: 10", "frequency: 20  # faster")
    file.write_text(text.replace("Kick, with the eyes on the ball.", "theirs of Kick"))

    # It is said at once, and nothing is taken before somebody chooses.
    expect(page.get_by_text("Conflict: file changed on disk")).to_be_visible()
    # Whoever works on may touch more of it.
    select_state(page, "Kick")
    type_doc(page, "mine of Kick")
    page.get_by_role("button", name="Resolve…").click()
    second_window.get_by_role("button", name="Resolve…").click()
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_text("description of state LookForBall")).to_be_visible()
    expect(dialog.get_by_text("description of state Kick")).to_be_visible()
    dialog.get_by_role("button", name="On disk").nth(1).click()
    dialog.get_by_role("button", name="Save merged version").click()
    expect(page.get_by_text("Saved", exact=True).first).to_be_visible()
    after = file.read_text()
    assert "mine of LookForBall" in after
    assert "theirs of Kick" in after
    assert "frequency: 20  # faster" in after

    # Whoever answers too late is told so, and changes nothing.
    second_window.get_by_role("button", name="Keep your version").click()
    expect(second_window.get_by_text("The conflict is already resolved")).to_be_visible()
    assert file.read_text() == after

    # What was not taken is in the history.
    page.get_by_role("tab", name="History").click()
    expect(page.get_by_role("group", name="History").get_by_text("version on disk")).to_be_visible()


def test_what_does_not_touch_is_merged_and_said(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "player.yaml"
    open_player(page, editor)
    select_state(page, "Kick")
    type_doc(page, "mine")
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    file.write_text(file.read_text().replace("WatchBall", "Rest"))
    expect(page.get_by_text("Merged changes that another program wrote")).to_be_visible()
    expect(page.locator('g[data-kind="state"][data-id="Rest"]')).to_be_visible()
    expect(page.get_by_role("textbox", name="Description")).to_have_value("mine")
    expect(page.get_by_text("Unsaved changes")).to_be_visible()


def test_designs_are_saved_by_themselves_as_project_yaml_is(project: Path, tmp_path: Path, page: Page) -> None:
    file = project / "forward" / "player.yaml"
    with started_editor(project, tmp_path / "storage", autosave_s=0.2) as url:
        open_player(page, url)
        select_state(page, "Kick")
        before = file.stat().st_ino
        type_doc(page, "saved by itself")
        wait_for_another(page, file, before)
        expect(page.get_by_text("Saved", exact=True)).to_be_visible()
    assert "saved by itself" in file.read_text()


def test_the_history_leads_to_any_point_by_mouse_and_keys(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    for text in ("one", "two"):
        type_doc(page, text)
        page.get_by_role("checkbox", name="Initial").click()
    # What is typed just before a reload is not lost.
    page.get_by_role("textbox", name="Description").fill("three")
    page.reload()
    expect(page.get_by_role("textbox", name="Description")).to_have_value("three")
    page.get_by_role("tab", name="History").click()
    rows = page.get_by_role("group", name="History").get_by_role("button")
    expect(rows.first).to_have_attribute("aria-current", "step")
    expect(rows.last).to_contain_text("open")
    rows.last.click()
    expect(page.get_by_text("Saved", exact=True)).to_be_visible()
    expect(rows.last).to_have_attribute("aria-current", "step")
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Enter")
    expect(rows.last).not_to_have_attribute("aria-current", "step")
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
