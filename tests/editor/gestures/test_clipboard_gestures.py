"""Copy, cut, paste and duplicate through the system clipboard, within a design and between designs and windows."""

from playwright.sync_api import expect

from tests.editor.gestures.conftest import EditorDriver
from tests.editor.player_page import open_player, state


def clipboard(sketch: EditorDriver) -> str:
    return str(sketch.page.evaluate("navigator.clipboard.readText()"))


def set_clipboard(sketch: EditorDriver, text: str) -> None:
    sketch.page.evaluate("text => navigator.clipboard.writeText(text)", text)


def copy(sketch: EditorDriver, keys: str = "Control+c") -> None:
    sketch.press(keys)
    expect(sketch.page.locator(".message")).to_have_text("Cut" if keys == "Control+x" else "Copied")


def test_copied_states_are_readable_text_and_paste_at_the_pointer(sketch: EditorDriver) -> None:
    sketch.select("Start", "Go")
    copy(sketch)
    text = clipboard(sketch)
    assert text.startswith("vicode: 1\ncomponent: Sketch")
    assert "  Start:\n    at: [120, 100]\n    transitions:\n      - {to: Go, when: state_time > 9}\n" in text
    assert "Rest:" not in text
    spot = sketch.empty()
    sketch.page.mouse.move(*spot)
    sketch.press("Control+v")
    sketch.expect_selection("states/Start2", "states/Go2")
    expect(sketch.transition("Start2/0")).to_have_attribute(
        "aria-label", "Transition 1 of 3 from Start2 to Go2: state_time > 9"
    )
    expect(sketch.transition("Start2/1")).to_have_attribute("aria-label", "Transition 2 of 3 from Start2 to Stop: 3 s")
    (left, y), (right, _y) = sketch.state("Start2"), sketch.state("Go2")
    assert abs((left + right) / 2 - spot[0]) < 12
    assert abs(y - spot[1]) < 12
    sketch.expect_undone()


def test_cut_states_can_be_pasted(sketch: EditorDriver) -> None:
    sketch.select("Go")
    copy(sketch, "Control+x")
    expect(sketch.element("state", "Go")).to_have_count(0)
    assert "Go:" in clipboard(sketch)
    sketch.press("Control+v")
    expect(sketch.element("state", "Go")).to_be_visible()
    sketch.expect_undone(2)


def test_duplicates_keep_inner_and_outgoing_transitions(sketch: EditorDriver) -> None:
    sketch.select("Start", "Go")
    sketch.press("Control+d")
    sketch.expect_selection("states/Start2", "states/Go2")
    sketch.expect_position("states/Start2", 160, 190)
    expect(sketch.transition("Start2/2")).to_have_attribute(
        "aria-label", "Transition 3 of 3 from Start2 to Rest: state_time > 1"
    )
    sketch.expect_undone()
    sketch.click(sketch.at("transitions", "Start/1"))
    sketch.press("Control+d")
    sketch.expect_selection("transitions/Start/2")
    expect(sketch.transition("Start/2")).to_have_attribute(
        "aria-label",
        "Transition 3 of 4 from Start to Stop: 3 s, warning: this decision is never taken: "
        "whenever its guard holds, an earlier one does",
    )
    sketch.expect_undone()


def test_states_are_pasted_into_another_design_with_their_components(sketch: EditorDriver) -> None:
    page = sketch.page.context.new_page()
    open_player(page, sketch.address)
    state(page, "LookForBall").click()
    page.keyboard.press("Control+c")
    expect(page.locator(".message")).to_have_text("Copied")
    sketch.page.bring_to_front()
    sketch.page.mouse.move(*sketch.empty())
    sketch.press("Control+v")
    sketch.expect_selection("states/LookForBall")
    for alias in ("perception", "search_ball"):
        expect(sketch.element("component", alias)).to_be_visible()
    expect(sketch.element("link", "requires/LookForBall/perception")).to_have_count(1)
    # Its target does not exist in this design.
    expect(sketch.transition("LookForBall/0")).to_have_count(0)
    sketch.expect_undone()
    page.close()


def test_transitions_are_pasted_into_the_selected_states(sketch: EditorDriver) -> None:
    sketch.click(sketch.at("transitions", "Start/1"))
    copy(sketch)
    sketch.press("Escape", "Control+v")
    sketch.expect_message("select the states to add these transitions to")
    sketch.select("Go", "Rest")
    sketch.press("Control+v")
    for name in ("Go", "Rest"):
        expect(sketch.transition(f"{name}/0")).to_have_attribute(
            "aria-label", f"Transition 1 of 1 from {name} to Stop: 3 s"
        )
    sketch.expect_undone()


def test_invalid_clipboard_text_shows_a_message_and_changes_nothing(sketch: EditorDriver) -> None:
    for text, message in (
        ("just a letter", "the clipboard contains no part of a design"),
        ("states: {A: !!python/object/apply:os.system [ls]}", "the clipboard contains no part of a design: "),
        ("states: {'<img src=x onerror=alert(1)>': {}}", "is not a valid name"),
        ("states: {}\n" + "# much\n" * 80_000, "The text on the clipboard is too large"),
        ("   ", "The clipboard contains no text"),
    ):
        set_clipboard(sketch, text)
        sketch.page.locator(".stage").last.focus()
        sketch.press("Control+v")
        sketch.expect_message(message)
    expect(sketch.page.get_by_text("Saved", exact=True)).to_be_visible()
    assert sketch.page.locator("img[src=x]").count() == 0


def test_copy_and_paste_by_menu(sketch: EditorDriver) -> None:
    sketch.click(sketch.state("Rest"), right=True)
    sketch.choose("Copy")
    expect(sketch.page.locator(".message")).to_have_text("Copied")
    spot = sketch.empty()
    sketch.click(spot, right=True)
    sketch.choose("Paste")
    sketch.expect_selection("states/Rest2")
    x, y = sketch.state("Rest2")
    assert abs(x - spot[0]) + abs(y - spot[1]) < 20
    sketch.expect_undone()
