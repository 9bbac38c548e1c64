"""The simulation panel as a user works with it: inputs, steps, play, breakpoints, stepping back, edits."""

import json
import re
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.editor.conftest import started_editor
from tests.editor.player_page import PLAYER, select_state, state
from tests.editor.test_accessibility_browser import complaints

expect.set_options(timeout=30_000)


def active(page: Page) -> Locator:
    return page.locator("g.node.active")


def open_player(page: Page, url: str, design: str = PLAYER) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(url + design)
    expect(page.locator('g[data-kind="state"]').first).to_be_visible()


def open_simulation(page: Page, url: str, design: str = PLAYER) -> None:
    open_player(page, url, design)
    page.get_by_role("tab", name="Simulate").click()
    expect(page.get_by_text("not started")).to_be_visible()


def where(page: Page, words: str) -> None:
    expect(page.locator(".simulation-where")).to_contain_text(words)


def choose(page: Page, label: str, option: str) -> None:
    page.get_by_role("combobox", name=label).click()
    page.get_by_role("option", name=option).click()


def test_an_input_is_set_and_the_state_follows(editor: str, page: Page) -> None:
    open_simulation(page, editor)
    page.keyboard.press("F10")
    where(page, "0.00 s · iteration 1 · LookForBall")
    expect(active(page)).to_have_attribute("data-id", "LookForBall")
    guard = page.locator(".guard", has_text="→ FollowBall")
    expect(guard).to_contain_text("false")

    # A switch changes the guard immediately; the next iteration takes the transition.
    page.get_by_role("switch", name="Perception ball_seen").click()
    expect(guard).to_contain_text("true")
    expect(guard).to_contain_text("perception.ball_seen = true")
    for _step in range(6):
        page.get_by_role("button", name="Step (F10)").click()
    expect(active(page)).to_have_attribute("data-id", "FollowBall")
    expect(page.locator('g.edge.taken[data-id="LookForBall/0"]')).to_have_count(1)
    where(page, "0.10 s · iteration 7 · FollowBall")
    expect(page.locator("svg.plot rect.plot-state")).to_have_count(2)

    # Back to the past with its inputs, and forward again.
    page.keyboard.press("Control+Shift+F10")
    expect(active(page)).to_have_attribute("data-id", "LookForBall")
    expect(page.get_by_text("Viewing the past: 1 iteration before the latest.")).to_be_visible()
    page.keyboard.press("F10")
    expect(active(page)).to_have_attribute("data-id", "FollowBall")

    # The number next to a slider, and the active components.
    age = page.get_by_role("spinbutton", name="Perception ball_age, number")
    age.fill("3.5")
    expect(page.locator(".guard", has_text="→ LookForBall")).to_contain_text("ball_age = 3.5")
    page.get_by_role("slider", name="Perception ball_y").press("ArrowRight")
    expect(page.get_by_role("spinbutton", name="Perception ball_y, number")).to_have_value("5")
    page.get_by_role("tab", name="Active components").click()
    expect(page.locator(".tree-row", has_text="FaceBall").first).to_be_visible()
    page.get_by_role("button", name="Run until the state changes (Shift+F6)").click()
    expect(active(page)).to_have_attribute("data-id", "LookForBall")


def test_breakpoints_stop_a_run(editor: str, page: Page) -> None:
    open_simulation(page, editor)
    select_state(page, "FollowBall")
    page.keyboard.press("F9")
    expect(state(page, "FollowBall").locator(".breakpoint-sign")).to_have_count(1)
    page.get_by_role("button", name="Play or pause (F6)").click()
    expect(active(page)).to_have_attribute("data-id", "LookForBall")
    page.get_by_role("switch", name="Perception ball_seen").click()
    expect(page.get_by_text("Stopped on entering FollowBall")).to_be_visible()

    # A breakpoint on a transition, by the gutter of its guard.
    page.get_by_role("button", name="Breakpoint on → LookForBall").click()
    expect(page.locator('g.chip[data-id="FollowBall/0"] .breakpoint-sign')).to_have_count(1)
    page.get_by_role("spinbutton", name="Perception ball_age, number").fill("9")
    page.keyboard.press("F6")
    expect(page.get_by_text("Stopped at a breakpoint: the transition to LookForBall")).to_be_visible()
    page.keyboard.press("F9")
    expect(state(page, "FollowBall").locator(".breakpoint-sign")).to_have_count(0)


