"""Using the table by keyboard and by mouse, synchronized with the diagram and with another window."""

from pathlib import Path

from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import save, select_state

PLAYER = "design/forward/Player"

expect.set_options(timeout=20_000)


def open_table(page: Page, url: str, design: str = PLAYER) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(url + design)
    expect(page.locator('g[data-kind="state"]').first).to_be_visible()
    page.keyboard.press("F4")
    expect(page.get_by_role("treegrid")).to_be_visible()
    expect(page.locator(".vicode-table [tabindex='0']")).to_be_focused()


def cell(page: Page, row: str, column: str) -> Locator:
    return page.locator(f'.vicode-table .row[data-id="{row}"] .cell.c-{column}')


def press(page: Page, *keys: str) -> None:
    for key in keys:
        page.keyboard.press(key)


def test_a_machine_is_built_by_keyboard(editor: str, page: Page, project: Path) -> None:
    (project / "forward" / "wave.yaml").write_text("vicode: 1\ncomponent: Wave\nstates: {Up: {}}\n")
    open_table(page, editor, "design/forward/Wave")
    expect(page.locator(".vicode-table :focus")).to_have_text("Up")

    # Add a state below and name it; then add a transition with a timer from the first state to it.
    press(page, "Control+Shift+Enter")
    expect(page.locator(".field-in-cell")).to_be_focused()
    page.keyboard.type("Down")
    press(page, "Enter")
    expect(cell(page, "states/Down", "name")).to_be_focused()
    press(page, "ArrowUp", "Control+Enter")
    expect(page.locator("select.field-in-cell")).to_be_focused()
    press(page, "Enter")
    expect(cell(page, "transitions/Up/0", "name")).to_be_focused()
    expect(cell(page, "transitions/Up/0", "name")).to_have_text("1 →Down")
    press(page, *["ArrowRight"] * 5)
    page.keyboard.type("0.5")
    press(page, "Enter")
    expect(cell(page, "transitions/Up/0", "after")).to_have_text("0.5")

    # Make the second state final; an invalid guard shows a sign in its row.
    press(page, "ArrowDown", "Home", "ArrowRight", "ArrowRight", "Space")
    expect(page.get_by_role("checkbox", name="Down: Final")).to_be_checked()
    # Letters on a flag neither toggle it nor trigger a shortcut.
    page.keyboard.type("sad")
    press(page, "ArrowUp", "ArrowRight")
    expect(page.get_by_role("checkbox", name="Down: Final")).to_be_checked()
    expect(page.get_by_role("checkbox", name="Down: Disabled", exact=True)).not_to_be_checked()
    press(page, "ArrowRight", "F2")
    page.keyboard.type("no_such_name")
    press(page, "Enter")
    expect(page.locator('.row[data-id="transitions/Up/0"] .sign.error')).to_be_visible()
    press(page, "Delete")
    expect(page.locator('.row[data-id="transitions/Up/0"] .sign.error')).to_have_count(0)

    text = save(page, project / "forward" / "wave.yaml")
    assert "Down" in text
    assert "after: 0.5" in text
    press(page, "F4")
    expect(page.locator('g[data-kind="state"][data-id="Down"]')).to_be_visible()


def test_refused_values_stay_in_the_cell_editor(editor: str, page: Page) -> None:
    open_table(page, editor)
    press(page, "ArrowDown", "ArrowDown", "F2")
    expect(page.locator(".field-in-cell")).to_have_value("LookForBall")
    page.keyboard.type("Kick")
    press(page, "Enter")
    expect(page.get_by_role("alert").filter(has_text="there is already a state Kick")).to_be_visible()
    expect(page.locator(".field-in-cell")).to_have_value("Kick")
    page.keyboard.type("Seek")
    press(page, "Enter")
    expect(cell(page, "states/Seek", "name")).to_be_focused()
    expect(cell(page, "transitions/FollowBall/0", "name")).to_have_text("1 →Seek")
    press(page, "F2", "Escape", "Control+z")
    expect(cell(page, "states/LookForBall", "name")).to_be_visible()


