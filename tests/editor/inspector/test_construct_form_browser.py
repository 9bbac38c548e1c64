"""Latches, interrupts, steps and layers are written in the inspector; files and runs of the design are the oracle."""

import re
import shutil
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.editor.conftest import ROOT
from tests.editor.player_page import save, state
from tests.editor.slow_connection import SlowConnection
from vicode.cli import main

MENU = "Add Latch, interrupt…"
CHARGING = ("--set", "Rover.battery=10", "--set", "Rover.ahead=3", "--set", "0.1 s: Rover.bumped=true")


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A folder with the project `styles`, free to be changed."""
    folder = tmp_path / "designs"
    shutil.copytree(ROOT / "designs" / "styles", folder / "styles", ignore=shutil.ignore_patterns("__pycache__"))
    return folder


def open_design(page: Page, url: str, component: str, select: str = "") -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(f"{url}design/styles/{component}" + (f"?select={select}" if select else ""))
    expect(state(page, "Wander")).to_be_visible()
    page.wait_for_function("window.did_handshake")


def group(page: Page, name: str) -> Locator:
    return page.get_by_role("group", name=name, exact=True)


def code(within: Locator, label: str) -> Locator:
    return within.get_by_role("textbox", name=label, exact=True)


def changes(file: Path, capsys: pytest.CaptureFixture[str], *arguments: str) -> list[str]:
    """The states that a run enters."""
    capsys.readouterr()
    assert main(["run", str(file), "--plain", "--ticks", "20", *arguments]) == 0
    return re.findall(r"→ (\w+)", capsys.readouterr().out)


def no_findings(file: Path, capsys: pytest.CaptureFixture[str]) -> bool:
    capsys.readouterr()
    return main(["check", "--strict", str(file)]) == 0


@pytest.mark.parametrize("key_ms", [0, 30])
def test_a_latch_is_added_and_filled_in_while_the_server_is_silent(
    editor: str, page: Page, project: Path, line: SlowConnection, capsys: pytest.CaptureFixture[str], key_ms: int
) -> None:
    file = project / "styles" / "by_states.yaml"
    open_design(page, editor, "ByStates")
    expect(page.get_by_text("Latches", exact=True)).to_have_count(0)
    page.get_by_role("button", name=MENU).click()
    expect(page.get_by_role("menuitem", name="Competence")).to_have_attribute("aria-disabled", "true")
    line.hold()
    page.get_by_role("menuitem", name="Latch").click()
    page.keyboard.type("shaken", delay=key_ms)
    page.keyboard.press("Tab")
    page.keyboard.type("1.5", delay=key_ms)
    code(group(page, "latch latch"), "On").click()
    page.keyboard.type("rover.bumped", delay=key_ms)
    line.release()
    expect(group(page, "latch shaken")).to_be_visible()
    assert "latches:\n  shaken: {on: rover.bumped, hold: 1.5}\n" in save(page, file)
    assert no_findings(file, capsys)

    # Guards read it, and a new name reaches them.
    text = file.read_text().replace("{to: BackOff, when: rover.bumped}", "{to: BackOff, when: shaken}", 1)
    file.write_text(text)
    open_design(page, editor, "ByStates")
    group(page, "latch shaken").get_by_text("shaken").first.click()
    name = group(page, "latch shaken").get_by_role("textbox", name="Name")
    name.fill("hit")
    name.press("Enter")
    expect(group(page, "latch hit")).to_be_visible()
    assert "{to: BackOff, when: hit}" in save(page, file)
    run = changes(
        file, capsys, "--set", "Rover.battery=50", "--set", "Rover.ahead=3", "--set", "0.1 s: Rover.bumped=true"
    )
    assert run == ["BackOff"]


def test_an_interrupt_is_edited_where_its_transition_is_selected(
    editor: str, page: Page, project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = project / "styles" / "by_interrupts.yaml"
    open_design(page, editor, "ByInterrupts", "Wander")
    page.get_by_role("button", name="→ Charge").click()
    inspector = page.get_by_label("Inspector")
    when = code(inspector, "When")
    when.click()
    page.keyboard.press("Control+a")
    page.keyboard.type("rover.battery < 30 and not rover.bumped")
    page.keyboard.press("Tab")
    # Without a condition there would be no transition: the form would close while it is typed anew.
    when.click()
    page.keyboard.press("Control+a")
    page.keyboard.press("Delete")
    expect(inspector.get_by_text("This is required")).to_be_visible()
    page.keyboard.type("rover.battery < 30")
    inspector.get_by_label("Then").click()
    expect(page.get_by_role("option")).to_have_text(
        ["resume", "restart", "skip", "done", "fail", "Wander", "Avoid", "BackOff", "Charge"]
    )
    page.get_by_role("option", name="Avoid").click()
    expect(inspector.get_by_label("Then")).to_have_value("Avoid")
    saved = save(page, file)
    assert "  - {do: Charge, when: rover.battery < 30, until: rover.battery > full, then: Avoid}\n" in saved
    assert no_findings(file, capsys)
    battery = ("--set", "Rover.battery=25", "--set", "Rover.ahead=0.1", "--set", "0.1 s: Rover.battery=95")
    assert changes(file, capsys, *battery) == ["Charge", "Avoid"]
    page.get_by_role("button", name="Undo").click()
    expect(inspector.get_by_label("Then")).to_have_value("resume")


def test_steps_are_reordered_and_edited_by_two_windows(
    editor: str, page: Page, other: Page, project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = project / "styles" / "by_competence.yaml"
    assert changes(file, capsys, *CHARGING) == ["Wander", "Charge", "BackOff"]
    for each in (page, other):
        open_design(each, editor, "ByCompetence")
    page.get_by_role("button", name="Move up: 2 Charge").click()
    expect(other.get_by_role("button", name="Move up: 2 BackOff")).to_be_visible()
    # The other person sees the same step as a state, whose form it is.
    state(other, "Avoid").click()
    retries = other.get_by_label("Inspector").get_by_label("Retries")
    retries.fill("x")
    expect(other.get_by_text("this is not a valid value")).to_be_visible()
    retries.fill("4")
    group(page, "step Avoid").get_by_text("Avoid").first.click()
    expect(group(page, "step Avoid").get_by_label("Retries")).to_have_value("4")
    name = other.get_by_label("Inspector").get_by_role("textbox", name="Name")
    name.fill("TurnAway")
    name.press("Enter")
    expect(state(other, "TurnAway")).to_be_visible()
    expect(name).to_have_value("TurnAway")
    saved = save(page, file)
    steps = re.findall(r"^    (\w+): \{", saved, re.MULTILINE)
    assert steps == ["Charge", "BackOff", "TurnAway", "Wander"]
    assert "TurnAway: {when: rover.ahead < near, retries: 4, modulates: {drive: {turn: 60}}}" in saved
    assert changes(file, capsys, *CHARGING) == ["Wander", "Charge"]


def test_layers_are_written_from_nothing(
    editor: str, page: Page, project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = project / "styles" / "by_states.yaml"
    file.write_text(
        "vicode: 1\ncomponent: ByStates\nuses: {rover: Rover, drive: Drive}\nlayers:\n  Wander: {modulates: [drive]}\n"
    )
    open_design(page, editor, "ByStates")
    page.get_by_role("button", name="Add layer").click()
    page.keyboard.type("Stop")
    page.keyboard.press("Enter")
    stop = group(page, "layer Stop")
    code(stop, "When").click()
    page.keyboard.type("rover.bumped")
    stop.get_by_role("button", name="Add to design/layers").click()
    page.get_by_role("menuitem", name="drive").click()
    page.keyboard.type("speed = -1")
    assert "  Stop: {when: rover.bumped, modulates: {drive: {speed: -1}}}\n" in save(page, file)
    assert no_findings(file, capsys)
    assert changes(file, capsys, *CHARGING) == ["Stop"]


@pytest.mark.parametrize(("kind", "typed"), [("Latch", "dark"), ("Interrupt", "rover.bumped")])
def test_what_a_menu_added_has_the_focus(editor: str, page: Page, kind: str, typed: str) -> None:
    open_design(page, editor, "ByStates")
    page.get_by_role("button", name=MENU).click()
    page.get_by_role("menuitem", name=kind).first.click()
    added = page.locator(f"[data-card^='design/{kind.lower()}']").last
    focused = added.locator("input:focus, .cm-content:focus")
    expect(focused).to_have_count(1)
    page.keyboard.type(typed)
    content = focused.input_value() if kind == "Latch" else focused.inner_text()
    assert content.strip() == typed
