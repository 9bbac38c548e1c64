"""What is drawn, what is seen of it, and what Python can make it do."""

import re
import time
from collections.abc import Callable, Mapping
from typing import Any

import pytest
from playwright.sync_api import expect

from tests.editor.canvas.conftest import CanvasDriver
from tests.editor.canvas.player_scene import machine, player

Show = Callable[[Mapping[str, Any]], CanvasDriver]

HOSTILE = '<img src=x onerror="document.body.dataset.hacked=1"> \u202e "\'&lt;'


def test_everything_is_there_with_a_role_and_a_name(hand: CanvasDriver) -> None:
    expect(hand.page.locator("g.node")).to_have_count(8 + 3 + 1)
    expect(hand.page.locator("g.edge")).to_have_count(12 + 5)
    expect(hand.page.get_by_role("button", name="State LookForBall, initial")).to_have_count(1)
    expect(
        hand.page.get_by_role("button", name="Transition 2 of 3 from LookForBall to LookForBall: 5 s")
    ).to_have_count(1)
    assert hand.page.locator(".vicode-canvas").get_attribute("data-rev") == "1"


def test_labels_cover_neither_boxes_nor_each_other(hand: CanvasDriver) -> None:
    boxes = hand.page.locator("g.node .box, g.chip .plate").evaluate_all(
        "all => all.map(each => each.getBoundingClientRect()).map(({x, y, width, height}) => [x, y, width, height])"
    )
    overlapping = [(a, b) for n, a in enumerate(boxes) for b in boxes[n + 1 :] if _overlap(a, b)]
    assert not overlapping


def test_user_text_stays_text(show: Show) -> None:
    scene = player()
    for state in scene["states"]:
        state.update(name=HOSTILE, doc=HOSTILE, severity="error", messages=[HOSTILE])
    for transition in scene["transitions"]:
        transition.update(label=HOSTILE, doc=HOSTILE)
    scene["components"][0].update(id=HOSTILE, name=HOSTILE)
    scene["component"] = HOSTILE
    hand = show(scene)
    page = hand.page
    expect(page.locator("g.node.component").first).to_be_visible()
    hand.click(hand.at("states", "GiveUp"), double=True)
    expect(page.locator("input.rename")).to_have_value(HOSTILE)
    hand.press("Escape")
    for kind, identity in (("states", "GetUp"), ("transitions", "LookForBall/1"), ("components", HOSTILE)):
        page.mouse.move(*hand.at(kind, identity))
        expect(page.locator(".tooltip")).to_contain_text(HOSTILE[:20])
    assert page.locator(".vicode-canvas img").count() == 0
    assert page.locator("body").get_attribute("data-hacked") is None


def test_apply_changes_only_what_it_names(hand: CanvasDriver) -> None:
    lost, added = {"id": "Lost", "name": "Lost", "x": 240, "y": 420}, "LookForBall/3"
    edge = {
        "id": added,
        "source": "LookForBall",
        "target": "Lost",
        "label": "lost",
        "order": 4,
        "of": 4,
        "kind": "guard",
    }
    follow = {**player()["states"][1], "name": "Chase"}
    hand.call(
        "apply",
        {"rev": 2, "upsert": {"states": [lost, follow], "transitions": [edge]}, "remove": {"states": ["GiveUp"]}},
    )
    expect(hand.page.locator(".vicode-canvas")).to_have_attribute("data-rev", "2")
    expect(hand.group("state", "Lost")).to_be_visible()
    expect(hand.group("state", "FollowBall").locator(".name")).to_have_text("Chase")
    expect(hand.group("transition", added)).to_have_count(1)
    expect(hand.group("state", "GiveUp")).to_have_count(0)
    expect(hand.page.locator("g.node")).to_have_count(12)