def test_rows_are_moved_and_removed_by_mouse_and_keys(editor: str, page: Page) -> None:
    open_table(page, editor)
    cell(page, "transitions/FollowBall/0", "name").click()
    expect(page.get_by_label("Inspector").get_by_text("Transition from")).to_be_visible()
    page.get_by_role("button", name="Move down").first.click()
    expect(cell(page, "transitions/FollowBall/0", "name")).to_have_text("1 →SearchNet")
    cell(page, "transitions/FollowBall/1", "name").click()
    press(page, "Alt+ArrowUp")
    expect(cell(page, "transitions/FollowBall/0", "name")).to_have_text("1 →LookForBall")
    expect(cell(page, "transitions/FollowBall/0", "name")).to_be_focused()
    press(page, "Control+Delete")
    expect(cell(page, "transitions/FollowBall/1", "name")).to_have_count(0)
    expect(page.locator(".vicode-table .cell:focus")).to_have_count(1)


def test_a_choice_is_made_by_mouse(editor: str, page: Page) -> None:
    open_table(page, editor)
    target = cell(page, "transitions/Kick/0", "name")
    target.scroll_into_view_if_needed()
    target.click()
    target.click()
    page.locator("select.field-in-cell").select_option("GetUp")
    expect(target).to_have_text("1 →GetUp")
    cell(page, "states/Kick", "doc").dblclick()
    page.locator("textarea.field-in-cell").fill("one of six")
    cell(page, "states/Kick", "name").click()
    expect(cell(page, "states/Kick", "doc")).to_have_text("one of six")


def test_table_diagram_and_another_window_are_synchronized(editor: str, page: Page, second_window: Page) -> None:
    open_table(page, editor)
    second_window.goto(editor + PLAYER)
    expect(second_window.locator('g[data-kind="state"][data-id="Kick"]')).to_be_visible()
    cell(page, "states/FollowBall", "name").click()
    expect(page.get_by_label("State", exact=True)).to_have_value("FollowBall")
    press(page, "F2")
    page.keyboard.type("Chase")
    press(page, "Enter")
    expect(second_window.locator('g[data-kind="state"][data-id="Chase"]')).to_be_visible()
    second_window.get_by_role("button", name="Undo").click()
    expect(cell(page, "states/FollowBall", "name")).to_be_visible()
    press(page, "F4")
    select_state(page, "GetUp")
    press(page, "F4")
    expect(cell(page, "states/GetUp", "name")).to_be_focused()
    expect(page.locator('.row[data-id="states/GetUp"]')).to_have_attribute("aria-selected", "true")


def test_a_thousand_states_are_navigated_by_keyboard(editor: str, page: Page, project: Path) -> None:
    states = "".join(
        f"  S{n}:\n    at: [{200 * (n % 40)}, {120 * (n // 40)}]\n"
        f"    transitions: [{{to: S{(n + 1) % 1000}, after: {n}}}]\n"
        for n in range(1000)
    )
    (project / "forward" / "long.yaml").write_text(f"vicode: 1\ncomponent: Long\ninitial: S0\nstates:\n{states}")
    page.goto(editor + "design/forward/Long")
    expect(page.get_by_role("button", name="Table")).to_be_visible()
    page.get_by_role("button", name="Table").click()
    expect(page.get_by_role("treegrid")).to_have_attribute("aria-rowcount", "2001")
    expect(page.locator(".vicode-table :focus")).to_have_text("S0")
    press(page, "Control+End")
    expect(cell(page, "transitions/S999/0", "doc")).to_be_focused()
    assert page.locator(".vicode-table .row").count() < 100
    press(page, "Control+Home", "PageDown", "End", "F2")
    page.keyboard.type("far down")
    press(page, "Enter")
    expect(page.locator(".vicode-table :focus")).to_have_text("far down")
