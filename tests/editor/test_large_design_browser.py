"""A design of thousands of states: drawn first, its panels after it, and everything still in sight then."""

from pathlib import Path

from playwright.sync_api import Page, expect

from tests.diagram.diagram_designs import ring_design
from vicode.store import save_design, write_text


def test_a_large_design_is_drawn_and_its_panels_follow(editor: str, page: Page, project: Path) -> None:
    write_text(project / "forward" / "ring.yaml", save_design(ring_design(600, chords=1), ""))
    page.goto(editor + "design/forward/Ring", timeout=60_000)
    expect(page.locator(".vicode-canvas[data-ready]")).to_be_visible(timeout=120_000)
    expect(page.get_by_label("Inspector").get_by_text("Initial state")).to_be_visible(timeout=120_000)
    expect(page.get_by_label("Findings").get_by_label("Filter")).to_be_visible()
    # The panels took some of the room: what nobody has moved is fitted in again.
    page.wait_for_function(
        """() => {
          const canvas = document.querySelector('.vicode-canvas');
          const {x, y, k, resting} = canvas.vicode.view();
          const {height} = canvas.getBoundingClientRect();
          return resting && Object.values(canvas.vicode.positions()).every(at => (at.y + at.h / 2) * k + y < height);
        }"""
    )