def test_a_page_that_comes_later_sees_all_changes(hand: CanvasDriver) -> None:
    hand.click(hand.at("states", "GiveUp"))
    hand.press("ArrowRight")
    hand.wait_for_gesture("move")
    hand.call("apply", {"rev": 9, "remove": {"states": ["KickLeft"]}, "common": None})
    expect(hand.page.locator(".vicode-canvas")).to_have_attribute("data-rev", "9")
    # What NiceGUI does when the element is mounted anew.
    hand.page.evaluate(
        """() => {
          const canvas = document.querySelector('.vicode-canvas');
          canvas.removeAttribute('data-ready');
          getElement(canvas.id.slice(1)).$emit('ready', {});
        }"""
    )
    hand.page.wait_for_selector(".vicode-canvas[data-ready]")
    assert hand.position("states/GiveUp") == (90, 330)
    assert "common/@common" not in hand.evaluate("positions()")
    assert "states/KickLeft" not in hand.evaluate("positions()")


def test_select_from_python_reports_nothing_back(hand: CanvasDriver) -> None:
    hand.call("select", [{"of": "transitions", "id": "Fixmove/0"}])
    hand.wait_for("vicode.selection().length === 1")
    assert hand.selection() == {"transitions/Fixmove/0"}
    assert not hand.gestures("select")


def test_the_newest_active_states_win(hand: CanvasDriver) -> None:
    # The page outlives the test, and its numbers only grow.
    start = time.monotonic_ns() // 1000
    for number in range(7):
        hand.call("highlight_active", [["LookForBall", "FollowBall"][number % 2]], start + number)
    hand.call("highlight_active", ["GetUp"], start + 2)
    expect(hand.page.locator("g.node.active")).to_have_attribute("data-id", "LookForBall")
    hand.call("highlight_active", [], start + 7)
    expect(hand.page.locator("g.node.active")).to_have_count(0)


def test_links_can_be_hidden(hand: CanvasDriver) -> None:
    hand.call("show_links", False)
    expect(hand.page.locator("g.edge.link")).to_have_count(0)
    hand.call("show_links", True)
    expect(hand.page.locator("g.edge.link")).to_have_count(5)


def test_a_new_state_is_named_in_place(hand: CanvasDriver) -> None:
    hand.call("rename_in_place", "GiveUp")
    expect(hand.page.locator("input.rename")).to_be_focused()


def test_the_wheel_zooms_at_the_pointer_and_the_middle_button_pans(hand: CanvasDriver) -> None:
    spot = hand.at("states", "KickLeft")
    hand.page.mouse.move(*spot)
    before = hand.evaluate("view()")["k"]
    hand.page.mouse.wheel(0, -300)
    hand.wait_for(f"vicode.view().k > {before}")
    assert hand.at("states", "KickLeft") == pytest.approx(spot, abs=1)
    hand.drag(spot, (spot[0] - 120, spot[1] + 40), button="middle")
    assert hand.at("states", "KickLeft") == pytest.approx((spot[0] - 120, spot[1] + 40), abs=1)
    assert not hand.gestures("move")


def test_two_fingers_on_a_touchpad_pan(hand: CanvasDriver) -> None:
    spot = hand.at("states", "KickLeft")
    hand.page.mouse.move(*spot)
    hand.page.mouse.wheel(7, 13)
    hand.wait_for(f"Math.abs(vicode.screen('states', 'KickLeft').x - {spot[0] - 7}) < 1")
    assert hand.at("states", "KickLeft") == pytest.approx((spot[0] - 7, spot[1] - 13), abs=1)


def test_one_finger_pans_and_two_zoom(hand: CanvasDriver) -> None:
    cdp = hand.page.context.new_cdp_session(hand.page)

    def touch(kind: str, *points: tuple[float, float]) -> None:
        fingers = [{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(points)]
        cdp.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})

    spot = hand.at("states", "KickLeft")
    touch("touchStart", (620, 650))
    touch("touchMove", (620, 600))
    touch("touchMove", (640, 560))
    touch("touchEnd")
    hand.wait_for(f"vicode.screen('states', 'KickLeft').y < {spot[1] - 80}")
    before = hand.evaluate("view()")["k"]
    touch("touchStart", (600, 500), (700, 500))
    touch("touchMove", (560, 500), (740, 500))
    touch("touchMove", (520, 500), (780, 500))
    touch("touchEnd")
    hand.wait_for(f"vicode.view().k > {before} * 1.5")
    assert not hand.gestures("move")
    hand.drag((620, 330), (660, 330))
    assert not hand.gestures("create")


