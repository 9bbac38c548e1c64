"""One task in four styles: how many iterations pass from an event to the command that answers it."""

import pytest
from styles.by_competence import ByCompetence
from styles.by_interrupts import ByInterrupts
from styles.by_layers import ByLayers
from styles.by_states import ByStates
from yard.yard import Yard

from vicode.bica import Component, Root, SimulatedClock

STYLES: dict[type[Component], dict[str, int]] = {
    ByStates: {"bump": 0, "battery": 0, "obstacle": 0},
    ByInterrupts: {"bump": 0, "battery": 0, "obstacle": 0},
    # A latch changes after the decision.
    ByCompetence: {"bump": 0, "battery": 1, "obstacle": 0},
    ByLayers: {"bump": 0, "battery": 1, "obstacle": 0},
}


def react(style: type[Component], seed: int, seconds: int = 600) -> dict[str, list[int]]:
    yard, clock = Yard(seed), SimulatedClock()
    root = Root(style, world=yard, clock=clock)
    for _iteration in range(seconds * 50):
        yard.advance(clock.now_ns())
        root.step()
        clock.advance(20_000_000)
    return yard.reactions


@pytest.mark.parametrize("style", STYLES, ids=lambda style: style.__name__)
def test_no_reaction_is_later_than_its_style_says(style: type[Component]) -> None:
    for seed in range(3):
        reactions = react(style, seed)
        assert all(len(found) > 5 for found in reactions.values())
        assert {name: max(found) for name, found in reactions.items()} == STYLES[style]
