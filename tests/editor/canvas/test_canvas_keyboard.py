"""Keyboard operation of the canvas."""

import pytest
from playwright.sync_api import expect

from tests.editor.canvas.conftest import CanvasDriver


@pytest.mark.parametrize(("keys", "name"), [("Control+z", "undo"), ("Control+Shift+Z", "redo"), ("Control+y", "redo")])
def test_history_keys_are_reported(canvas: CanvasDriver, keys: str, name: str) -> None:
    canvas.page.locator(".stage").focus()
    canvas.press(keys)
    assert canvas.wait_for_gesture("command") == {"name": name}


@pytest.mark.parametrize("keys", [(), ("F2",)], ids=["on a state", "in its name"])
def test_ctrl_s_reaches_the_page(canvas: CanvasDriver, keys: tuple[str, ...]) -> None:
    canvas.page.evaluate(
        """() => document.body.addEventListener("keydown", event => {
          if (event.key !== "s") return;
          document.body.dataset.saved = String(event.ctrlKey);
          event.preventDefault();
        })"""
    )
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.press(*keys)
    if keys:
        canvas.page.locator("input.rename").fill("Resign")
    canvas.press("Control+s")
    expect(canvas.page.locator("body")).to_have_attribute("data-saved", "true")
    canvas.page.evaluate("delete document.body.dataset.saved")
    assert not canvas.gestures("create")
    if keys:
        assert canvas.wait_for_gesture("rename")["name"] == "Resign"


def test_select_all_takes_everything(canvas: CanvasDriver) -> None:
    canvas.page.locator(".stage").focus()
    canvas.press("Control+a")
    assert len(canvas.wait_for_gesture("select")["items"]) == 8 + 12 + 3 + 5 + 1


def test_tab_selects_states_and_their_transitions_and_enter_renames(canvas: CanvasDriver) -> None:
    canvas.page.locator(".stage").focus()
    canvas.press("Tab")
    assert canvas.selection() == {"states/LookForBall"}
    expect(canvas.group("state", "LookForBall")).to_be_focused()
    canvas.press("Enter")
    expect(canvas.page.locator("input.rename")).to_have_value("LookForBall")
    canvas.press("Escape", "Tab")
    assert canvas.selection() == {"transitions/LookForBall/0"}
    canvas.press("Enter")
    expect(canvas.page.locator("input.guard-field")).to_have_value(
        "perception.ball_seen and perception.ball_distance < 4000"
    )
    canvas.press("Escape", "Shift+Tab", "Shift+Tab")
    assert canvas.selection() == {"states/LookForBall"}
    expect(canvas.page.locator(".stage")).to_be_focused()


