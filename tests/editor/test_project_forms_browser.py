"""What project.yaml declares, in a browser: added, changed and removed by mouse and keys, each a step to take back."""

import re
from pathlib import Path

from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import component as used
from tests.editor.player_page import open_player, select_state

expect.set_options(timeout=20_000)


# Ends the animations of the bar with messages; returns whether it is hidden then.
AFTER_SOME_SECONDS = """() => {
  const bar = document.querySelector(".undo-bar");
  bar.getAnimations().forEach(each => each.finish());
  return getComputedStyle(bar).visibility === "hidden";
}"""


def open_project_fold(page: Page, url: str) -> Locator:
    """The inspector with the fold of the project open."""
    open_player(page, url)
    inspector = page.get_by_label("Inspector")
    inspector.get_by_text("Project Forward").click()
    expect(inspector.get_by_role("group", name="enumeration Side", exact=True)).to_be_visible()
    return inspector


def undo(page: Page) -> None:
    page.get_by_role("status").get_by_role("button", name="Undo").click()


def test_an_element_is_added_named_and_taken_back(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "project.yaml"
    before = file.read_text()
    inspector = open_project_fold(page, editor)
    side = inspector.get_by_role("group", name="enumeration Side", exact=True)
    side.get_by_role("button", name="Add Element to Side").click()
    expect(side.get_by_label("Element 3", exact=True)).to_have_value("element")
    added = file.read_text()
    side.get_by_label("Element 3", exact=True).fill("left")
    page.keyboard.press("Enter")
    expect(side.get_by_text("there is already an element left")).to_be_visible()
    side.get_by_label("Element 3", exact=True).fill("no name")
    page.keyboard.press("Enter")
    expect(side.get_by_text("use letters, digits and underscores")).to_be_visible()
    assert file.read_text() == added
    side.get_by_label("Element 3", exact=True).fill("both")
    page.keyboard.press("Enter")
    # Nothing says it yet: there is nothing to ask.
    third = inspector.get_by_role("group", name="element both", exact=True)
    third.get_by_label("Meaning").fill("On both legs.")
    page.keyboard.press("Tab")
    expect(page.get_by_text("project.yaml saved: edit both of Side")).to_be_visible()
    assert "both: 'On both legs.'" in file.read_text()
    # Nothing says it: it goes at once, and comes back.
    third.get_by_role("button", name="Remove element both").click()
    expect(third).to_have_count(0)
    undo(page)
    expect(third.get_by_label("Meaning")).to_have_value("On both legs.")
    # Each was a step of the history as well: the doc, the name, the element.
    page.locator("main.design-view .stage").focus()
    page.keyboard.press("Control+z")
    expect(third.get_by_label("Meaning")).to_have_value("")
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    expect(side.get_by_label("Element 3", exact=True)).to_have_count(0)
    assert file.read_text() == before
    page.keyboard.press("Control+Shift+Z")
    page.keyboard.press("Control+Shift+Z")
    expect(third).to_be_visible()
    third.get_by_role("button", name="Move up element both").click()
    expect(side.get_by_label("Element 2", exact=True)).to_have_value("both")
    expect(side.get_by_label("Element 3", exact=True)).to_have_value("right")
    assert re.search(r"left: .*\n +both: .*\n +right: ", file.read_text())


def test_a_constant_that_is_used_is_removed_after_its_users_were_listed(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "project.yaml"
    before = file.read_text()
    inspector = open_project_fold(page, editor)
    constant = inspector.get_by_role("group", name="constant net_x", exact=True)
    constant.get_by_label("Value").fill("wide")
    page.keyboard.press("Enter")
    expect(constant.get_by_text("'wide' is not declared")).to_be_visible()
    expect(constant.get_by_label("Value")).to_have_value("wide")
    assert file.read_text() == before
    constant.get_by_label("Value").fill("3000.0")
    page.keyboard.press("Enter")
    constant.get_by_label("Type").click()
    page.get_by_role("option", name="float").click()
    expect(page.get_by_text("project.yaml saved: edit net_x")).to_be_visible()
    undo(page)
    expect(constant.get_by_label("Type")).to_have_value("from value")
    constant.get_by_role("button", name="Remove constant net_x").click()
    dialog = page.get_by_role("dialog", name="Remove constant net_x?")
    expect(dialog.get_by_text("transition 1 of state CircleBall, when")).to_be_visible()
    dialog.get_by_role("button", name="Cancel").click()
    expect(dialog).to_have_count(0)
    assert file.read_text() == before
    constant.get_by_role("button", name="Remove constant net_x").click()
    dialog.get_by_role("button", name="Remove anyway").click()
    expect(constant).to_have_count(0)
    expect(page.get_by_text("new errors in Player")).to_be_visible()
    assert "net_x" not in file.read_text()
    undo(page)
    expect(constant.get_by_label("Value")).to_have_value("3000.0")
    assert file.read_text() == before


def test_a_component_written_by_hand_is_edited_where_it_is_used(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "project.yaml"
    before = file.read_text()
    open_player(page, editor)
    used(page, "perception").click()
    inspector = page.get_by_label("Inspector")
    component = inspector.get_by_role("group", name="component Perception", exact=True)
    component.get_by_label("Frequency, Hz").fill("often")
    page.keyboard.press("Enter")
    expect(component.get_by_text("'often' is not a number")).to_be_visible()
    component.get_by_label("Frequency, Hz").fill("30")
    page.keyboard.press("Enter")
    expect(page.get_by_text("project.yaml saved: edit Perception")).to_be_visible()
    assert 'frequency: 30\n    doc: "Simulated vision' in file.read_text()
    undo(page)
    expect(component.get_by_label("Frequency, Hz")).to_have_value("15")

    inspector.get_by_text("ball_age", exact=True).click()
    output = inspector.get_by_role("group", name="output ball_age", exact=True)
    output.get_by_text("More").click()
    output.get_by_label("Range").fill("1000, 0")
    page.keyboard.press("Enter")
    expect(output.get_by_text("enter the minimum before the maximum")).to_be_visible()
    output.get_by_label("Range").fill("0, 60")
    page.keyboard.press("Enter")
    expect(output.get_by_text("range 0 to 60")).to_be_visible()
    assert "range: [0, 60], doc: Since the ball was last seen." in file.read_text()
    undo(page)
    expect(output.get_by_text("range 0 to 1000")).to_be_visible()
    assert file.read_text() == before

    inspector.get_by_role("button", name="Add parameter").click()
    parameter = inspector.get_by_role("group", name="parameter parameter", exact=True)
    parameter.get_by_label("Unit").fill("Hz")
    page.keyboard.press("Tab")
    expect(page.get_by_text("project.yaml saved: edit parameter of Perception")).to_be_visible()
    assert "parameter: {type: float, unit: Hz}" in file.read_text()


def test_the_project_itself_has_a_form(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "project.yaml"
    inspector = open_project_fold(page, editor)
    inspector.get_by_label("Languages").fill("python, cobol")
    page.keyboard.press("Enter")
    expect(inspector.get_by_text("'cobol'")).to_be_visible()
    inspector.get_by_label("Languages").fill("python, xabsl")
    page.keyboard.press("Enter")
    expect(page.get_by_text("project.yaml saved: edit Forward")).to_be_visible()
    assert "languages: [python, xabsl]" in file.read_text()
    inspector.get_by_label("Project description").fill("It plays.")
    page.keyboard.press("Enter")
    page.keyboard.type("And scores.")
    page.keyboard.press("Tab")
    expect(inspector.get_by_label("Languages")).to_be_focused()
    expect(inspector.get_by_label("Project description")).to_have_value("It plays.\nAnd scores.")
    # The message leaves by itself, each time.
    bar = page.locator(".undo-bar")
    for description in ("It plays well.", "It plays better."):
        inspector.get_by_label("Project description").fill(description)
        page.keyboard.press("Tab")
        expect(bar).to_be_visible()
        page.mouse.move(500, 300)
        page.keyboard.press("Escape")
        page.wait_for_function(AFTER_SOME_SECONDS)
    # The form of another item starts at its top.
    panel = page.locator(".side-panels .q-tab-panel").first
    panel.evaluate("panel => (panel.scrollTop = 400)")
    select_state(page, "Kick")
    page.wait_for_function("!document.querySelector('.side-panels .q-tab-panel').scrollTop")


def test_an_agent_is_edited_and_another_one_added(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "project.yaml"
    inspector = open_project_fold(page, editor)
    inspector.get_by_role("button", name="Add Agent to the project").click()
    agent = inspector.get_by_role("group", name="agent agent", exact=True)
    agent.get_by_role("combobox").click()
    page.get_by_role("option", name="SearchBall").click()
    expect(page.get_by_text("project.yaml saved: edit agent")).to_be_visible()
    agent.get_by_label("Title").fill("Seeker")
    page.keyboard.press("Enter")
    expect(agent.get_by_label("Title")).to_have_value("Seeker")
    agent.get_by_label("Agent", exact=True).fill("seeker")
    page.keyboard.press("Enter")
    renamed = inspector.get_by_role("group", name="agent seeker", exact=True)
    expect(renamed.get_by_label("Title")).to_have_value("Seeker")
    assert "seeker: {root: SearchBall, title: Seeker}" in file.read_text()
    renamed.get_by_role("button", name="Remove agent seeker").click()
    expect(renamed).to_have_count(0)
    assert "seeker" not in file.read_text()


def test_inputs_are_typed_one_after_another(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    inspector = page.get_by_label("Inspector")
    inspector.get_by_label("New input").click()
    for text in ("order_given", "range_left: float", "count: int"):
        page.keyboard.type(text, delay=10)
        page.keyboard.press("Enter")
    for name in ("order_given", "range_left", "count"):
        expect(inspector.get_by_text(f"sensors.{name}", exact=True)).to_be_visible()
    written = (project / "forward" / "project.yaml").read_text()
    assert re.search(r"order_given: (\{type: )?bool", written)
    assert re.search(r"range_left: (\{type: )?float", written)
    assert re.search(r"count: (\{type: )?int", written)
    expect(inspector.get_by_label("New input")).to_be_focused()


def test_inputs_and_commands_are_added_in_one_place(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "project.yaml"
    before = file.read_text()
    open_player(page, editor)
    inspector = page.get_by_label("Inspector")
    inspector.get_by_label("New input").fill("order_given")
    page.keyboard.press("Enter")
    expect(inspector.get_by_text("sensors.order_given")).to_be_visible()
    expect(used(page, "sensors")).to_be_visible()
    inspector.get_by_label("New command").fill("dance")
    inspector.get_by_label("Parameters", exact=True).fill("speed, side: Side")
    page.keyboard.press("Enter")
    expect(inspector.get_by_text("speed, side", exact=True)).to_be_visible()
    inspector.get_by_label("New input").fill("order_given")
    page.keyboard.press("Enter")
    expect(page.get_by_text("There is already an input order_given")).to_be_visible()
    page.get_by_role("button", name="Undo").click()
    page.get_by_role("button", name="Undo").click()
    expect(used(page, "sensors")).to_have_count(0)
    assert file.read_text() == before