def test_an_edit_ends_the_run_and_offers_restart(editor: str, page: Page) -> None:
    open_simulation(page, editor)
    page.keyboard.press("F10")
    expect(active(page)).to_have_attribute("data-id", "LookForBall")
    select_state(page, "LookForBall")

    # Moving a box does not affect the run; another initial state does.
    page.keyboard.press("ArrowRight")
    select_state(page, "FollowBall")
    page.keyboard.press("F10")
    where(page, "iteration 2")
    page.get_by_role("checkbox", name="Initial").click()
    expect(page.get_by_text("The design has changed")).to_be_visible()
    page.get_by_role("button", name="Restart", exact=True).click()
    where(page, "before the first step")
    page.keyboard.press("F10")
    expect(active(page)).to_have_attribute("data-id", "FollowBall")


def test_the_player_plays_in_its_own_world(editor: str, page: Page) -> None:
    open_simulation(page, editor)
    choose(page, "Simulate with", "All components run in field.world:World")
    page.get_by_role("button", name="Run until the state changes (Shift+F6)").click()
    expect(page.get_by_text("Entered FollowBall")).to_be_visible()
    expect(page.get_by_text("No inputs: all components run.")).to_be_visible()
    time = page.get_by_role("spinbutton", name="Go to this time")
    time.fill("1.00")
    time.press("Enter")
    where(page, "1.00 s · iteration 61")
    expect(page.get_by_text("Viewing the past:")).to_be_visible()


