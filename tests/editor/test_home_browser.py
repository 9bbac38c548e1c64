"""The home of a folder: cards lead to designs; new, renamed, copied, thrown away and back; search; broken files."""

import os
import re
import socket
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.conftest import close_all_but, opened_beside
from tests.editor.conftest import started_editor
from tests.editor.player_page import state


@pytest.fixture(autouse=True)
def _own_trash(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The server's trash is a folder of the test."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    assert os.environ["XDG_DATA_HOME"]
    return


def card(page: Page, component: str) -> Locator:
    return page.get_by_role("article").filter(has=page.get_by_role("link", name=component, exact=True))


def open_home(page: Page, url: str) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(url)
    expect(card(page, "Player")).to_be_visible()


def choose(page: Page, component: str, item: str) -> Locator:
    """An item of a card's menu; the dialog that it opens."""
    page.get_by_role("button", name=f"More for {component}").click()
    page.get_by_role("menuitem", name=item).click()
    dialog = page.get_by_role("dialog")
    expect(dialog).to_be_visible()
    return dialog


def test_cards_show_what_there_is_and_lead_there(editor: str, page: Page, project: Path) -> None:
    folder = project / "forward"
    (folder / "broken.yaml").write_text("vicode: 1\ncomponent: Broken\nstates: [\n")
    (folder / "wobbly.yaml").write_text(
        "vicode: 1\ncomponent: Wobbly\ndoc: <img src=x onerror=alert(1)>\nstates: {A: {transitions: [{to: B}]}}\n"
    )
    open_home(page, editor)
    expect(card(page, "Wobbly")).to_contain_text("error")
    expect(card(page, "Wobbly")).to_contain_text("<img src=x")
    expect(page.get_by_role("article").filter(has_text="broken.yaml")).to_contain_text("Line 3")
    expect(card(page, "Player")).to_contain_text("Root of an agent")
    expect(card(page, "Player")).to_contain_text("No problems found")
    picture = card(page, "Player").locator("img.is-light")
    expect(picture).to_have_js_property("complete", value=True)
    assert picture.evaluate("image => image.naturalWidth") > 100
    expect(page.get_by_role("listitem").filter(has_text="field.kicker:Kicker")).to_contain_text("used by")
    page.get_by_label("Search designs").last.fill("search net")
    expect(card(page, "SearchNet")).to_be_visible()
    expect(card(page, "Turn")).to_have_count(0)
    card(page, "SearchNet").get_by_role("link", name="SearchNet").click()
    expect(state(page, "FirstSide")).to_be_visible()
    page.get_by_role("link", name="vicode, all designs").click()
    expect(card(page, "Player")).to_be_visible()


def test_the_picture_of_all_uses_leads_to_designs(editor: str, page: Page) -> None:
    open_home(page, editor)
    page.locator(".home-uses a", has_text="FollowBall").first.click()
    expect(page).to_have_url(re.compile(r"/design/forward/FollowBall$"))


def test_a_new_design_begins_with_a_template(editor: str, page: Page, project: Path) -> None:
    open_home(page, editor)
    page.keyboard.press("Control+k")
    page.keyboard.type("new design")
    page.keyboard.press("Enter")
    dialog = page.get_by_role("dialog", name="New design in Forward")
    name = dialog.get_by_label("Component")
    name.fill("knöck knock")
    dialog.get_by_role("button", name="Create").click()
    expect(page.get_by_text("letters, digits and underscores, such as KnockKnock")).to_be_visible()
    expect(name).to_have_value("KnockKnock")
    dialog.get_by_role("button", name="Cancel").click()
    expect(dialog).to_have_count(0)
    page.get_by_role("button", name="New design").click()
    name.fill("Knock")
    dialog.get_by_text("Timer and retry").click()
    name.press("Enter")
    expect(page).to_have_url(re.compile(r"/Knock$"))
    expect(state(page, "GaveUp")).to_be_visible()
    assert "component: Knock" in (project / "forward" / "knock.yaml").read_text()


def test_a_dialog_stays_while_somebody_else_changes_the_folder(editor: str, page: Page, project: Path) -> None:
    open_home(page, editor)
    page.get_by_role("button", name="New design").click()
    dialog = page.get_by_role("dialog", name="New design in Forward")
    dialog.get_by_label("Component").fill("Knock")
    (project / "forward" / "wave.yaml").write_text("vicode: 1\ncomponent: Wave\nstates: {A: {}}\n")
    expect(page.locator("article", has_text="Wave")).to_be_attached()
    expect(dialog.get_by_label("Component")).to_have_value("Knock")
    dialog.get_by_role("button", name="Create").click()
    expect(page).to_have_url(re.compile(r"/Knock$"))


def test_a_renaming_shows_what_changes_does_it_and_takes_it_back(
    editor: str, page: Page, second_window: Page, project: Path
) -> None:
    folder = project / "forward"
    before = (folder / "player.yaml").read_text()
    open_home(page, editor)
    second_window.goto(editor + "design/forward/FaceBall")
    expect(state(second_window, "Facing")).to_be_visible()
    dialog = choose(page, "FaceBall", "Rename everywhere")
    field = dialog.get_by_label("New name")
    field.fill("Turn")
    expect(dialog).to_contain_text("already a component Turn")
    field.fill("LookAtBall")
    expect(dialog).to_contain_text("Player uses LookAtBall as face_ball")
    expect(dialog).to_contain_text("face_ball.yaml is renamed to look_at_ball.yaml")
    dialog.get_by_role("button", name="Rename everywhere").click()
    expect(card(page, "LookAtBall")).to_be_visible()
    expect(card(page, "FaceBall")).to_have_count(0)
    assert "component: LookAtBall" in (folder / "player.yaml").read_text()
    # The window that was open on it goes with it.
    expect(second_window).to_have_url(re.compile(r"/LookAtBall$"))
    expect(state(second_window, "Facing")).to_be_visible()
    page.get_by_role("button", name="Undo").click()
    expect(card(page, "FaceBall")).to_be_visible()
    expect(second_window).to_have_url(re.compile(r"/FaceBall$"))
    expect(state(second_window, "Facing")).to_be_visible()
    assert (folder / "player.yaml").read_text() == before


def test_a_design_goes_to_the_trash_and_comes_back(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "turn.yaml"
    before = file.read_text()
    open_home(page, editor)
    card(page, "Turn").click(button="right", position={"x": 40, "y": 200})
    page.get_by_role("menuitem", name="Move to trash").click()
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("Still used by Body")
    dialog.get_by_role("button", name="Move to trash").click()
    expect(card(page, "Turn")).to_have_count(0)
    expect(card(page, "Body")).to_contain_text("error")
    assert not file.exists()
    page.get_by_role("button", name="Undo").click()
    expect(card(page, "Turn")).to_be_visible()
    assert file.read_text() == before
    # From its own page one is sent home, where Undo is offered still.
    card(page, "Turn").click()
    expect(state(page, "Turning")).to_be_visible()
    page.get_by_role("link", name="Turn").click(button="right")
    page.get_by_role("menuitem", name="Move to trash").click()
    page.get_by_role("dialog").get_by_role("button", name="Move to trash").click()
    expect(card(page, "Body")).to_contain_text("error")
    expect(card(page, "Turn")).to_have_count(0)
    page.get_by_role("button", name="Undo").click()
    expect(card(page, "Turn")).to_be_visible()
    assert file.read_text() == before


def test_the_list_beside_the_drawing_does_the_same(editor: str, page: Page, project: Path) -> None:
    page.goto(editor + "design/forward/Turn")
    expect(state(page, "Turning")).to_be_visible()
    page.get_by_role("link", name="Turn").click(button="right")
    page.get_by_role("menuitem", name="Duplicate").click()
    page.get_by_role("dialog").get_by_role("button", name="Duplicate").click()
    expect(page.get_by_role("link", name="Turn2")).to_be_visible()
    assert "component: Turn2" in (project / "forward" / "turn2.yaml").read_text()


def test_scripts_come_from_the_cache_after_a_restart(stays_open: Page, project: Path, tmp_path: Path) -> None:
    transferred = """() => performance.getEntriesByType("resource")
        .filter((each) => each.name.includes("/_nicegui/") && each.transferSize).map((each) => each.name)"""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = str(probe.getsockname()[1])
    loads = []
    for _start in range(2):
        with started_editor(project, tmp_path / "storage", ("--no-tour", "--port", port)) as url:
            page = opened_beside(stays_open)
            open_home(page, url)
            loads.append(page.evaluate(transferred))
        close_all_but(stays_open)
    assert loads[0]
    assert not loads[1]