def test_a_press_on_the_minimap_goes_there(hand: CanvasDriver) -> None:
    minimap = hand.page.locator(".minimap")
    expect(minimap).to_be_hidden()
    hand.call("centre", "states", "LookForBall")
    hand.page.locator(".stage").focus()
    hand.press("+", "+", "+", "+")
    expect(minimap).to_be_visible()
    before = hand.evaluate("view()")["x"]
    minimap.click(position={"x": 160, "y": 90})
    hand.wait_for(f"vicode.view().x < {before} - 100")


def test_a_large_machine_is_a_picture_from_far_and_boxes_from_near(show: Show) -> None:
    hand = show(machine(400))
    assert hand.evaluate("view()")["far"]
    assert hand.evaluate("mounted()") == 0
    hand.click(hand.at("states", "State210"))
    expect(hand.group("state", "State210")).to_have_class(re.compile("selected"))
    x, y = hand.at("states", "State210")
    before = hand.position("states/State210")
    hand.drag((x, y), (x + 60, y + 30))
    assert hand.wait_for_gesture("move")["items"][0]["id"] == "State210"
    assert hand.position("states/State210") != before
    hand.call("centre", "states", "State0")
    hand.wait_for("!vicode.view().far")
    expect(hand.group("state", "State0")).to_be_visible()
    assert hand.evaluate("mounted()") < 700


def test_a_crowd_zooms_as_a_picture_and_is_there_again_for_a_hand(show: Show) -> None:
    hand = show(machine(400))
    hand.call("centre", "states", "State210")
    hand.wait_for("!vicode.view().far")
    hand.wait_until_idle()
    hand.wait_for("vicode.mounted() > 250")
    # The coarse bitmap must be there, which has time to be drawn.
    hand.page.wait_for_timeout(700)
    spot = hand.at("states", "State210")
    hand.page.mouse.move(*spot)
    frozen = hand.page.locator(".stage.frozen")
    hand.page.evaluate(
        """() => {
          const stage = document.querySelector('.vicode-canvas').shadowRoot.querySelector('.stage');
          window.wasFrozen = false;
          new MutationObserver(() => { window.wasFrozen ||= stage.classList.contains('frozen'); })
            .observe(stage, {attributes: true});
        }"""
    )
    hand.page.mouse.wheel(0, -60)
    hand.page.mouse.wheel(0, -60)
    hand.wait_for("window.wasFrozen")
    hand.click(spot)
    expect(frozen).to_have_count(0)
    assert hand.selection() == {"states/State210"}
    hand.wait_until_idle()
    box = hand.group("state", "State210").locator("rect.box").bounding_box()
    assert box is not None
    assert (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2) == pytest.approx(spot, abs=1)


@pytest.mark.parametrize(("wish", "theme"), [("dark", "dark"), ("light", "light"), ("auto", "light")])
def test_the_view_or_the_page_decide_between_light_and_dark(show: Show, wish: str, theme: str) -> None:
    page = show({**player(), "theme": wish}).page
    expect(page.locator(".stage")).to_have_attribute("data-theme", theme)
    page.evaluate("Quasar.Dark.set(true)")
    expect(page.locator(".stage")).to_have_attribute("data-theme", "dark" if wish == "auto" else theme)
    page.evaluate("Quasar.Dark.set(false)")


def test_an_empty_design_says_how_to_begin(show: Show) -> None:
    hand = show({**machine(2), "states": [], "transitions": []})
    expect(hand.page.locator(".empty")).to_be_visible()


def _overlap(a: list[Any], b: list[Any]) -> bool:
    return a[0] + 1 < b[0] + b[2] and b[0] + 1 < a[0] + a[2] and a[1] + 1 < b[1] + b[3] and b[1] + 1 < a[1] + a[3]
