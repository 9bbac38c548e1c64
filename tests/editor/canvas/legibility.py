"""Legibility of a diagram: metrics measured in the browser, and the designs that they are measured on."""

import random
from dataclasses import dataclass, replace
from typing import Any

from playwright.sync_api import Page

from tests.diagram.diagram_designs import shipped_designs
from vicode.diagram.layout import LayoutService
from vicode.editor.session import apply_layout
from vicode.editor.view import make_scene
from vicode.model.design import CommonSection, Design, Guard, State, Transition
from vicode.model.project import Project

GUARDS = ("seen", "ball.near and not lost", "x > 0", "tries >= 3", "ball_distance < 400 and net_seen", "done", "left")

# All rectangles are shrunk by a pixel, so that touching ones do not count as overlapping.
COUNT = """() => {
    const root = document.querySelector('.vicode-canvas').shadowRoot;
    // Measured as when zoomed in: below 50 % labels are hidden.
    root.querySelector('.plane').classList.remove('small');
    const {k} = document.querySelector('.vicode-canvas').vicode.view();
    const rect = (element, key) => {
        const {x, y, width, height} = element.getBoundingClientRect();
        return {key, x: x / k + 1, y: y / k + 1, right: (x + width) / k - 1, bottom: (y + height) / k - 1};
    };
    const all = (selector, part) => [...root.querySelectorAll(selector)].filter(each => each.querySelector(part))
        .map(each => rect(each.querySelector(part), each.dataset.key));
    const boxes = all('g.node', '.box');
    const plates = all('g.chip', '.plate');
    const overlap = (a, b) => a.x < b.right && b.x < a.right && a.y < b.bottom && b.y < a.bottom;
    const within = (box, {x, y}) => x > box.x && x < box.right && y > box.y && y < box.bottom;
    const corner = new DOMPoint(0, 0);
    const lines = [...root.querySelectorAll('g.edge')].map(edge => {
        const line = edge.querySelector('.line');
        const {a, d, e, f} = line.getScreenCTM();
        const length = line.getTotalLength();
        const steps = Math.max(2, Math.ceil(length / 5));
        const points = Array.from({length: steps + 1}, (_, n) => line.getPointAtLength(length * n / steps))
            .map(({x, y}) => ({x: (x * a + e) / k, y: (y * d + f) / k}));
        return {key: edge.dataset.key, ends: (edge.dataset.ends ?? '').split(' '), points};
    });
    const pairs = (list, test) => list.flatMap((one, n) => list.slice(n + 1).filter(other => test(one, other)));
    const through = (targets) => lines.flatMap(line => targets.filter(target =>
        target.key !== line.key && line.points.slice(4, -4).some(point => within(target, point))));
    const far = plates.filter(plate => {
        const line = lines.find(each => each.key === plate.key);
        const room = {x: plate.x - 12, y: plate.y - 12, right: plate.right + 12, bottom: plate.bottom + 12};
        return line && !line.points.some(point => within(room, point));
    });
    return {
        boxes: boxes.length,
        labels: plates.length,
        labels_on_boxes: plates.flatMap(plate => boxes.filter(box => overlap(plate, box))).length,
        labels_on_labels: pairs(plates, overlap).length,
        labels_off_their_lines: far.length,
        lines_over_boxes: through(boxes).length,
        lines_under_labels: through(plates).length,
    };
}"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Legibility:
    """Number of overlaps that make a diagram hard to read."""

    boxes: int
    labels: int
    labels_on_boxes: int
    labels_on_labels: int
    labels_off_their_lines: int
    lines_over_boxes: int
    lines_under_labels: int


def measure_legibility(page: Page) -> Legibility:
    """Measure the current diagram."""
    return Legibility(**page.evaluate(COUNT))


def forward_scenes() -> dict[str, dict[str, Any]]:
    """Scenes of the shipped designs, by component."""
    designs = shipped_designs()
    project = Project(name="forward", designs=tuple(designs))
    return {design.component: make_scene(project, design, (), 1) for design in designs}


def random_scenes(count: int) -> dict[str, dict[str, Any]]:
    """Scenes of random designs with 10 to 60 states and a computed layout."""
    scenes = {}
    with LayoutService() as service:
        for seed in range(count):
            design = random_design(seed)
            layout = service.compute(design, timeout_s=60.0)
            placed = apply_layout(design, layout.layout, None)
            scenes[design.component] = make_scene(Project(name="random", designs=(placed,)), placed, (), 1)
    return scenes


def random_design(seed: int) -> Design:
    """Transitions lead mostly to nearby states; some back, some to the same state, some are parallel."""
    chance = random.Random(seed)
    size = chance.randrange(10, 61)
    states = tuple(
        State(
            name=_name(index),
            transitions=tuple(_transition(index, size, chance) for _ in range(chance.choice((1, 2, 2, 3)))),
        )
        for index in range(size)
    )
    common = (
        CommonSection(transitions=(Transition(to=states[-1].name, guard=Guard(when="fallen")),))
        if seed % 2
        else CommonSection()
    )
    return replace(Design(component=f"Random{seed}x{size}", initial=_name(0), states=states), common=common)


def _transition(index: int, size: int, chance: random.Random) -> Transition:
    far = chance.random() < 0.15
    to = chance.randrange(size) if far else (index + chance.choice((0, 1, 1, 1, 2, 3, -1, -1))) % size
    guard = Guard(after="5") if chance.random() < 0.2 else Guard(when=chance.choice(GUARDS))
    return Transition(to=_name(to), guard=guard)


def _name(index: int) -> str:
    return f"{('Look', 'FollowBall', 'Kick', 'SearchTheNet')[index % 4]}{index}"
