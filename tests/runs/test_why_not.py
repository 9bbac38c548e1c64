"""Why a state is not active: compared with what the simulation does next, and with figures by hand."""

import random
from pathlib import Path
from typing import Any

import pytest

from tests.editor.simulation.lamp_project import simulate, write_lamps
from vicode.runs import PreparedRun, RunConfig, Simulation, prepare_run
from vicode.runs.guard_values import latest_steps
from vicode.runs.why_not import Condition, PastConditions, WhyNot, explain
from vicode.store import OpenProject, open_project

PROJECT = """
vicode: 1
project: Coffee
enumerations: {Drink: [tea, coffee]}
constants: {near: 0.5}
components:
  Button: {outputs: {order: bool, drink: {type: Drink}}}
  Eyes: {outputs: {distance: {type: float, initial: 3}, level: {type: int}}}
"""
COFFEE_BOT = """
vicode: 1
component: CoffeeBot
uses: {button: Button, eyes: Eyes}
initial: Idle
common: {transitions: [{to: Broken, when: eyes.level > 90}]}
states:
  Idle: {requires: [button, eyes], transitions: [{to: Drive, when: button.order and button.drink == Drink.coffee}]}
  Drive:
    requires: [button, eyes]
    transitions:
      - when: eyes.level > 50
        then: [{to: Idle, after: 1}]
        else:
          - {stay: true, when: not button.order}
          - {to: Pour, when: eyes.distance < near, after: 0.4}
  Pour: {requires: [button, eyes], transitions: [{to: Idle, when: eyes.level < 70}]}
  Broken: {}
  Lost: {transitions: [{to: Idle}]}
"""


@pytest.fixture
def coffee_bot(tmp_path: Path) -> Path:
    folder = tmp_path / "coffee"
    folder.mkdir()
    (folder / "project.yaml").write_text(PROJECT)
    (folder / "coffee_bot.yaml").write_text(COFFEE_BOT)
    return folder


def prepared(opened: OpenProject) -> PreparedRun:
    return prepare_run(opened.project, opened.project.designs[0], RunConfig(tick_ms=20), {}, opened.folder)


def ask(opened: OpenProject, simulation: Simulation, target: str, past: PastConditions | None = None) -> WhyNot:
    design, recording, number = simulation.prepared.design, simulation.recording, simulation.cursor
    latest = latest_steps(recording, number, frozenset(use.component for use in design.uses))
    return explain(opened.project, design, recording, number, target=target, latest=latest, past=past)


def test_what_fails_since_when_and_by_how_much(coffee_bot: Path) -> None:
    opened = open_project(coffee_bot)

    async def act(simulation: Simulation) -> None:
        await simulation.step(10)
        found = ask(opened, simulation, "Pour")
        (first,), (then,) = found.first, found.later
        assert (first.source, first.target) == ("Idle", "Drive")
        # Iterations 1 to 10 are 0.18 s apart.
        assert first.conditions == (
            Condition(text="button.order", holds=False, detail="button.order = false", false_for_s=0.18),
            Condition(text="button.drink == Drink.coffee", holds=False, detail="tea, must be coffee", false_for_s=0.18),
        )
        assert (then.source, then.target) == ("Drive", "Pour")
        assert [(each.text, each.holds) for each in then.conditions] == [
            ("not (eyes.level > 50)", True),
            ("after 0.4 s", None),
            ("eyes.distance < near", False),
        ]
        await simulation.set_input(("Button", "order"), True)
        await simulation.step(5)
        (first,) = ask(opened, simulation, "Drive").first
        assert [(each.holds, each.false_for_s) for each in first.conditions] == [(True, None), (False, 0.28)]
        await simulation.set_input(("Button", "drink"), "Drink.coffee")
        await simulation.set_input(("Eyes", "distance"), 0.8)
        await simulation.step(6)
        (first,) = ask(opened, simulation, "Pour").first
        assert first.conditions[1:] == (
            Condition(text="after 0.4 s", holds=False, detail="0.3 s to go"),
            Condition(text="eyes.distance < near", holds=False, detail="0.8, 0.3 too large", false_for_s=0.1),
        )
        brief = ask(opened, simulation, "Pour", PastConditions(lookback=3)).first[0].conditions[2]
        assert (brief.false_for_s, brief.was_false_before) == (0.06, True)
        assert first.earlier == ()
        await simulation.set_input(("Button", "order"), False)
        await simulation.step()
        assert ask(opened, simulation, "Pour").first[0].earlier == ("stay",)
        assert ask(opened, simulation, "Lost") == WhyNot(target="Lost")
        broken = ask(opened, simulation, "Broken").first
        assert [(each.source, each.conditions[0].detail) for each in broken] == [("Drive", "0, 90 too small")]

    simulate(prepared(opened), coffee_bot, act)


