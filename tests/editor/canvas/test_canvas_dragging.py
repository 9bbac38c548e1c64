"""Several boxes under one hand: what lies between them moves with them, the rest follows, and all is well after it."""

from collections.abc import Callable, Mapping
from typing import Any

from playwright.sync_api import expect

from tests.editor.canvas.conftest import CanvasDriver, Point
from tests.editor.canvas.player_scene import machine, player

Show = Callable[[Mapping[str, Any]], CanvasDriver]

PLACES = """names => {
  const root = document.querySelector('.vicode-canvas').shadowRoot;
  return names.map(name => {
    const box = root.querySelector(name).getBoundingClientRect();
    return [box.x + box.width / 2, box.y + box.height / 2];
  });
}"""
DRAWN = """() => {
  const root = document.querySelector('.vicode-canvas').shadowRoot;
  const parts = [...root.querySelectorAll('g.item:not(.chip)')];
  const shape = part => [...part.querySelectorAll('*')].map(each => [
    each.getAttribute('d'), each.getAttribute('x'), each.getAttribute('y'), each.textContent,
  ]);
  return Object.fromEntries(parts.map(part => [
    part.dataset.key, [part.getAttribute('transform'), part.dataset.at, shape(part)],
  ]));
}"""

INNER = ("FollowBall/1", "FollowBall/2", "SearchNet/1")
TOGETHER = (
    '.node[data-id="FollowBall"] .box',
    '.node[data-id="SearchNet"] .name',
    *(f'.edge[data-id="{name}"] {part}' for name in INNER for part in (".line", ".head")),
    *(f'.chip[data-id="{name}"]' for name in INNER),
)
OTHERS = ('.node[data-id="Fixmove"] .box', '.edge[data-id="Fixmove/0"] .line')


def pick_up(hand: CanvasDriver, *names: str) -> Point:
    """Select states and hold them by the first."""
    hand.call("select", [{"of": "states", "id": name} for name in names])
    hand.wait_for(f"vicode.selection().length === {len(names)}")
    start = hand.at("states", names[0])
    hand.page.mouse.move(*start)
    hand.page.mouse.down()
    return start


def carry(hand: CanvasDriver, spot: Point, name: str) -> None:
    """Move what is held until its first state has left its place."""
    x, y = hand.position(f"states/{name}")
    hand.page.mouse.move(*spot, steps=4)
    hand.wait_for(
        f"Math.hypot(vicode.positions()['states/{name}'].x - {x}, vicode.positions()['states/{name}'].y - {y}) > 5"
    )
    hand.page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def places(hand: CanvasDriver, names: tuple[str, ...]) -> list[Point]:
    return [(x, y) for x, y in hand.page.evaluate(PLACES, list(names))]


def shifts(before: list[Point], after: list[Point]) -> set[Point]:
    return {(round(b[0] - a[0]), round(b[1] - a[1])) for a, b in zip(before, after, strict=True)}


def test_what_lies_between_held_boxes_moves_with_them(hand: CanvasDriver) -> None:
    before, others = places(hand, TOGETHER), places(hand, OTHERS)
    (reaching,) = places(hand, ('.edge[data-id="SearchNet/0"] .line',))
    x, y = pick_up(hand, "FollowBall", "SearchNet")
    carry(hand, (x + 83, y - 37), "FollowBall")
    ((right, down),) = shifts(before, places(hand, TOGETHER))
    assert right > 40
    assert down < -10
    assert shifts(others, places(hand, OTHERS)) == {(0, 0)}
    # An arrow with one end in the hand stretches.
    ((stretched_by, _),) = shifts([reaching], places(hand, ('.edge[data-id="SearchNet/0"] .line',)))
    assert 0 < stretched_by < right
    hand.page.mouse.up()
    hand.wait_for_gesture("move")
    assert shifts(before[:2], places(hand, TOGETHER[:2])) == {(right, down)}
    assert hand.page.locator(".held > *").count() == 0


def test_after_a_drag_boxes_and_arrows_are_drawn_as_if_they_had_always_stood_there(
    hand: CanvasDriver, show: Show
) -> None:
    for scene, names in (
        (None, ("FollowBall", "SearchNet")),
        (machine(40), tuple(f"State{n}" for n in range(2, 40, 2))),
    ):
        if scene is not None:
            show(scene)
        x, y = pick_up(hand, *names)
        carry(hand, (x + 41, y + 23), names[0])
        hand.page.mouse.up()
        hand.wait_for_gesture("move")
        hand.wait_until_idle()
        drawn = hand.page.evaluate(DRAWN)
        # Drawn anew, at the latest when the page tells of the revision that came after it.
        hand.call("show_links", False)
        hand.call("show_links", True)
        hand.call("apply", {"rev": 99})
        expect(hand.page.locator(".vicode-canvas")).to_have_attribute("data-rev", "99")
        hand.wait_until_idle()
        again = hand.page.evaluate(DRAWN)
        assert drawn.keys() == again.keys()
        assert [key for key in drawn if drawn[key] != again[key]] == []


def test_many_arrows_are_led_straight_and_have_their_labels_again_after_it(show: Show) -> None:
    hand = show(machine(40))
    names = tuple(f"State{n}" for n in range(2, 40, 2))
    label = hand.page.locator('.chip[data-id="State2/0"]')
    expect(label).to_be_visible()
    x, y = pick_up(hand, *names)
    carry(hand, (x + 41, y + 23), names[0])
    expect(label).to_be_hidden()
    hand.press("Escape")
    expect(label).to_be_visible()
    hand.page.mouse.up()
    assert hand.position("states/State2") == (480, 0)


def test_a_box_that_changes_in_the_hand_stays_in_it(hand: CanvasDriver) -> None:
    before = places(hand, TOGETHER[:1])
    x, y = pick_up(hand, "FollowBall", "SearchNet")
    carry(hand, (x + 40, y + 20), "FollowBall")
    drawn = hand.page.evaluate("document.querySelector('.vicode-canvas').vicode.positions()['states/SearchNet']")
    scene = player_state("SearchNet")
    hand.call("apply", {"rev": 2, "upsert": {"states": [{**scene, "name": "SearchGoal"}]}})
    expect(hand.group("state", "SearchNet").locator(".name")).to_have_text("SearchGoal")
    carry(hand, (x + 83, y + 43), "FollowBall")
    assert drawn["x"] < hand.position("states/SearchNet")[0]
    ((right, down),) = shifts(before, places(hand, TOGETHER[:1]))
    boxes = places(hand, ('.node[data-id="FollowBall"] .box', '.node[data-id="SearchNet"] .box'))
    apart = hand.evaluate("view()")["k"] * (760 - 420)
    assert abs(boxes[1][0] - boxes[0][0] - apart) < 1
    assert boxes[1][1] == boxes[0][1]
    assert right > 40
    assert down > 20
    hand.press("Escape")
    hand.page.mouse.up()


def player_state(name: str) -> dict[str, Any]:
    return next(state for state in player()["states"] if state["id"] == name)
