"""A running robot in the browser: the active state on the canvas, control, and tuning."""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.cli.command_runner import vicode
from tests.editor.conftest import started_editor
from tests.editor.player_page import state
from tests.editor.simulation.robot_program import RobotProgram, running_robot, write_robot
from tests.editor.test_accessibility_browser import complaints

expect.set_options(timeout=20_000)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return write_robot(tmp_path / "designs" / "lamps")


@pytest.fixture
def robot(folder: Path) -> Iterator[RobotProgram]:
    with running_robot(folder) as program:
        yield program


def active(page: Page) -> Locator:
    return page.locator("g.node.active")


def open_lamp(page: Page, url: str) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(url + "design/lamps/Lamp")
    expect(state(page, "Dark")).to_be_visible()


def test_the_active_state_is_shown_at_once(robot: RobotProgram, folder: Path, tmp_path: Path, page: Page) -> None:
    attaching = ("attach", robot.address, str(folder.parent), "--token", robot.token)
    with started_editor(folder.parent, tmp_path / "storage", (), command=attaching) as url:
        open_lamp(page, url)
        expect(active(page)).to_have_attribute("data-id", "Dark")
        guard = page.locator(".guard", has_text="→ Lit")
        expect(guard).to_contain_text("false")
        expect(guard).to_contain_text("eye.seen = false, eye.light = 3")
        state(page, "Lit").click()
        since = page.locator(".why-not-condition").first
        # It is false from the start, which the window did not see.
        expect(since).to_contain_text(re.compile(r"eye\.seen = false, for (more than )?\d+\.\d\d s"))
        robot.eye.seen = True
        expect(active(page)).to_have_attribute("data-id", "Lit")
        expect(page.locator('g.edge.taken[data-id="Dark/0"]')).to_have_count(1)
        expect(page.locator(".robot-card.is-followed")).to_contain_text("Lit")
        assert not complaints(page)


def test_a_slow_browser_answers_clicks_while_a_robot_runs(
    robot: RobotProgram, folder: Path, tmp_path: Path, page: Page
) -> None:
    attaching = ("attach", robot.address, str(folder.parent), "--token", robot.token)
    with started_editor(folder.parent, tmp_path / "storage", (), command=attaching) as url:
        open_lamp(page, url)
        expect(active(page)).to_have_attribute("data-id", "Dark")
        page.context.new_cdp_session(page).send("Emulation.setCPUThrottlingRate", {"rate": 20})
        # Long enough for changes to queue up.
        page.wait_for_timeout(2000)
        state(page, "Lit").click()
        expect(page.locator(".why-not-condition").first).to_be_visible()


def test_a_robot_is_paused_stepped_and_changed(robot: RobotProgram, editor_of: str, page: Page) -> None:
    open_lamp(page, editor_of)
    page.get_by_role("tab", name="Simulate").click()
    page.get_by_role("combobox", name="Simulate with").click()
    page.get_by_role("option", name="Robot").click()
    page.get_by_label("Address").fill(robot.address)
    page.get_by_label("Token").fill(robot.token)
    page.get_by_role("button", name="Attach", exact=True).click()
    expect(active(page)).to_have_attribute("data-id", "Dark")

    page.get_by_role("button", name="Play or pause (F6)").click()
    expect(page.get_by_text(re.compile("^Paused: Lamp at"))).to_be_visible()
    page.get_by_role("button", name="Set Eye.seen").click()
    page.get_by_role("textbox", name="Value").fill("true")
    page.get_by_role("button", name="Set once").click()
    expect(active(page)).to_have_attribute("data-id", "Dark")
    page.get_by_role("button", name="Step (F10)").click()
    expect(active(page)).to_have_attribute("data-id", "Lit")

    state(page, "Dark").click(button="right")
    page.get_by_role("menuitem", name="Go to this state").click()
    page.get_by_role("button", name="Play or pause (F6)").click()
    expect(page.get_by_text(re.compile("^Live: Lamp at"))).to_be_visible()
    page.get_by_role("button", name="Disconnect").click()
    expect(page.get_by_text("Not attached. Enter the address")).to_be_visible()
    state(page, "Dark").click(button="right")
    expect(page.get_by_role("menuitem", name="Toggle breakpoint")).to_be_visible()
    expect(page.get_by_role("menuitem", name="Go to this state")).to_have_count(0)


@pytest.fixture
def editor_of(folder: Path, tmp_path: Path) -> Iterator[str]:
    with started_editor(folder.parent, tmp_path / "storage") as url:
        yield url


