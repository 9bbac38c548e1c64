"""The reduced search finds what a complete one finds: deadlocks, robots that wait, steps, shortest runs."""

import random

import pytest

from tests.analysis.random_teams import FullProduct, draw_product
from vicode.analysis.products import Product
from vicode.analysis.team_search import TeamSearch, TooManyConfigurationsError

SIZES = range(3, 7)


def named(product: Product, at: tuple[int, ...]) -> tuple[tuple[str, int], ...]:
    """The robots of a configuration, with the numbers of the states in their machines."""
    offsets, following = {}, 0
    for machine in dict.fromkeys(product.robots):
        offsets.update({following + index: (machine.name, index) for index in range(len(machine.states))})
        following += len(machine.states)
    return tuple(sorted(offsets[state] for state in at))


@pytest.mark.parametrize("part", range(10))
def test_the_reduced_search_finds_what_the_full_one_finds(part: int) -> None:
    reduced = total = 0
    for seed in range(20 * part, 20 * part + 20):
        robots, places = draw_product(random.Random(seed), SIZES)
        full, search = FullProduct(robots, places), TeamSearch(Product(robots, places), 10_000)
        product = search.product
        deadlocks = {named(product, at) for at, edges in search.edges.items() if not edges}
        assert deadlocks == set(full.deadlocks()), seed
        waiting = list(search.find_waiting())
        found = {(named(product, (each.state,))[0][0], *each.source) for each in waiting}
        assert found == full.waiting(), seed
        for each in waiting:
            if named(product, each.robots) in deadlocks:
                assert len(each.run) == full.deadlocks()[named(product, each.robots)], seed
        steps = [product.steps[number] for number in search.find_taken()]
        machines = ["" if step.is_barrier else named(product, tuple(step.targets))[0][0] for step in steps]
        assert {(name, step.place) for name, step in zip(machines, steps, strict=True)} == full.taken(), seed
        reduced, total = reduced + len(search.edges), total + len(full.graph)
    assert reduced < total


def test_a_search_beyond_its_limit_is_ended() -> None:
    robots, places = draw_product(random.Random(1), SIZES)
    with pytest.raises(TooManyConfigurationsError):
        TeamSearch(Product(robots, places), 1)
