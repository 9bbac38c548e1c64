"""Interrupts and competences on the canvas: one edge for each rule, which lights up for each of its transitions."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml
from playwright.sync_api import Page, expect

from tests.editor.conftest import started_editor

STYLES = Path(__file__).parents[2] / "designs" / "styles"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "styles"
    shutil.copytree(STYLES, folder)
    settings = folder / "project.yaml"
    settings.write_text(settings.read_text().replace("../../generated", "generated"))
    return folder


@pytest.fixture
def url(project: Path, tmp_path: Path) -> Iterator[str]:
    with started_editor(project, tmp_path / "storage") as url:
        yield url


def open_design(page: Page, url: str, name: str) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(url)
    page.locator(f"a[href*='/{name}']").first.click()
    expect(page.locator('g[data-kind="state"]').first).to_be_visible()


def test_the_edge_of_a_rule_lights_up_in_both_directions(url: str, page: Page) -> None:
    open_design(page, url, "ByInterrupts")
    edges = page.locator('g.edge[data-kind="transition"]')
    expect(edges).to_have_count(3)
    bumped = page.locator("g.edge.leads-back").first
    key = bumped.get_attribute("data-id")
    page.get_by_role("tab", name="Simulate").click()
    page.keyboard.press("F10")
    active, taken = page.locator("g.node.active"), page.locator("g.edge.taken")
    expect(active).to_have_attribute("data-id", "Charge")
    battery = page.get_by_role("spinbutton", name="Rover battery, number")
    battery.fill("100")
    ahead = page.get_by_role("spinbutton", name="Rover ahead, number")
    ahead.fill("2")
    page.keyboard.press("Tab")
    for _step in range(3):
        page.get_by_role("button", name="Step (F10)").click()
    expect(active).to_have_attribute("data-id", "Wander")
    there = taken.get_attribute("data-id")
    battery.fill("5")
    page.keyboard.press("Tab")
    for _step in range(2):
        page.get_by_role("button", name="Step (F10)").click()
    expect(active).to_have_attribute("data-id", "Charge")
    expect(taken).to_have_attribute("data-id", there)
    assert key != there


def test_a_step_is_moved_and_stays_there(url: str, project: Path, page: Page) -> None:
    open_design(page, url, "ByCompetence")
    step = page.locator('g.node[data-kind="state"][data-id="Charge"]')
    box = step.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 15, box["y"] + 12)
    page.mouse.down()
    page.mouse.move(box["x"] + 215, box["y"] + 62, steps=6)
    page.mouse.up()
    page.keyboard.press("Control+s")
    expect(page.locator(".q-notification__message", has_text="Saved")).to_be_visible()
    positions = yaml.safe_load((project / "by_competence.yaml").read_text())["positions"]
    assert positions["Charge"][0] > positions["BackOff"][0] + 150
    page.reload()
    moved = step.bounding_box()
    other = page.locator('g.node[data-kind="state"][data-id="BackOff"]').bounding_box()
    assert moved is not None
    assert other is not None
    assert moved["x"] > other["x"] + 100