def test_t_connects_to_the_state_clicked_next(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.press("t")
    expect(canvas.page.locator(".message")).to_be_visible()
    canvas.click(canvas.at("states", "FollowBall"))
    expect(canvas.page.locator(".message")).to_be_hidden()
    expect(canvas.page.locator("input.guard-field")).to_be_focused()
    canvas.press("Enter")
    assert canvas.wait_for_gesture("connect")["target"] == "FollowBall"


def test_keys_after_a_connection_are_for_it(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.press("t")
    canvas.page.keyboard.type("FollowB")
    canvas.press("Enter")
    # D, I, N and S are letters of the guard.
    canvas.page.keyboard.type("din < 3 after 2 s")
    assert not canvas.gestures("connect")
    canvas.press("Enter")
    assert canvas.wait_for_gesture("connect") == {
        "source": "GiveUp",
        "target": "FollowBall",
        "guard": "din < 3 after 2 s",
        "select": True,
    }
    expect(canvas.page.locator("input.guard-field")).to_be_hidden()
    expect(canvas.page.locator(".stage")).to_be_focused()


def test_an_earlier_answer_does_not_change_the_selection_of_a_new_state(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.wait_for_gesture("select")
    canvas.press("n")
    canvas.page.keyboard.type("Resign")
    canvas.press("Enter")
    # Python has not heard of the new state yet.
    canvas.call("select", [{"of": "states", "id": "FollowBall"}])
    canvas.call("apply", {"rev": 9})
    canvas.page.wait_for_selector('.vicode-canvas[data-rev="9"]')
    assert canvas.selection() == {"states/Resign"}
    canvas.press("Enter")
    canvas.wait_for_gesture("connect", name="Resign")
    canvas.call("select", [{"of": "states", "id": "GiveUp"}])
    canvas.wait_for("vicode.selection()[0].id === 'GiveUp'")


@pytest.mark.parametrize("end", ["Enter", "Tab"])
def test_a_new_transition_is_named_and_guarded_by_keys(canvas: CanvasDriver, end: str) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.press("n")
    canvas.page.keyboard.type("Resign")
    canvas.press(end)
    canvas.page.keyboard.type("20 s")
    canvas.press("Enter")
    assert canvas.wait_for_gesture("connect").items() >= {"name": "Resign", "target": None, "guard": "20 s"}.items()
    # The new state is selected: the next transition starts there. A known name leads to that state.
    canvas.press("n")
    canvas.page.keyboard.type("FollowBall")
    canvas.press(end, "Enter")
    canvas.wait_for_gesture("connect", source="Resign", target="FollowBall", guard="")


def test_a_guard_is_edited_on_its_label(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("transitions", "LookForBall/0"), double=True)
    field = canvas.page.locator("input.guard-field")
    expect(field).to_be_focused()
    box = field.bounding_box()
    assert box is not None
    x, y = canvas.at("transitions", "LookForBall/0")
    assert abs(box["x"] + box["width"] / 2 - x) < 3
    assert abs(box["y"] + box["height"] / 2 - y) < 3
    canvas.page.keyboard.type("distance < 0.5")
    # The text belongs to the transition of this revision, wherever others move it.
    canvas.call("apply", {"rev": 9, "remove": {"transitions": ["LookForBall/0"]}})
    canvas.press("Enter")
    typed = canvas.wait_for_gesture("guard", id="LookForBall/0", text="distance < 0.5")
    assert typed["base"] == "perception.ball_seen and perception.ball_distance < 4000"
    assert canvas.gestures("guard")[-1]["rev"] == 1


def test_a_guard_left_by_escape_is_unchanged_and_tab_leads_to_the_form(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("transitions", "LookForBall/0"))
    canvas.press("F2")
    canvas.page.keyboard.type("x")
    canvas.press("Escape", "Enter", "Tab")
    assert canvas.wait_for_gesture("open") == {"item": {"of": "transitions", "id": "LookForBall/0"}}
    assert not canvas.gestures("guard")


def test_escape_clears_the_selection(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.press("Escape")
    assert canvas.selection() == set()
    canvas.wait_for_gesture("select", items=[])


def test_letters_of_a_text_whose_field_has_gone_are_no_commands(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    # The field disappears while its user types on.
    canvas.page.evaluate(
        """() => {
          const field = document.body.appendChild(document.createElement("input"));
          field.id = "vanishing";
          field.addEventListener("input", () => field.value.length === 3 && field.remove());
        }"""
    )
    canvas.page.locator("#vanishing").focus()
    canvas.page.keyboard.type("serfdinsm[]")
    expect(canvas.page.locator("input.rename")).to_be_hidden()
    # Enter ends a text: what follows is a command.
    canvas.press("Enter", "Escape", "f")
    assert canvas.wait_for_gesture("mark") == {"mark": "final", "id": "GiveUp"}
    assert {gesture["kind"] for gesture in canvas.gestures()} <= {"select", "mark", "command", "tooltip"}


def test_a_letter_after_a_pause_is_a_command(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.page.evaluate("document.body.appendChild(document.createElement('input')).id = 'other'")
    canvas.page.locator("#other").focus()
    canvas.page.keyboard.type("x")
    canvas.page.locator("#other").evaluate("field => field.remove()")
    canvas.page.wait_for_timeout(1100)
    canvas.press("f")
    assert canvas.wait_for_gesture("mark") == {"mark": "final", "id": "GiveUp"}
