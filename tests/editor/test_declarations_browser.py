"""What a design declares, in a browser: new names reach all that says them, in this design and in others."""

import re
from pathlib import Path

from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import save

expect.set_options(timeout=20_000)


def open_design(page: Page, url: str, component: str) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(f"{url}design/forward/{component}")
    expect(
        page.get_by_label("Inspector").get_by_text("Initial" if "?" in component else "Initial state")
    ).to_be_visible()


def name_of(page: Page, group: str) -> Locator:
    return page.get_by_role("group", name=group, exact=True).get_by_role("textbox", name="Name", exact=True)


def test_a_new_name_of_a_variable_is_one_step(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "player.yaml"
    # A plain name in C++ may mean anything, and a dialog lists it.
    before = re.sub(r"std::printf\(.*", "static_cast<void>(bearing);", file.read_text())
    file.write_text(before)
    open_design(page, editor, "Player")
    name_of(page, "variable kick").fill("shot at")
    page.keyboard.press("Enter")
    expect(page.get_by_text("use letters, digits and underscores")).to_be_visible()
    name_of(page, "variable kick").fill("perception")
    page.keyboard.press("Enter")
    expect(page.get_by_text("'perception' is already the name of an alias")).to_be_visible()
    expect(page.get_by_text("Unsaved changes")).to_have_count(0)

    # Tab takes it over, and the next field is typed in.
    name_of(page, "variable kick").fill("shot")
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    page.keyboard.type("none")
    expect(name_of(page, "variable shot")).to_have_value("shot")
    expect(page.get_by_role("group", name="variable shot").get_by_label("Unit")).to_have_value("none")
    after = save(page, file)
    assert "self.shot" in after
    assert "self.kick " not in after
    page.get_by_role("tab", name="History").click()
    steps = page.get_by_role("group", name="History").get_by_role("button")
    expect(steps).to_have_count(3)
    page.get_by_role("button", name="Undo").click()
    page.get_by_role("button", name="Undo").click()
    expect(name_of(page, "variable kick")).to_have_value("kick")
    page.keyboard.press("Control+s")
    expect(page.get_by_text("Unsaved changes")).to_have_count(0)
    assert file.read_text() == before


def test_the_type_of_a_variable_is_chosen_from_a_list(editor: str, page: Page, project: Path) -> None:
    open_design(page, editor, "Player")
    variable = page.get_by_role("group", name="variable side", exact=True)
    variable.get_by_label("Type").click()
    expect(page.get_by_role("option")).to_have_text(["from value", "bool", "int", "float", "Side", "Kick"])
    page.get_by_role("option", name="from value").click()
    expect(variable.get_by_label("Type")).to_have_value("from value")
    assert "side: {initial: Side.left," in save(page, project / "forward" / "player.yaml")


def test_code_in_which_a_name_may_mean_anything_is_listed_first(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "player.yaml"
    code = 'members: {cpp: "int hits() { return kick + this->kick; }"}'
    file.write_text(file.read_text().replace("component: Player\n", f"component: Player\n{code}\n"))
    open_design(page, editor, "Player")
    name_of(page, "variable kick").fill("shot")
    page.keyboard.press("Enter")
    dialog = page.get_by_role("dialog", name="Rename variable kick to shot")
    expect(dialog.get_by_text("Player: members of the design, C++")).to_be_visible()
    dialog.get_by_role("button", name="Cancel").click()
    expect(dialog).to_have_count(0)
    expect(name_of(page, "variable kick")).to_have_value("kick")
    name_of(page, "variable kick").fill("shot")
    page.keyboard.press("Enter")
    dialog.get_by_role("button", name="Rename", exact=True).click()
    expect(name_of(page, "variable shot")).to_have_value("shot")
    assert "return kick + this->shot" in save(page, file)


def test_a_new_name_that_others_say_is_written_everywhere(editor: str, page: Page, other: Page, project: Path) -> None:
    folder = project / "forward"
    before = {file.name: file.read_text() for file in folder.glob("*.yaml")}
    open_design(page, editor, "Body")
    open_design(other, editor, "FollowBall")
    name_of(page, "parameter forward").fill("ahead")
    page.keyboard.press("Enter")
    dialog = page.get_by_role("dialog", name="Rename parameter forward to ahead")
    expect(dialog.get_by_text("follow_ball.yaml")).to_be_visible()
    expect(dialog.get_by_text("Body: ")).to_be_visible()
    dialog.get_by_role("button", name="Cancel").click()
    expect(dialog).to_have_count(0)
    expect(name_of(page, "parameter forward")).to_have_value("forward")
    assert {file.name: file.read_text() for file in folder.glob("*.yaml")} == before

    name_of(page, "parameter forward").fill("ahead")
    page.keyboard.press("Enter")
    dialog.get_by_role("button", name="Rename everywhere").click()
    expect(name_of(page, "parameter ahead")).to_have_value("ahead")
    expect(other.get_by_text("renamed parameter forward to ahead in 2 files")).to_be_visible()
    after = {file.name: file.read_text() for file in folder.glob("*.yaml")}
    assert {name for name in after if after[name] != before[name]} == {"body.yaml", "follow_ball.yaml"}
    assert "body: {ahead: " in after["follow_ball.yaml"]
    assert "# slow down on the last steps" in after["follow_ball.yaml"]
    expect(page.get_by_text("Unsaved changes")).to_have_count(0)

    page.get_by_role("status").get_by_role("button", name="Undo").click()
    expect(name_of(page, "parameter forward")).to_have_value("forward")
    assert {file.name: file.read_text() for file in folder.glob("*.yaml")} == before

    # The history of the other design, too, tells of it, and going back there takes it back in all files.
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Redo").click()
    expect(name_of(page, "parameter ahead")).to_have_value("ahead")
    assert {file.name: file.read_text() for file in folder.glob("*.yaml")} == after
    other.get_by_role("tab", name="History").click()
    steps = other.get_by_role("group", name="History").get_by_role("button")
    expect(steps.filter(has_text="redo rename forward to ahead")).to_be_visible()
    steps.filter(has_text="open").last.click()
    other.get_by_role("dialog").get_by_role("button", name="Go to step").click()
    expect(name_of(page, "parameter forward")).to_have_value("forward")
    assert {file.name: file.read_text() for file in folder.glob("*.yaml")} == before


def test_what_few_need_stands_in_folds(editor: str, page: Page, project: Path) -> None:
    open_design(page, editor, "Player?select=Kick")
    page.get_by_label("Inspector").get_by_text("More", exact=True).click()
    capacity = page.get_by_label("Capacity (robots at once)")
    capacity.fill("many")
    expect(page.get_by_text("enter a whole number of robots")).to_be_visible()
    capacity.fill("1")
    page.get_by_label("Synchronized (robots)").fill("2")
    # A form that is built anew keeps its folds open.
    page.get_by_label("State", exact=True).fill("Strike")
    page.keyboard.press("Enter")
    text = save(page, project / "forward" / "player.yaml")
    state = text[text.index("  Strike:") :]
    assert "    capacity: 1\n" in state
    assert "    synchronized: 2\n" in state


def test_a_field_keeps_focus_and_item_while_others_change_the_list(editor: str, page: Page, other: Page) -> None:
    open_design(page, editor, "Player")
    open_design(other, editor, "Player")
    unit = page.get_by_role("group", name="variable side", exact=True).get_by_label("Unit")
    unit.focus()
    page.keyboard.type("le")
    other.get_by_role("group", name="variable kick", exact=True).get_by_role("button", name="Remove kick").click()
    expect(page.get_by_role("group", name="variable kick", exact=True)).to_have_count(0)
    expect(unit).to_be_focused()
    page.keyboard.type("gs")
    expect(other.get_by_role("group", name="variable side", exact=True).get_by_label("Unit")).to_have_value("legs")
    expect(unit).to_be_focused()


def test_a_new_assignment_begins_with_a_value_that_can_stand_there(editor: str, page: Page) -> None:
    open_design(page, editor, "Player")
    page.get_by_role("button", name="Common transitions and actions").click()
    page.get_by_role("button", name="Add to actions: Set").click()
    expect(page.get_by_role("textbox", name="name = expression, one per line")).to_have_text("kick = Kick.front")
    expect(page.get_by_text("No problems found")).to_be_visible()


def test_what_the_project_declares_is_written_into_its_file(editor: str, page: Page, project: Path) -> None:
    folder = project / "forward"
    before = (folder / "project.yaml").read_text()
    open_design(page, editor, "Turn")
    page.get_by_text("Project Forward").click()
    kick = page.get_by_role("group", name="enumeration Kick")
    kick.get_by_text("Internal (elements numbered by the XABSL engine)").click()
    expect(page.get_by_text("project.yaml saved: edit Kick")).to_be_visible()
    assert "    internal: true\n" in (folder / "project.yaml").read_text()
    page.get_by_role("status").get_by_role("button", name="Undo").click()
    expect(kick.get_by_role("checkbox")).not_to_be_checked()
    assert (folder / "project.yaml").read_text() == before

    value = page.get_by_role("group", name="constant net_x").get_by_label("Value")
    value.fill("2900")
    page.keyboard.press("Tab")
    expect(page.get_by_text("project.yaml saved: edit net_x")).to_be_visible()
    assert "net_x: {value: 2900, unit: mm" in (folder / "project.yaml").read_text()
    page.get_by_role("status").get_by_role("button", name="Undo").click()
    expect(value).to_have_value("3000.0")

    kick.get_by_label("Element 3").fill("sideways")
    page.keyboard.press("Enter")
    dialog = page.get_by_role("dialog", name="Rename element lateral to sideways")
    expect(dialog.get_by_text("player.yaml")).to_be_visible()
    dialog.get_by_role("button", name="Rename everywhere").click()
    expect(kick.get_by_label("Element 3")).to_have_value("sideways")
    assert "kick: Kick.sideways" in (folder / "player.yaml").read_text()
    assert "sideways: Outwards" in (folder / "project.yaml").read_text()

    # Who hears the form is told of the new name, too; and the history takes it back in all files.
    kick.get_by_label("Enumeration", exact=True).fill("Shot")
    page.keyboard.press("Enter")
    page.get_by_role("dialog", name="Rename enumeration Kick to Shot").get_by_role(
        "button", name="Rename everywhere"
    ).click()
    shot = page.get_by_role("group", name="enumeration Shot", exact=True)
    expect(shot.get_by_label("Element 3")).to_have_value("sideways")
    assert "Shot.sideways" in (folder / "player.yaml").read_text()
