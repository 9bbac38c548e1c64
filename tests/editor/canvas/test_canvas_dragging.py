"""Dragging several nodes: edges between them move along, other edges follow."""

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


def start_drag(canvas: CanvasDriver, *names: str) -> Point:
    """Select states and press the pointer on the first."""
    canvas.call("select", [{"of": "states", "id": name} for name in names])
    canvas.wait_for(f"vicode.selection().length === {len(names)}")
    start = canvas.at("states", names[0])
    canvas.page.mouse.move(*start)
    canvas.page.mouse.down()
    return start


def drag_to(canvas: CanvasDriver, position: Point, name: str) -> None:
    """Move the pointer and wait until the state has moved."""
    x, y = canvas.position(f"states/{name}")
    canvas.page.mouse.move(*position, steps=4)
    canvas.wait_for(
        f"Math.hypot(vicode.positions()['states/{name}'].x - {x}, vicode.positions()['states/{name}'].y - {y}) > 5"
    )
    canvas.page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def places(canvas: CanvasDriver, names: tuple[str, ...]) -> list[Point]:
    return [(x, y) for x, y in canvas.page.evaluate(PLACES, list(names))]


def shifts(before: list[Point], after: list[Point]) -> set[Point]:
    return {(round(b[0] - a[0]), round(b[1] - a[1])) for a, b in zip(before, after, strict=True)}


def test_edges_between_dragged_nodes_move_with_them(canvas: CanvasDriver) -> None:
    before, others = places(canvas, TOGETHER), places(canvas, OTHERS)
    (reaching,) = places(canvas, ('.edge[data-id="SearchNet/0"] .line',))
    x, y = start_drag(canvas, "FollowBall", "SearchNet")
    drag_to(canvas, (x + 83, y - 37), "FollowBall")
    ((right, down),) = shifts(before, places(canvas, TOGETHER))
    assert right > 40
    assert down < -10
    assert shifts(others, places(canvas, OTHERS)) == {(0, 0)}
    # An edge with one dragged end stretches.
    ((stretched_by, _),) = shifts([reaching], places(canvas, ('.edge[data-id="SearchNet/0"] .line',)))
    assert 0 < stretched_by < right
    canvas.page.mouse.up()
    canvas.wait_for_gesture("move")
    assert shifts(before[:2], places(canvas, TOGETHER[:2])) == {(right, down)}
    assert canvas.page.locator(".held > *").count() == 0


def test_drawing_after_a_drag_equals_a_fresh_drawing(canvas: CanvasDriver, show: Show) -> None:
    for scene, names in (
        (None, ("FollowBall", "SearchNet")),
        (machine(40), tuple(f"State{n}" for n in range(2, 40, 2))),
    ):
        if scene is not None:
            show(scene)
        x, y = start_drag(canvas, *names)
        drag_to(canvas, (x + 41, y + 23), names[0])
        canvas.page.mouse.up()
        canvas.wait_for_gesture("move")
        canvas.wait_until_idle()
        drawn = canvas.page.evaluate(DRAWN)
        # Redrawn, at the latest when the page shows the later revision.
        canvas.call("show_links", False)
        canvas.call("show_links", True)
        canvas.call("apply", {"rev": 99})
        expect(canvas.page.locator(".vicode-canvas")).to_have_attribute("data-rev", "99")
        canvas.wait_until_idle()
        again = canvas.page.evaluate(DRAWN)
        assert drawn.keys() == again.keys()
        assert [key for key in drawn if drawn[key] != again[key]] == []


def test_large_drags_hide_labels_until_the_end(show: Show) -> None:
    canvas = show(machine(40))
    names = tuple(f"State{n}" for n in range(2, 40, 2))
    label = canvas.page.locator('.chip[data-id="State2/0"]')
    expect(label).to_be_visible()
    x, y = start_drag(canvas, *names)
    drag_to(canvas, (x + 41, y + 23), names[0])
    expect(label).to_be_hidden()
    canvas.press("Escape")
    expect(label).to_be_visible()
    canvas.page.mouse.up()
    assert canvas.position("states/State2") == (480, 0)


def test_a_node_that_changes_during_a_drag_stays_in_the_drag(canvas: CanvasDriver) -> None:
    before = places(canvas, TOGETHER[:1])
    x, y = start_drag(canvas, "FollowBall", "SearchNet")
    drag_to(canvas, (x + 40, y + 20), "FollowBall")
    drawn = canvas.page.evaluate("document.querySelector('.vicode-canvas').vicode.positions()['states/SearchNet']")
    scene = player_state("SearchNet")
    canvas.call("apply", {"rev": 2, "upsert": {"states": [{**scene, "name": "SearchGoal"}]}})
    expect(canvas.group("state", "SearchNet").locator(".name")).to_have_text("SearchGoal")
    drag_to(canvas, (x + 83, y + 43), "FollowBall")
    assert drawn["x"] < canvas.position("states/SearchNet")[0]
    ((right, down),) = shifts(before, places(canvas, TOGETHER[:1]))
    boxes = places(canvas, ('.node[data-id="FollowBall"] .box', '.node[data-id="SearchNet"] .box'))
    apart = canvas.evaluate("view()")["k"] * (760 - 420)
    assert abs(boxes[1][0] - boxes[0][0] - apart) < 1
    assert boxes[1][1] == boxes[0][1]
    assert right > 40
    assert down > 20
    canvas.press("Escape")
    canvas.page.mouse.up()


def player_state(name: str) -> dict[str, Any]:
    return next(state for state in player()["states"] if state["id"] == name)