def run_lamp(folder: Path, trace: Path) -> list[str]:
    """The states of a run in which a light of 20 is seen after 0.5 s."""
    inputs = ("--set", "500ms: Eye.seen=true", "--set", "Eye.light=20")
    assert vicode("run", str(folder / "lamp.yaml"), "--ticks", "100", "--values", "--trace", str(trace), *inputs) == 0
    lines = [json.loads(line) for line in trace.read_text().splitlines()]
    return [line["tree"][0]["state"] for line in lines if "tree" in line]


def test_a_tuned_constant_is_written_back(robot: RobotProgram, folder: Path, tmp_path: Path, page: Page) -> None:
    before = run_lamp(folder, folder / "run.jsonl")
    attaching = ("attach", robot.address, str(folder.parent), "--token", robot.token)
    with started_editor(folder.parent, tmp_path / "attached", (), command=attaching) as url:
        open_lamp(page, url)
        robot.eye.seen, robot.eye.light = True, 20.0
        expect(page.locator(".guard", has_text="→ Lit")).to_contain_text("false")
        page.get_by_role("spinbutton", name="Tune bright, number").fill("30")
        expect(active(page)).to_have_attribute("data-id", "Lit")
        assert page.locator(".robot-tuning").evaluate("form => form.scrollWidth <= form.clientWidth")
        page.get_by_role("button", name="Write bright back").click()
        dialog = page.get_by_role("dialog", name="Write bright = 30")
        live = dialog.locator(".write-back-result", has_text="This robot, so far: ")
        expect(live).to_contain_text("Lamp: Dark → Lit instead of staying")
        told = dialog.locator(".write-back-result", has_text="Trace run.jsonl: ")
        expect(told).to_contain_text("iterations change")
        expect(dialog.get_by_text("Replaying recorded runs…")).to_be_hidden()
        expect(dialog).to_contain_text("The recorded inputs do not react to the changed behavior.")
        assert not complaints(page)
        words = told.inner_text()
        dialog.get_by_role("button", name="Write into the file").click()
        expect(page.get_by_role("button", name="Write bright back")).to_be_hidden()
        assert "bright: {value: 30, tunable: true, range: [0, 50]}" in (folder / "project.yaml").read_text()
        # The same run of the changed file.
        after = run_lamp(folder, tmp_path / "after.jsonl")
        numbers = [number for number, states in enumerate(zip(before, after, strict=True)) if states[0] != states[1]]
        assert f"{len(numbers)} of 100 iterations change; first at {numbers[0] * 0.02:.3f} s" in words
        page.keyboard.press("Control+z")
        expect(page.get_by_role("button", name="Write bright back")).to_be_visible()
        assert "bright: {value: 10," in (folder / "project.yaml").read_text()


def type_command(page: Page, text: str) -> None:
    page.get_by_label("Command", exact=True).press_sequentially(text)
    page.keyboard.press("Enter")


def test_commands_are_typed_in_the_console(robot: RobotProgram, folder: Path, tmp_path: Path, page: Page) -> None:
    attaching = ("attach", robot.address, str(folder.parent), "--token", robot.token)
    with started_editor(folder.parent, tmp_path / "storage", (), command=attaching) as url:
        open_lamp(page, url)
        expect(active(page)).to_have_attribute("data-id", "Dark")
        page.get_by_role("tab", name="Console").click()
        # Without a pause between the keys, and with those of commands of the canvas.
        for command in (
            "pause",
            "set eye.seen true",
            "hold eye.light 4",
            "step 2",
            "print eye.seen and eye.light < bright",
        ):
            type_command(page, command)
        answers = page.get_by_role("log", name="Answers")
        expect(answers.locator(".console-row").first).to_have_text("eye.seen and eye.light < bright = true")
        expect(answers.locator(".console-command")).to_have_text(
            [
                "> print eye.seen and eye.light < bright",
                "> step 2",
                "> hold eye.light 4",
                "> set eye.seen true",
                "> pause",
            ]
        )
        expect(active(page)).to_have_attribute("data-id", "Lit")
        expect(state(page, "Dark")).to_be_visible()
        field = page.get_by_label("Command", exact=True)
        page.keyboard.press("ArrowUp")
        page.keyboard.press("ArrowUp")
        expect(field).to_have_value("step 2")
        page.keyboard.press("ArrowDown")
        page.keyboard.press("ArrowDown")
        expect(field).to_have_value("")
        page.keyboard.type("set eye.l")
        page.keyboard.press("Tab")
        expect(field).to_have_value("set eye.light ")
        type_command(page, "500")
        expect(answers.locator(".error")).to_have_text("'500' is no value of Eye.light: it must be from 0 to 100 lx")
        page.keyboard.type("go D")
        page.keyboard.press("Tab")
        expect(field).to_have_value("go Dark ")
        assert not complaints(page)
        page.keyboard.press("Enter")
        type_command(page, "break Dark -> Lit")
        expect(page.locator('[data-id="Dark/0"] .breakpoint-sign')).not_to_have_count(0)
