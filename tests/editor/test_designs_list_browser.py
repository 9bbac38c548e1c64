"""The list of a large project's designs: long names are whole, and a part of a name finds one."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.editor.conftest import started_editor

expect.set_options(timeout=20_000)

WORDS = ("stand", "defend_corner_of_our_half", "kick_off")


@pytest.fixture
def team(tmp_path: Path) -> Iterator[str]:
    """The URL of an editor on thirty designs and one that cannot be read."""
    folder = tmp_path / "designs" / "team"
    folder.mkdir(parents=True)
    for number in range(30):
        name = f"{WORDS[number % 3]}_{number}"
        text = f"vicode: 1\ncomponent: {name}\ninitial: Up\nstates: {{Up: {{}}}}\n"
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    (folder / "bad.yaml").write_text("component: Bad\nstates: [\n", encoding="utf-8")
    with started_editor(tmp_path / "designs", tmp_path / "storage") as url:
        yield url


@pytest.fixture
def folders(tmp_path: Path) -> Iterator[str]:
    """The URL of an editor on a large project with folders."""
    project = tmp_path / "designs" / "team"
    for number in range(36):
        name, folder = f"Design{number}", project / ("", "Roles", "Skills/Ball")[number % 3]
        folder.mkdir(parents=True, exist_ok=True)
        text = f"vicode: 1\ncomponent: {name}\ninitial: Up\nstates: {{Up: {{}}}}\n"
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    with started_editor(tmp_path / "designs", tmp_path / "storage") as url:
        yield url


def test_designs_are_grouped_by_folder(folders: str, page: Page) -> None:
    page.goto(folders)
    cards, roles = page.get_by_role("article"), page.locator("summary").filter(has_text="Roles")
    expect(cards).to_have_count(12)
    expect(page.locator("summary")).to_have_text(
        [re.compile("Roles.*12 designs"), re.compile("Skills/Ball.*12 designs")]
    )
    roles.click()
    expect(cards).to_have_count(24)
    # A search opens the folders of what it finds; then they are as before.
    search = page.get_by_label("Search designs").last
    search.fill("Design2")
    expect(cards).to_have_count(11)
    search.fill("")
    expect(cards).to_have_count(24)
    cards.get_by_role("link", name="Design1", exact=True).click()
    rows = page.get_by_role("navigation", name="Designs").get_by_role("listitem")
    expect(rows).to_have_count(24)
    page.locator("summary").filter(has_text="Skills/Ball").click()
    expect(rows).to_have_count(36)
    page.get_by_label("Filter designs").fill("design2")
    expect(rows).to_have_count(11)


def test_one_of_many_designs_is_found_by_parts_of_its_name(team: str, page: Page) -> None:
    page.goto(team + "design/team/stand_0")
    page.wait_for_function("window.did_handshake")
    designs = page.get_by_role("navigation", name="Designs")
    shown = designs.get_by_role("listitem")
    expect(shown).to_have_count(31)
    page.get_by_label("Filter designs").fill("half 1")
    expect(shown).to_have_count(5)
    expect(shown.first.get_by_role("link")).to_have_accessible_name("defend_corner_of_our_half_1")
    page.get_by_label("Filter designs").fill("no such")
    expect(designs.get_by_text("No designs match the filter.")).to_be_visible()
    page.get_by_label("Filter designs").fill("bad")
    expect(shown.get_by_role("link")).to_have_accessible_name(re.compile("bad.yaml"))
    # Enter means what stands there, though the list may be that of before.
    page.get_by_label("Filter designs").fill("off 5")
    page.keyboard.press("Enter")
    expect(page).to_have_url(re.compile("/design/team/kick_off_5$"))
    expect(page.get_by_label("Filter designs")).to_have_value("")


def test_who_walks_through_the_list_stays_there_when_a_design_becomes_unsaved(
    team: str, page: Page, other: Page
) -> None:
    page.goto(team + "design/team/stand_0")
    page.wait_for_function("window.did_handshake")
    other.goto(team + "design/team/defend_corner_of_our_half_1")
    designs = page.get_by_role("navigation", name="Designs")
    edited = designs.get_by_role("link", name="defend_corner_of_our_half_1").first
    expect(edited).to_have_accessible_name("defend_corner_of_our_half_1")
    mine = designs.get_by_role("link", name="stand_3", exact=True)
    mine.focus()
    other.get_by_role("textbox", name="Description", exact=True).fill("Stay near the own goal.")
    expect(edited).to_have_accessible_name("defend_corner_of_our_half_1, unsaved")
    expect(mine).to_be_focused()
    other.keyboard.press("Control+s")
    expect(edited).to_have_accessible_name("defend_corner_of_our_half_1")
    expect(mine).to_be_focused()
    # So does a menu that is open there.
    mine.click(button="right")
    rename = page.get_by_role("menuitem", name="Rename everywhere")
    expect(rename).to_be_visible()
    other.get_by_role("textbox", name="Description", exact=True).fill("Stay near the other goal.")
    expect(edited).to_have_accessible_name("defend_corner_of_our_half_1, unsaved")
    rename.click()
    expect(page.get_by_role("dialog")).to_contain_text("stand_3")
