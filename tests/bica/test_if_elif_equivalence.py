"""The measured shape of generated code passes through the same states as an if/elif written for the same machine."""

from __future__ import annotations

import random

import pytest

from benchmarks.runtime import make_component, make_if_elif, make_world_reader
from benchmarks.sample_machines import make_machine
from benchmarks.senses import Senses
from vicode.bica import Root


@pytest.mark.parametrize("acts", [True, False])
@pytest.mark.parametrize(("states", "edges"), [(2, 1), (3, 3), (6, 2), (40, 3)])
def test_all_pass_through_the_same_states(states: int, edges: int, acts: bool) -> None:
    machine = make_machine(states, edges, acts=acts)
    senses = Root(Senses).component(Senses)
    step_one, find_one = make_component(machine, senses)
    others = [make(machine, senses) for make in (make_if_elif, make_world_reader)]
    chance = random.Random(states)
    visited = set()
    for _ in range(1500):
        senses.a, senses.b, senses.c = chance.random(), chance.random(), chance.random()
        step_one()
        for step_other, find_other in others:
            step_other()
            assert find_other() == find_one()
        visited.add(find_one())
    assert len(visited) > states // 2
