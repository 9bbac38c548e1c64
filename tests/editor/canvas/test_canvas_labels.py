"""Labels lie on their edges and hide nothing, however the scene came about."""

from collections.abc import Callable, Mapping
from typing import Any

import pytest
from playwright.sync_api import expect

from tests.editor.canvas.conftest import CanvasDriver
from tests.editor.canvas.player_scene import machine, player

Show = Callable[[Mapping[str, Any]], CanvasDriver]
Scene = dict[str, Any]


@pytest.mark.parametrize("new_name", ["Chase", "Zigzag"])
def test_labels_after_a_rename_lie_where_a_fresh_scene_has_them(show: Show, new_name: str) -> None:
    before, after = _pair("Approach"), _pair(new_name)
    hand = show(before)
    hand.call("apply", _difference(before, after))
    expect(hand.group("transition", f"{new_name}/1")).to_have_count(1)
    renamed = _drawn(hand)
    assert renamed == _drawn(show(after))


def test_labels_after_a_transition_went_lie_where_a_fresh_scene_has_them(show: Show) -> None:
    before = _pair("Approach")
    after = {**before, "rev": 2, "transitions": before["transitions"][1:]}
    hand = show(before)
    hand.call("apply", _difference(before, after))
    expect(hand.page.locator("g.edge")).to_have_count(2)
    left = _drawn(hand)
    assert left == _drawn(show(after))


def test_edges_straighten_when_the_box_in_their_way_is_gone(show: Show) -> None:
    free = _pair("Approach")
    states = [*free["states"], {"id": "Between", "name": "Between", "x": 200, "y": 0}]
    hand = show({**free, "states": states})
    bowed = _drawn(hand)
    hand.call("apply", {"rev": 2, "remove": {"states": ["Between"]}})
    expect(hand.page.locator("g.node")).to_have_count(2)
    straight = _drawn(hand)
    assert straight != bowed
    assert straight == _drawn(show(free))


def test_the_mark_of_findings_stands_beside_the_label(show: Show) -> None:
    scene = player()
    for transition in scene["transitions"]:
        transition.update(severity="warning", messages=["doubtful"])
    hand = show(scene)
    chips = hand.page.locator("g.chip:has(.label)").evaluate_all(
        """chips => chips.map(chip => {
          const [text, mark] = [".label", ".badge"].map(part => chip.querySelector(part).getBoundingClientRect());
          return [chip.dataset.id, text.right, mark.left];
        })"""
    )
    assert "LookForBall/1" in [identity for identity, _right, _left in chips]
    assert [identity for identity, right, left in chips if right > left] == []


def _pair(name: str) -> Scene:
    """Two transitions from a state to another and one back."""
    other, leads = "Base", [("near", 0), ("seen", 1)]
    transitions = [
        {"id": f"{name}/{n}", "source": name, "target": other, "label": label, "order": n + 1, "of": 2, "kind": "guard"}
        for label, n in leads
    ]
    back = {"id": "Base/0", "source": other, "target": name, "label": "lost", "order": 1, "of": 1, "kind": "guard"}
    states = [{"id": each, "name": each, "x": x, "y": 0} for each, x in ((name, 0), (other, 400))]
    return {**machine(2), "component": "Pair", "states": states, "transitions": [*transitions, back]}


def _difference(old: Scene, new: Scene) -> dict[str, Any]:
    kinds = ("states", "transitions")
    ids = {kind: {thing["id"] for thing in new[kind]} for kind in kinds}
    return {
        "rev": 2,
        "upsert": {kind: [thing for thing in new[kind] if thing not in old[kind]] for kind in kinds},
        "remove": {kind: [thing["id"] for thing in old[kind] if thing["id"] not in ids[kind]] for kind in kinds},
    }


def _drawn(hand: CanvasDriver) -> dict[str, list[str]]:
    """The curve and the place of the label of every transition."""
    hand.page.wait_for_timeout(50)
    drawn: dict[str, list[str]] = hand.page.evaluate(
        """() => {
          const root = document.querySelector('.vicode-canvas').shadowRoot;
          const of = (id, part) => root.querySelector(`g.${part}[data-id="${id}"]`);
          const ids = [...root.querySelectorAll('g.edge')].map(edge => edge.dataset.id);
          return Object.fromEntries(ids.map(id => [
            id, [of(id, 'edge').querySelector('.line').getAttribute('d'), of(id, 'chip').dataset.at]]));
        }"""
    )
    return drawn
