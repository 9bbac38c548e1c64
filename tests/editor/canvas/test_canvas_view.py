"""Drawing, view and the methods that Python calls."""

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


def test_every_element_has_a_role_and_an_accessible_name(canvas: CanvasDriver) -> None:
    expect(canvas.page.locator("g.node")).to_have_count(8 + 3 + 1)
    expect(canvas.page.locator("g.edge")).to_have_count(12 + 5)
    expect(canvas.page.get_by_role("button", name="State LookForBall, initial")).to_have_count(1)
    expect(
        canvas.page.get_by_role("button", name="Transition 2 of 3 from LookForBall to LookForBall: 5 s")
    ).to_have_count(1)
    assert canvas.page.locator(".vicode-canvas").get_attribute("data-rev") == "1"


def test_labels_overlap_neither_nodes_nor_each_other(canvas: CanvasDriver) -> None:
    boxes = canvas.page.locator("g.node .box, g.chip .plate").evaluate_all(
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
    canvas = show(scene)
    page = canvas.page
    expect(page.locator("g.node.component").first).to_be_visible()
    canvas.click(canvas.at("states", "GiveUp"), double=True)
    expect(page.locator("input.rename")).to_have_value(HOSTILE)
    canvas.press("Escape")
    for kind, identity in (("states", "GetUp"), ("transitions", "LookForBall/1"), ("components", HOSTILE)):
        page.mouse.move(*canvas.at(kind, identity))
        expect(page.locator(".tooltip")).to_contain_text(HOSTILE[:20])
    assert page.locator(".vicode-canvas img").count() == 0
    assert page.locator("body").get_attribute("data-hacked") is None


def test_apply_changes_only_the_listed_elements(canvas: CanvasDriver) -> None:
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
    canvas.call(
        "apply",
        {"rev": 2, "upsert": {"states": [lost, follow], "transitions": [edge]}, "remove": {"states": ["GiveUp"]}},
    )
    expect(canvas.page.locator(".vicode-canvas")).to_have_attribute("data-rev", "2")
    expect(canvas.group("state", "Lost")).to_be_visible()
    expect(canvas.group("state", "FollowBall").locator(".name")).to_have_text("Chase")
    expect(canvas.group("transition", added)).to_have_count(1)
    expect(canvas.group("state", "GiveUp")).to_have_count(0)
    expect(canvas.page.locator("g.node")).to_have_count(12)


def test_a_remounted_element_shows_all_changes(canvas: CanvasDriver) -> None:
    canvas.click(canvas.at("states", "GiveUp"))
    canvas.press("ArrowRight")
    canvas.wait_for_gesture("move")
    canvas.call("apply", {"rev": 9, "remove": {"states": ["KickLeft"]}, "common": None})
    expect(canvas.page.locator(".vicode-canvas")).to_have_attribute("data-rev", "9")
    # NiceGUI does the same when it remounts the element.
    canvas.page.evaluate(
        """() => {
          const canvas = document.querySelector('.vicode-canvas');
          canvas.removeAttribute('data-ready');
          getElement(canvas.id.slice(1)).$emit('ready', {});
        }"""
    )
    canvas.page.wait_for_selector(".vicode-canvas[data-ready]")
    assert canvas.position("states/GiveUp") == (90, 330)
    assert "common/@common" not in canvas.evaluate("positions()")
    assert "states/KickLeft" not in canvas.evaluate("positions()")


def test_select_from_python_reports_no_gesture(canvas: CanvasDriver) -> None:
    canvas.call("select", [{"of": "transitions", "id": "Fixmove/0"}])
    canvas.wait_for("vicode.selection().length === 1")
    assert canvas.selection() == {"transitions/Fixmove/0"}
    assert not canvas.gestures("select")


def test_the_newest_active_states_win(canvas: CanvasDriver) -> None:
    # The page is shared by all tests, and sequence numbers must increase.
    start = time.monotonic_ns() // 1000
    for number in range(7):
        canvas.call("highlight_active", [["LookForBall", "FollowBall"][number % 2]], start + number)
    canvas.call("highlight_active", ["GetUp"], start + 2)
    expect(canvas.page.locator("g.node.active")).to_have_attribute("data-id", "LookForBall")
    canvas.call("highlight_active", [], start + 7)
    expect(canvas.page.locator("g.node.active")).to_have_count(0)


def test_links_can_be_hidden(canvas: CanvasDriver) -> None:
    canvas.call("show_links", False)
    expect(canvas.page.locator("g.edge.link")).to_have_count(0)
    canvas.call("show_links", True)
    expect(canvas.page.locator("g.edge.link")).to_have_count(5)


def test_a_press_on_the_minimap_centers_the_view_there(canvas: CanvasDriver) -> None:
    minimap = canvas.page.locator(".minimap")
    expect(minimap).to_be_hidden()
    canvas.call("center", "states", "LookForBall")
    canvas.page.locator(".stage").focus()
    canvas.press("+", "+", "+", "+")
    expect(minimap).to_be_visible()
    before = canvas.evaluate("view()")["x"]
    minimap.click(position={"x": 160, "y": 90})
    canvas.wait_for(f"vicode.view().x < {before} - 100")


def test_a_large_machine_is_a_bitmap_when_zoomed_out_and_svg_when_zoomed_in(show: Show) -> None:
    canvas = show(machine(400))
    assert canvas.evaluate("view()")["far"]
    assert canvas.evaluate("mounted()") == 0
    canvas.click(canvas.at("states", "State210"))
    expect(canvas.group("state", "State210")).to_have_class(re.compile("selected"))
    x, y = canvas.at("states", "State210")
    before = canvas.position("states/State210")
    canvas.drag((x, y), (x + 60, y + 30))
    assert canvas.wait_for_gesture("move")["items"][0]["id"] == "State210"
    assert canvas.position("states/State210") != before
    canvas.call("center", "states", "State0")
    canvas.wait_for("!vicode.view().far")
    expect(canvas.group("state", "State0")).to_be_visible()
    assert canvas.evaluate("mounted()") < 700


def test_many_elements_zoom_as_a_snapshot_and_react_to_a_click(show: Show) -> None:
    canvas = show(machine(400))
    canvas.call("center", "states", "State210")
    canvas.wait_for("!vicode.view().far")
    canvas.wait_until_idle()
    canvas.wait_for("vicode.mounted() > 250")
    # Wait for the coarse bitmap, which is drawn in idle time.
    canvas.page.wait_for_timeout(700)
    spot = canvas.at("states", "State210")
    canvas.page.mouse.move(*spot)
    frozen = canvas.page.locator(".stage.frozen")
    canvas.page.evaluate(
        """() => {
          const stage = document.querySelector('.vicode-canvas').shadowRoot.querySelector('.stage');
          window.wasFrozen = false;
          new MutationObserver(() => { window.wasFrozen ||= stage.classList.contains('frozen'); })
            .observe(stage, {attributes: true});
        }"""
    )
    canvas.page.mouse.wheel(0, -60)
    canvas.page.mouse.wheel(0, -60)
    canvas.wait_for("window.wasFrozen")
    canvas.click(spot)
    expect(frozen).to_have_count(0)
    assert canvas.selection() == {"states/State210"}
    canvas.wait_until_idle()
    box = canvas.group("state", "State210").locator("rect.box").bounding_box()
    assert box is not None
    assert (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2) == pytest.approx(spot, abs=1)


@pytest.mark.parametrize(("preference", "theme"), [("dark", "dark"), ("light", "light"), ("auto", "light")])
def test_the_theme_of_the_scene_overrides_the_theme_of_the_page(show: Show, preference: str, theme: str) -> None:
    page = show({**player(), "theme": preference}).page
    expect(page.locator(".stage")).to_have_attribute("data-theme", theme)
    page.evaluate("Quasar.Dark.set(true)")
    expect(page.locator(".stage")).to_have_attribute("data-theme", "dark" if preference == "auto" else theme)
    page.evaluate("Quasar.Dark.set(false)")


def test_an_empty_design_shows_how_to_start(show: Show) -> None:
    canvas = show({**machine(2), "states": [], "transitions": []})
    expect(canvas.page.locator(".empty")).to_be_visible()


def _overlap(a: list[Any], b: list[Any]) -> bool:
    return a[0] + 1 < b[0] + b[2] and b[0] + 1 < a[0] + a[2] and a[1] + 1 < b[1] + b[3] and b[1] + 1 < a[1] + a[3]


def test_hovering_and_selecting_leave_the_rest_of_the_drawing_as_it_is(canvas: CanvasDriver) -> None:
    other = canvas.group("state", "GiveUp")
    look = "each => ['fillOpacity', 'strokeOpacity', 'opacity'].map(name => getComputedStyle(each)[name])"
    before = other.locator(".box").evaluate(look)
    canvas.click(canvas.at("states", "LookForBall"))
    # Longer than any delay after which the drawing may change.
    canvas.page.wait_for_timeout(250)
    assert canvas.group("state", "LookForBall").evaluate("each => each.classList.contains('lit')")
    assert other.locator(".box").evaluate(look) == before


def test_a_diagram_fitted_below_the_legible_zoom_shows_large_names_and_says_so(show: Show) -> None:
    scene = player()
    for state in scene["states"]:
        state.update(x=state["x"] * 3, y=state["y"] * 3)
    canvas = show(scene)
    name = canvas.group("state", "LookForBall").locator(".large").first
    expect(name).to_be_visible()
    assert name.evaluate("each => parseFloat(getComputedStyle(each).fontSize)") > 14
    expect(canvas.page.locator(".message")).to_contain_text("names only")
    expect(canvas.page.locator("g.chip .plate").first).to_be_hidden()
    canvas.press("0")
    canvas.wait_until_idle()
    expect(name).to_be_hidden()
    expect(canvas.page.locator("g.chip .plate").first).to_be_visible()


def test_the_initial_mark_avoids_arrows(show: Show) -> None:
    states = [{"id": name, "name": name, "x": x, "y": y} for name, x, y in (("A", 0, 0), ("B", -200, -130))]
    states[0]["initial"] = True
    edge = {"id": "B/0", "source": "B", "target": "A", "label": "", "order": 1, "of": 1, "kind": "always"}
    canvas = show(
        {"rev": 1, "component": "Robot", "states": states, "transitions": [edge], "components": [], "links": []}
    )
    side = "([dot, box]) => dot.getBoundingClientRect().x > box.getBoundingClientRect().x"
    parts = [canvas.group("state", "A").locator(part).element_handle() for part in (".start-dot", ".box")]
    assert canvas.page.evaluate(side, parts)
    canvas.call("apply", {"rev": 2, "remove": {"transitions": ["B/0"]}})
    expect(canvas.page.locator("g.edge")).to_have_count(0)
    parts = [canvas.group("state", "A").locator(part).element_handle() for part in (".start-dot", ".box")]
    assert not canvas.page.evaluate(side, parts)