def test_what_holds_is_done_next(coffee_bot: Path) -> None:
    opened, chance = open_project(coffee_bot), random.Random(5)
    done: set[tuple[str, str]] = set()
    changes: list[tuple[tuple[str, str], Any]] = [
        *((("Button", "order"), each) for each in (True, True, False)),
        *((("Button", "drink"), each) for each in ("Drink.coffee", "Drink.coffee", "Drink.tea")),
        *((("Eyes", "distance"), each) for each in (0.1, 0.2, 0.6)),
        *((("Eyes", "level"), each) for each in (10, 60, 80)),
    ]

    async def act(simulation: Simulation) -> None:
        for _round in range(300):
            await simulation.set_input(*chance.choice(changes))
            await simulation.step(chance.choice([1, 1, 1, 40]))
            state = simulation.recording.states[-1]
            known = {name: ask(opened, simulation, name).first for name in ("Idle", "Drive", "Pour") if name != state}
            await simulation.step()
            after = simulation.recording.states[-1]
            for target, transitions in known.items():
                direct = [each for each in transitions if each.target == target]
                is_timed = any(each.text.startswith("after") for it in direct for each in it.conditions)
                is_open = any(not it.earlier and all(each.holds for each in it.conditions) for it in direct)
                if is_open:
                    assert after == target
                    done.add((state, target))
                elif not is_timed:
                    assert after != target

    simulate(prepared(opened), coffee_bot, act)
    assert done >= {("Idle", "Drive"), ("Pour", "Idle")}


def seconds_without_order(simulation: Simulation) -> float:
    """How long the recorded order has been false in the state Idle."""
    recording, number = simulation.recording, simulation.cursor
    first = number
    while first > 1:
        iteration = recording.iteration(first - 1)
        assert iteration is not None
        order = next((step for step in iteration.tree if step["component"] == "Button"), {"values": {}})
        if iteration.state != "Idle" or order["values"].get("order") is not False:
            break
        first -= 1
    return (recording.times_ns[number - 1] - recording.times_ns[first - 1]) / 1e9


def test_what_was_found_before_is_not_read_again(coffee_bot: Path) -> None:
    opened, chance, past = open_project(coffee_bot), random.Random(7), PastConditions()

    async def act(simulation: Simulation) -> None:
        compared = 0
        for _round in range(40):
            if chance.random() < 0.2:
                simulation.go_to(chance.randrange(max(1, simulation.cursor - 20), simulation.cursor + 1))
            await simulation.set_input(("Button", "order"), chance.random() < 0.3)
            await simulation.step(chance.choice([1, 2, 10]))
            if simulation.recording.states[-1] == "Idle":
                (first,) = ask(opened, simulation, "Drive", past).first
                if first.conditions[0].holds is False:
                    compared += 1
                    assert first.conditions[0].false_for_s == seconds_without_order(simulation)
        assert compared > 10
        await simulation.set_input(("Button", "order"), False)
        await simulation.step(400)
        ask(opened, simulation, "Drive", past)
        await simulation.step()
        read: list[int] = []
        plain = simulation.recording.iteration
        recording = simulation.recording
        recording.iteration = lambda number: (read.append(number), plain(number))[1]  # type: ignore[method-assign]
        ask(opened, simulation, "Drive", past)
        assert set(read) <= {simulation.cursor - 1, simulation.cursor}

    simulate(prepared(opened), coffee_bot, act)


def test_all_transitions_of_the_first_step_are_listed(tmp_path: Path) -> None:
    lamps = write_lamps(tmp_path / "lamps")
    opened = open_project(lamps)
    design = next(each for each in opened.project.designs if each.component == "Lamp")

    async def act(simulation: Simulation) -> None:
        await simulation.step(3)
        (first,) = (each for each in ask(opened, simulation, "Broken").first)
        assert first.source == "Dark"
        assert {each.key for each in ask(opened, simulation, "Lit").first} == {"Dark/0", "Dark/1"}

    run = prepare_run(opened.project, design, RunConfig(), {}, lamps)
    simulate(run, lamps, act)