def test_an_endless_loop_in_the_panel_is_reported_with_its_line(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "player.yaml"
    text = file.read_text()
    file.write_text(text.replace('log = logging.getLogger("player")', 'print("<b>loaded</b>")\n    log = None'))
    open_simulation(page, editor)
    page.keyboard.press("F10")
    where(page, "iteration 1")
    page.get_by_role("tab", name="Output").click()
    expect(page.get_by_text("<b>loaded</b>")).to_be_visible()
    file.write_text(text.replace("self._distances: list[float] = []", "while True: pass"))
    expect(page.get_by_text("The design has changed")).to_be_visible()
    select_state(page, "WatchBall")
    page.get_by_role("checkbox", name="Initial").click()
    expect(state(page, "WatchBall")).to_have_attribute("aria-label", re.compile("initial"))
    page.keyboard.press("F10")
    expect(page.locator(".simulation-message")).to_contain_text(
        "Player, state WatchBall, WatchBall.enter, line 1: did not end within 2 s"
    )


def test_a_recorded_trace_is_viewed(editor: str, page: Page, tmp_path: Path) -> None:
    trace = tmp_path / "trace.jsonl"
    root = {"component": "Player", "by": None, "link": "root", "changed_from": None, "values": {"kicks": 0}}
    lines = [{"iteration": 1, "time_ns": 0, "tree": [{**root, "state": "LookForBall"}]}]
    lines.append(
        {"iteration": 2, "time_ns": 10**8, "tree": [{**root, "state": "GetUp", "changed_from": "LookForBall"}]}
    )
    trace.write_text("\n".join(json.dumps(line) for line in [{"vicode-trace": 1, "runtime": "bica"}, *lines]))
    open_simulation(page, editor)
    choose(page, "Simulate with", "View a trace")
    with page.expect_file_chooser() as chooser:
        page.get_by_role("button", name="Choose a trace…").click()
    chooser.value.set_files(trace)
    expect(page.get_by_role("button", name="trace.jsonl")).to_be_visible()
    where(page, "before the first step")
    page.keyboard.press("Shift+F6")
    where(page, "0.10 s · iteration 2 · GetUp")
    expect(active(page)).to_have_attribute("data-id", "GetUp")
    expect(page.locator('g.edge.taken[data-id="@common/0"]')).to_have_count(1)
    page.keyboard.press("Control+Shift+F10")
    expect(active(page)).to_have_attribute("data-id", "LookForBall")


def write_match(path: Path, change: int) -> None:
    """A long trace, in which the state changes after so many iterations."""
    root = {"component": "Player", "by": None, "link": "root", "changed_from": None, "transition": None}
    lines: list[object] = [{"vicode-trace": 1, "runtime": "bica"}]
    for number in range(3000):
        name = "LookForBall" if number < change else "GetUp"
        changed = {"changed_from": "LookForBall"} if number == change else {}
        step = {**root, **changed, "state": name, "values": {"kicks": number // 100}}
        lines.append({"iteration": number + 1, "time_ns": number * 22 * 10**6, "tree": [step]})
    path.write_text("\n".join(json.dumps(line) for line in lines) + "\n")


def test_a_trace_of_the_project_folder_is_viewed_at_a_time(editor: str, page: Page, project: Path) -> None:
    write_match(project / "forward" / "match.jsonl", 1500)
    open_simulation(page, editor)
    choose(page, "Simulate with", "View a trace")
    choose(page, "Trace in the project folder", "match.jsonl")
    where(page, "before the first step")
    page.get_by_label("Go to this time").fill("44")
    page.get_by_label("Go to this time").press("Enter")
    where(page, "44.00 s · iteration 2001 · GetUp")
    expect(page.locator("svg.plot rect.plot-state")).to_have_count(2)


def test_a_heat_map_and_the_first_difference_from_another_trace(editor: str, page: Page, project: Path) -> None:
    write_match(project / "forward" / "first.jsonl", 1500)
    write_match(project / "forward" / "second.jsonl", 1000)
    open_simulation(page, editor)
    choose(page, "Simulate with", "View a trace")
    choose(page, "Trace in the project folder", "first.jsonl")
    where(page, "before the first step")
    page.get_by_text("Heat map", exact=True).click()
    expect(page.locator("g.node.heat-red")).to_have_count(1)
    expect(state(page, "LookForBall")).to_have_class(re.compile("heat-red"))
    expect(state(page, "GetUp")).to_have_class(re.compile("heat-orange"))
    expect(state(page, "Kick")).to_have_class(re.compile("heat-never"))
    expect(page.locator('g.edge.heat-red[data-id="@common/0"]')).to_have_count(1)
    choose(page, "Compare with", "second.jsonl")
    expect(page.get_by_text("First difference at 22.00 s: Player is LookForBall here, GetUp there.")).to_be_visible()
    page.get_by_role("button", name="Show the first difference").click()
    where(page, "22.00 s · iteration 1001 · LookForBall")
    page.get_by_text("Heat map", exact=True).click()
    expect(page.locator("g.node.heat-red")).to_have_count(0)


def test_the_menu_runs_to_a_state_and_sets_breakpoints(editor: str, page: Page) -> None:
    open_simulation(page, editor)
    expect(state(page, "FollowBall")).to_be_in_viewport()
    page.wait_for_function("document.querySelector('.vicode-canvas').vicode.view().resting")
    select_state(page, "LookForBall")
    page.keyboard.press("Shift+F10")
    page.get_by_role("menuitem", name="Toggle breakpoint").click()
    expect(state(page, "LookForBall").locator(".breakpoint-sign")).to_have_count(1)
    select_state(page, "FollowBall")
    page.keyboard.press("Control+F10")
    expect(page.get_by_text("Stopped on entering LookForBall")).to_be_visible()
    page.get_by_role("switch", name="Perception ball_seen").click()
    select_state(page, "FollowBall")
    page.keyboard.press("Control+F10")
    expect(page.get_by_text("Stopped on entering FollowBall")).to_be_visible()


@pytest.mark.nightly
def test_a_long_run_is_paused_and_browsed(editor: str, page: Page) -> None:
    open_simulation(page, editor)
    page.keyboard.press("Shift+F6")
    where(page, "iteration 1")
    page.get_by_role("button", name="Play or pause (F6)").click()
    expect(page.get_by_text("Paused")).to_be_visible()
    slider = page.get_by_role("slider", name="Shown iteration")
    slider.focus()
    slider.press("Home")
    expect(page.get_by_text("before the first step")).to_be_visible()
    slider.press("ArrowRight")
    where(page, "0.00 s · iteration 1 ·")
    page.get_by_role("button", name="Continue from here").click()
    expect(page.get_by_text("Viewing the past:")).to_have_count(0)
    page.keyboard.press("F10")
    where(page, "0.02 s · iteration 2 ·")


def test_untrusted_texts_are_escaped_in_the_simulation(editor: str, page: Page, project: Path) -> None:
    evil = "<img src=x onerror=document.title='owned'>\"' {{7*7}}"
    quoted = json.dumps(evil)
    file = project / "forward" / "project.yaml"
    eye = (
        f"  Eye:\n    implementation: hands:Eye\n    outputs:\n      seen: {{type: bool, doc: {quoted}}}\n"
        f"      far: {{type: float, range: [0, 9], unit: {quoted}}}\n"
    )
    file.write_text(file.read_text().replace("\ncomponents:\n", f"\ncomponents:\n{eye}"))
    (project / "forward" / "watcher.yaml").write_text(
        "vicode: 1\ncomponent: Watcher\nuses: {eye: Eye}\ninitial: Off\nstates:\n"
        f"  Off: {{doc: {quoted}, requires: [eye], transitions: [{{to: On, when: eye.seen, doc: {quoted}}}]}}\n"
        "  On:\n    actions:\n      - code: |\n"
        f"          print({evil!r})\n          raise ValueError({evil!r})\n"
    )
    open_player(page, editor)
    expect(page.get_by_role("link", name="Watcher")).to_be_visible()
    open_simulation(page, editor, "design/forward/Watcher")
    page.keyboard.press("F10")
    where(page, "iteration 1")
    page.get_by_text("seen", exact=True).hover()
    page.get_by_role("switch", name="Eye seen").click()
    page.keyboard.press("F10")
    expect(page.locator(".simulation-message")).to_contain_text("Watcher, state On, On.actions, line 2: ValueError:")
    expect(page.locator(".simulation-message")).to_contain_text("onerror")
    page.get_by_role("tab", name="Output").click()
    expect(page.locator(".output-line").first).to_contain_text("<img src=x")
    page.get_by_role("tab", name="Active components").click()
    expect(page.locator(".tree-row").first).to_be_visible()
    assert page.locator("img[src=x]").count() == 0
    assert "owned" not in page.title()


@pytest.mark.nightly
@pytest.mark.parametrize("colors", ["light", "dark"])
def test_axe_reports_nothing_during_a_simulation(editor: str, page: Page, colors: str) -> None:
    page.emulate_media(color_scheme="dark" if colors == "dark" else "light", reduced_motion="reduce")
    open_simulation(page, editor)
    found = complaints(page)
    page.keyboard.press("F10")
    where(page, "iteration 1")
    page.get_by_text("Run options").click()
    expect(page.get_by_label("Seed of the world")).to_be_visible()
    for tab in ("Plot", "Active components", "Output"):
        page.get_by_role("tab", name=tab).click()
        expect(page.get_by_role("tab", name=tab)).to_have_attribute("aria-selected", "true")
        found += complaints(page)
    page.keyboard.press("Control+Shift+F10")
    expect(page.get_by_text("Viewing the past:")).to_be_visible()
    found += complaints(page)
    assert not found, "\n".join(found)


def test_simulate_asks_once_before_it_runs_the_code_of_a_folder(
    page: Page, project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VICODE_SANDBOX", "off")
    storage = tmp_path / "untrusted"
    with started_editor(project, storage, is_trusted=False) as url:
        open_simulation(page, url)
        page.keyboard.press("F10")
        dialog = page.get_by_role("dialog", name="Trust this folder?")
        dialog.get_by_role("button", name="Cancel").click()
        expect(page.locator(".simulation-message")).to_contain_text("The folder is not trusted")
        expect(dialog).to_have_count(0)
        page.keyboard.press("F10")
        expect(dialog).to_contain_text("without a sandbox, with all rights of your user account: VICODE_SANDBOX is off")
        dialog.get_by_role("button", name="Trust and simulate").click()
        where(page, "0.00 s · iteration 1")
        expect(page.locator(".simulation-message")).to_contain_text("without a sandbox")
        # Once: another window is not asked.
        open_simulation(page, url)
        page.keyboard.press("F10")
        where(page, "0.00 s · iteration 1")
        page.goto("about:blank")
    assert json.loads((storage / "state" / "trusted").read_text()) == str((project / "forward").resolve())


def test_the_command_for_the_terminal_lists_what_was_set(editor: str, page: Page, project: Path) -> None:
    open_simulation(page, editor)
    command = page.get_by_role("button", name="Run this in the terminal…")
    expect(command).to_be_disabled()
    page.keyboard.press("F10")
    where(page, "iteration 1 ·")
    page.get_by_role("switch", name="Perception ball_seen").click()
    page.get_by_role("button", name="Step (F10)").click()
    where(page, "iteration 2 ·")
    command.click()
    dialog = page.get_by_role("dialog", name="Run this in the terminal")
    path = project / "forward" / "player.yaml"
    shown = dialog.get_by_role("group", name="Command")
    expect(shown).to_have_text(f"vicode run {path} --set '0.016666667 s: Perception.ball_seen=true' --ticks 2")
    assert not complaints(page)


def test_a_selected_state_tells_why_it_is_not_active(editor: str, page: Page) -> None:
    open_simulation(page, editor)
    page.keyboard.press("F10")
    where(page, "iteration 1 · LookForBall")
    select_state(page, "FollowBall")
    section = page.locator(".why-not")
    expect(section).to_contain_text("Why not FollowBall?")
    expect(section.locator(".why-not-condition").first).to_contain_text("perception.ball_seen = false")
    page.keyboard.press("F10")
    where(page, "iteration 2 ·")
    expect(section.locator(".why-not-condition").first).to_contain_text("for 0.02 s")
    assert not complaints(page)
    select_state(page, "LookForBall")
    expect(section).to_be_hidden()
