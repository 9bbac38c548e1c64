"""Label positions and edge curves after changes equal those of a fresh scene."""

from collections.abc import Callable, Mapping
from typing import Any

import pytest
from playwright.sync_api import expect

from tests.editor.canvas.conftest import CanvasDriver
from tests.editor.canvas.player_scene import machine, player

Show = Callable[[Mapping[str, Any]], CanvasDriver]
Scene = dict[str, Any]


@pytest.mark.parametrize("new_name", ["Chase", "Zigzag"])
def test_label_positions_after_a_rename_equal_those_of_a_fresh_scene(show: Show, new_name: str) -> None:
    before, after = _pair("Approach"), _pair(new_name)
    canvas = show(before)
    canvas.call("apply", _difference(before, after))
    expect(canvas.group("transition", f"{new_name}/1")).to_have_count(1)
    renamed = _drawn(canvas)
    assert renamed == _drawn(show(after))


def test_label_positions_after_a_removed_transition_equal_those_of_a_fresh_scene(show: Show) -> None:
    before = _pair("Approach")
    after = {**before, "rev": 2, "transitions": before["transitions"][1:]}
    canvas = show(before)
    canvas.call("apply", _difference(before, after))
    expect(canvas.page.locator("g.edge")).to_have_count(2)
    left = _drawn(canvas)
    assert left == _drawn(show(after))


def test_edges_straighten_when_a_node_in_their_way_is_removed(show: Show) -> None:
    free = _pair("Approach")
    states = [*free["states"], {"id": "Between", "name": "Between", "x": 200, "y": 0}]
    canvas = show({**free, "states": states})
    bowed = _drawn(canvas)
    canvas.call("apply", {"rev": 2, "remove": {"states": ["Between"]}})
    expect(canvas.page.locator("g.node")).to_have_count(2)
    straight = _drawn(canvas)
    assert straight != bowed
    assert straight == _drawn(show(free))


def test_the_badge_with_findings_does_not_cover_the_label(show: Show) -> None:
    scene = player()
    for transition in scene["transitions"]:
        transition.update(severity="warning", messages=["doubtful"])
    canvas = show(scene)
    chips = canvas.page.locator("g.chip:has(.label)").evaluate_all(
        """chips => chips.map(chip => {
          const [text, mark] = [".label", ".badge"].map(part => chip.querySelector(part).getBoundingClientRect());
          return [chip.dataset.id, text.right, mark.left];
        })"""
    )
    assert "LookForBall/1" in [identity for identity, _right, _left in chips]
    assert [identity for identity, right, left in chips if right > left] == []


def _pair(name: str) -> Scene:
    """Two transitions from a state to another, and one back."""
    other, leads = "Base", [("near", 0), ("seen", 1)]
    transitions = [
        {"id": f"{name}/{n}", "source": name, "target": other, "label": label, "order": n + 1, "of": 2, "kind": "guard"}
        for label, n in leads
    ]
    back = {"id": "Base/0", "source": other, "target": name, "label": "lost", "order": 1, "of": 1, "kind": "guard"}
    states = [{"id": state, "name": state, "x": x, "y": 0} for state, x in ((name, 0), (other, 400))]
    return {**machine(2), "component": "Pair", "states": states, "transitions": [*transitions, back]}


def _difference(old: Scene, new: Scene) -> dict[str, Any]:
    kinds = ("states", "transitions")
    ids = {kind: {item["id"] for item in new[kind]} for kind in kinds}
    return {
        "rev": 2,
        "upsert": {kind: [item for item in new[kind] if item not in old[kind]] for kind in kinds},
        "remove": {kind: [item["id"] for item in old[kind] if item["id"] not in ids[kind]] for kind in kinds},
    }


def _drawn(canvas: CanvasDriver) -> dict[str, list[str]]:
    """Curve and label position of every transition."""
    canvas.page.wait_for_timeout(50)
    drawn: dict[str, list[str]] = canvas.page.evaluate(
        """() => {
          const root = document.querySelector('.vicode-canvas').shadowRoot;
          const of = (id, part) => root.querySelector(`g.${part}[data-id="${id}"]`);
          const ids = [...root.querySelectorAll('g.edge')].map(edge => edge.dataset.id);
          return Object.fromEntries(ids.map(id => [
            id, [of(id, 'edge').querySelector('.line').getAttribute('d'), of(id, 'chip').dataset.at]]));
        }"""
    )
    return drawn
