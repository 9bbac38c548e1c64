"""The first machine of a newcomer: from an empty folder to a component that runs."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.editor.conftest import started_editor
from tests.editor.player_page import state
from vicode.cli import main

expect.set_options(timeout=20_000)
GUARDS = {"Idle": "order_given", "TakeOrder": "order_ready", "Serve": "battery < 20"}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    path = tmp_path / "waiter"
    path.mkdir()
    return path


@pytest.fixture
def url(folder: Path, tmp_path: Path) -> Iterator[str]:
    with started_editor(folder, tmp_path / "storage") as address:
        yield address


def test_a_first_machine_is_drawn_simulated_generated_and_run(
    url: str, page: Page, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(url)
    page.get_by_role("button", name="Create your first design").click()
    expect(page.get_by_label("Component", exact=True)).to_be_focused()
    type_and_enter(page, "Waiter")
    draw_states(page)
    for name, guard in GUARDS.items():
        add_guard_with_new_input(page, name, guard)
    inspector = page.get_by_label("Inspector")
    add_command(page)
    state(page, "Charge").click()
    inspector.get_by_role("button", name="Code").first.click()
    expect(inspector.get_by_role("textbox", name="Python")).to_be_focused()
    page.keyboard.type("print('charging')", delay=30)
    simulate(page)
    page.get_by_role("button", name="Generate").click()
    page.get_by_role("button", name="Write").click()
    expect(page.get_by_text("Generated __init__.py, __main__.py, interfaces.py, waiter.py")).to_be_visible()

    assert sorted(path.name for path in (folder / "generated").rglob("*.py")) == [
        "__init__.py",
        "__main__.py",
        "interfaces.py",
        "waiter.py",
    ]
    assert main(["check", str(folder)]) == 0
    assert main(["run", str(folder / "waiter.yaml"), "--seconds", "1"]) == 0
    assert "last state: Idle" in capsys.readouterr().out


def type_and_enter(page: Page, text: str) -> None:
    page.keyboard.type(text, delay=30)
    page.keyboard.press("Enter")


def draw_states(page: Page) -> None:
    """Draw a cycle of five states, the last of which waits for three seconds."""
    state(page, "Start").click()
    page.keyboard.press("F2")
    page.keyboard.press("Control+a")
    type_and_enter(page, "Idle")
    expect(state(page, "Idle")).to_be_visible()
    for name in ("TakeOrder", "Serve", "Charge", "Wait"):
        page.keyboard.press("n")
        type_and_enter(page, name)
        expect(state(page, name)).to_be_visible()
    page.keyboard.press("t")
    type_and_enter(page, "idle")
    expect(page.get_by_label("Inspector").get_by_text("Transition from")).to_be_visible()
    page.keyboard.press("Enter")
    expect(page.get_by_label("When", exact=True)).to_be_focused()
    page.keyboard.press("Tab")
    page.keyboard.type("3")
    expect(page.locator('g.item[data-id="Wait/0"][aria-label*="3 s"]')).to_have_count(1)


def add_guard_with_new_input(page: Page, name: str, guard: str) -> None:
    state(page, name).click()
    expect(page.get_by_label("State", exact=True)).to_have_value(name)
    inspector = page.get_by_label("Inspector")
    inspector.locator(".decision").first.click()
    page.get_by_label("When", exact=True).click()
    page.keyboard.type(guard, delay=30)
    expect(inspector.locator(".field-message")).to_contain_text(f"'{guard.split(maxsplit=1)[0]}' is not declared")
    inspector.get_by_role("button", name="Fix").click()
    page.get_by_role("menuitem", name=f"Create input {guard.split(maxsplit=1)[0]} ").click()
    expect(page.get_by_label("When", exact=True)).to_have_text(f"sensors.{guard}")


def add_command(page: Page) -> None:
    """Let the state Serve modulate a new component."""
    page.keyboard.press("Escape")
    page.mouse.click(300, 560)
    inspector = page.get_by_label("Inspector")
    inspector.get_by_label("New command").fill("walk")
    inspector.get_by_label("Parameters", exact=True).fill("speed")
    page.keyboard.press("Enter")
    expect(page.locator('g[data-kind="component"][data-id="walk"]')).to_be_visible()
    state(page, "Serve").click()
    expect(page.get_by_label("State", exact=True)).to_have_value("Serve")
    page.keyboard.press("t")
    type_and_enter(page, "walk")
    expect(page.locator('g.item[data-kind="link"][data-id$="/Serve/walk"]')).to_have_count(1)
    expect(page.get_by_label("Findings", exact=True).get_by_text("No problems found")).to_be_visible()


def simulate(page: Page) -> None:
    page.get_by_role("tab", name="Simulate").click()
    page.keyboard.press("F10")
    where = page.locator(".simulation-where")
    expect(where).to_contain_text("Idle")
    page.get_by_role("switch", name="order_given").click()
    page.keyboard.press("F10")
    expect(where).to_contain_text("TakeOrder")
