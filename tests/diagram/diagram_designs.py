"""Designs for layout tests, and the check that nothing overlaps."""

import random
from collections.abc import Collection
from itertools import combinations
from pathlib import Path

from vicode.diagram.layered_layout import NodeLayout
from vicode.diagram.node_geometry import COMMON_SIZE, Size, state_size, use_size
from vicode.model.design import Design, Guard, Point, State, Transition
from vicode.store import open_project

DESIGNS = Path(__file__).parents[2] / "designs"
HOSTILE_NAMES = (
    'say "hi"', "back\\slash", "ends in \\", "<b>bold</b>", "<", "two\nlines", "\\n", "a:b:c", "node", "graph", "", " ",
    "tab\there", "nul\0here", "\ud800", "é ü 😀", "状态机", "x" * 500, "s0", "common", "@common", "];}", "-->",
    "&lt;&amp;", "%s {0}", "\x07\x1b[0m", "\u2028",
)  # fmt: skip


def shipped_designs() -> list[Design]:
    return [design for folder in ("blink", "forward") for design in open_project(DESIGNS / folder).project.designs]


def ring_design(size: int, chords: int = 1) -> Design:
    """States in a ring, each with additional transitions."""
    chance = random.Random(size)
    states = [
        State(
            name=f"State{index}",
            transitions=tuple(
                Transition(to=f"State{to}", guard=Guard(when="tries > 3"))
                for to in ((index + 1) % size, *(chance.randrange(size) for _ in range(chords)))
            ),
        )
        for index in range(size)
    ]
    return Design(component="Ring", initial="State0", states=tuple(states))


def list_boxes(design: Design, placement: NodeLayout) -> dict[str, tuple[Point, Size]]:
    """Every drawn box, with a name for messages."""
    boxes = {f"state {name}": (at, state_size(name)) for name, at in placement.states.items()}
    boxes |= {
        f"use {use.alias}": (placement.uses[use.alias], use_size(use.alias, use.component)) for use in design.uses
    }
    if design.common.transitions or design.common.actions:
        boxes["common"] = placement.common, COMMON_SIZE
    return boxes


def find_overlaps(boxes: dict[str, tuple[Point, Size]], apart_from: Collection[str] = ()) -> list[tuple[str, str]]:
    """Pairs of overlapping boxes, except those with both names in `apart_from`."""
    return [
        (one, other)
        for (one, (at, size)), (other, (place, extent)) in combinations(boxes.items(), 2)
        if not (one in apart_from and other in apart_from)
        and abs(at[0] - place[0]) < (size.width + extent.width) / 2
        and abs(at[1] - place[1]) < (size.height + extent.height) / 2
    ]
