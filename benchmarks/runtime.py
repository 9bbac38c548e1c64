"""Time of one iteration: the generated component, a hand-written if/elif, and the libraries users would take.

Run it with `python -m benchmarks.runtime`. All get the same inputs and must pass through the same states.
Times are of the processor, so that other programs on the machine disturb them less.
"""

from __future__ import annotations

import argparse
import random
import statistics
import time
from collections.abc import Callable, Sequence

from benchmarks.libraries import Candidate, find_libraries
from benchmarks.sample_machines import Machine, TickClock, load_component, load_source, make_machine, write_if_elif
from benchmarks.senses import Senses
from vicode.bica import Component, Root

Inputs = Sequence[tuple[float, float, float]]
HAND_WRITTEN = "hand-written if/elif"
BUDGET_S = 0.15


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=7, help="the median of so many is shown (7)")
    parser.add_argument("--ticks", type=int, default=20_000, help="iterations a round; less for the slow (20000)")
    options = parser.parse_args()
    chance = random.Random(1)
    inputs = [(chance.random(), chance.random(), chance.random()) for _ in range(options.ticks)]
    libraries = find_libraries()
    cases = [
        ("6 states, 12 transitions", make_machine(6, 2, acts=True), libraries),
        ("200 states x 3", make_machine(200, 3, acts=True), libraries),
        ("6 states, 12 transitions, states do nothing", make_machine(6, 2, acts=False), {}),
        ("200 states x 3, states do nothing", make_machine(200, 3, acts=False), {}),
    ]
    for title, machine, rivals in cases:
        makers = {
            HAND_WRITTEN: make_if_elif,
            "generated component": make_component,
            "  reading the world": make_world_reader,
            **rivals,
        }
        print_case(title, measure_all(machine, makers, inputs, options.rounds))
    print("SMACH is not on the package index and not measured here.")


def make_component(machine: Machine, senses: Senses) -> Candidate:
    root = Root(load_component(machine), clock=TickClock())
    component: Component = root.main
    # The component reads the very object that all others read.
    component.senses = senses  # type: ignore[attr-defined]
    return root.step, lambda: component.state


def make_world_reader(machine: Machine, senses: Senses) -> Candidate:
    component_class = load_component(machine, "world")
    root = Root(component_class, clock=TickClock(), world=senses)
    return root.step, lambda: root.main.state


def make_if_elif(machine: Machine, senses: Senses) -> Candidate:
    measured = load_source(write_if_elif(machine)).Measured(senses, TickClock())
    return measured.step, lambda: measured.state


def measure_all(
    machine: Machine, makers: dict[str, Callable[[Machine, Senses], Candidate]], inputs: Inputs, rounds: int
) -> dict[str, tuple[float, float]]:
    """Return the median time of an iteration in ns and the median ratio to the hand-written one, by name."""
    senses = Root(Senses).component(Senses)
    contestants = {name: make(machine, senses) for name, make in makers.items()}
    inputs_of = choose_inputs(contestants, senses, inputs)
    times: dict[str, list[float]] = {name: [] for name in contestants}
    for _ in range(rounds):
        loop_ns = measure(lambda: None, senses, inputs) - measure_call()
        for name, (step, _find_state) in contestants.items():
            times[name].append(measure(step, senses, inputs_of[name]) - loop_ns)
    return {
        name: (
            statistics.median(own),
            statistics.median(ours / hand for ours, hand in zip(own, times[HAND_WRITTEN], strict=True)),
        )
        for name, own in times.items()
    }


def choose_inputs(contestants: dict[str, Candidate], senses: Senses, inputs: Inputs) -> dict[str, Inputs]:
    """Check that all pass through the same states, and give the slow ones a shorter run."""
    expected: list[str] = []
    chosen: dict[str, Inputs] = {}
    for name, (step, find_state) in contestants.items():
        begin, states = time.process_time(), []
        for senses.a, senses.b, senses.c in inputs:
            step()
            states.append(find_state())
            if len(states) >= 500 and time.process_time() - begin > 5 * BUDGET_S:
                break
        expected = expected or states
        assert states == expected[: len(states)], f"{name} passes through other states"
        spent_s = (time.process_time() - begin) / len(states)
        chosen[name] = inputs[: max(500, round(BUDGET_S / spent_s))]
    assert len(set(expected)) > 1
    return chosen


def measure(step: Callable[[], None], senses: Senses, inputs: Inputs) -> float:
    begin_ns = time.process_time_ns()
    for senses.a, senses.b, senses.c in inputs:
        step()
    return (time.process_time_ns() - begin_ns) / len(inputs)


def measure_call(count: int = 20_000) -> float:
    """Return the time of one call of an empty function, which `measure` counts into its loop."""

    def nothing() -> None:
        pass

    def loop(calls: int) -> int:
        begin_ns = time.process_time_ns()
        for _ in range(calls):
            nothing()
        return time.process_time_ns() - begin_ns

    def loop_alone(calls: int) -> int:
        begin_ns = time.process_time_ns()
        for _ in range(calls):
            pass
        return time.process_time_ns() - begin_ns

    return (loop(count) - loop_alone(count)) / count


def print_case(title: str, rows: dict[str, tuple[float, float]]) -> None:
    print(f"{title}\n  {'':22}{'ns':>10}{'x if/elif':>12}")
    for name, (time_ns, ratio) in rows.items():
        print(f"  {name:22}{time_ns:10.0f}{ratio:12.2f}")
    print()


if __name__ == "__main__":
    main()
