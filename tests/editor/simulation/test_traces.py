"""A recorded trace is viewed, or provides the inputs."""

import json
from dataclasses import asdict
from itertools import pairwise
from pathlib import Path

import pytest

from tests.editor.simulation.lamp_project import prepare_lamp, recorded_iterations, simulate, write_lamps
from vicode.bica.observer import TRACE_HEADER
from vicode.editor.session.simulation.trace_overlays import measure_heat
from vicode.model.design import Design
from vicode.runs import Recording, RunConfig, Simulation, prepare_run
from vicode.runs.design_trace import input_script, read_iterations
from vicode.runs.guard_values import evaluate_guards, latest_steps
from vicode.simulation import IterationResult
from vicode.store import open_project
from vicode.traces.reader import TraceError


@pytest.fixture
def lamps(tmp_path: Path) -> Path:
    return write_lamps(tmp_path / "lamps")


def lamp_of(folder: Path) -> Design:
    design = open_project(folder).project.design("Lamp")
    assert design is not None
    return design


def trace_of(simulation: Simulation) -> str:
    lines = [json.dumps(TRACE_HEADER), *(json.dumps(asdict(moment)) for moment in recorded_iterations(simulation))]
    return "\n".join(lines)


def test_a_trace_drives_the_inputs_to_the_same_states(lamps: Path) -> None:
    traces: list[str] = []

    async def record(simulation: Simulation) -> None:
        await simulation.step(4)
        await simulation.set_input(("Eye", "seen"), True)
        await simulation.step(6)
        await simulation.set_input(("Eye", "mood"), "Mood.angry")
        await simulation.step(3)
        traces.extend([trace_of(simulation), repr(simulation.recording.states)])

    stage = prepare_lamp(lamps)
    simulate(stage, lamps, record)
    moments = read_iterations(traces[0], lamp_of(lamps))
    assert [moment.state for moment in moments][-1] == "Broken"

    async def drive(simulation: Simulation) -> None:
        simulation.script = input_script(moments, stage.inputs)
        await simulation.step(13)
        assert repr(simulation.recording.states) == traces[1]
        assert simulation.inputs["Eye"]["mood"] == "Mood.angry"
        simulation.go_to(2)
        assert simulation.inputs["Eye"]["seen"] is False

    simulate(stage, lamps, drive)


def test_viewing_a_trace_needs_no_process(lamps: Path) -> None:
    step = {"component": "Lamp", "state": "Lit", "changed_from": "Dark", "transition": None, "by": None}
    first = {"component": "Lamp", "state": "Dark", "changed_from": None, "by": None}
    steps = enumerate([first, first, {**step, "changed_from": "Broken", "state": "Dark"}], start=1)
    lines = [{"iteration": number, "time_ns": number, "tree": [each]} for number, each in steps]
    text = "\n".join(json.dumps(line) for line in (TRACE_HEADER, *lines))
    moments = read_iterations(text, lamp_of(lamps))
    assert moments[2].transition is None

    async def act(simulation: Simulation) -> None:
        looked = Simulation(prepared=simulation.prepared, cwd=lamps, replay=moments)
        assert await looked.step(2) == "count"
        assert (looked.cursor, looked.can_step) == (2, True)
        assert await looked.step(5) == "end"
        assert not looked.can_step
        assert not await looked.set_input(("Eye", "seen"), True)
        assert looked._client is None

    simulate(prepare_lamp(lamps), lamps, act)


def test_a_trace_of_another_component_is_rejected(lamps: Path) -> None:
    record = {"iteration": 1, "time_ns": 0, "tree": [{"component": "Timer", "state": "Over"}]}
    with pytest.raises(TraceError, match="a trace of Timer, not of Lamp"):
        read_iterations(f"{json.dumps(TRACE_HEADER)}\n{json.dumps(record)}", lamp_of(lamps))


def test_guards_of_a_trace_are_evaluated_as_in_the_run(lamps: Path) -> None:
    recordings: list[Recording] = []

    async def record(simulation: Simulation) -> None:
        await simulation.step(4)
        await simulation.set_input(("Eye", "seen"), True)
        await simulation.step(6)
        recordings.append(simulation.recording)

    simulate(prepare_lamp(lamps), lamps, record)
    (recording,) = recordings
    project, lamp = open_project(lamps).project, lamp_of(lamps)
    for number in range(1, len(recording) + 1):
        iteration = recording.iteration(number)
        assert iteration is not None
        steps = latest_steps(recording, number, frozenset({"Eye", "Timer"}))
        found = evaluate_guards(project, lamp, iteration, steps)
        assert found.keys() == iteration.guards.keys()
        for key, guard in found.items():
            # Code and functions are not called.
            known = [
                (a, b) for a, b in zip(guard["parts"], iteration.guards[key]["parts"], strict=True) if a is not None
            ]
            assert all(a == b for a, b in known), (key, guard, iteration.guards[key])
        if iteration.state == "Dark":
            assert [found[key]["holds"] for key in ("Dark/0", "Dark/1")] != [None, None]
    assert {"Dark", "Lit"} <= set(recording.states)


def test_guards_read_what_the_world_provided(tmp_path: Path) -> None:
    (tmp_path / "project.yaml").write_text(
        "vicode: 1\nproject: Walk\ncomponents: {Floor: {implementation: world, outputs: {slope: float}}}\n", "utf-8"
    )
    (tmp_path / "walker.yaml").write_text(
        "vicode: 1\ncomponent: Walker\nuses: {floor: Floor}\ninitial: Walk\n"
        "states: {Walk: {transitions: [{to: Rest, when: floor.slope > 4}]}, Rest: {}}\n",
        "utf-8",
    )
    project = open_project(tmp_path).project
    step = {"component": "Walker", "state": "Walk", "state_time_ns": 0, "values": {}}
    iteration = IterationResult(iteration=1, time_ns=0, tree=[step], inputs={"Floor": {"slope": 5.0}})
    found = evaluate_guards(project, project.designs[0], iteration, {"Walker": step})
    assert found == {"Walk/0": {"holds": True, "parts": [True], "reads": {"floor.slope": 5.0}}}


BOSS = """
vicode: 1
component: Boss
uses: {task: Task}
initial: Order
states:
  Order:
    modulates: {task: {}}
    transitions:
      - {to: Rest, when: action_done and done(task)}
      - {to: Alone, when: conflict or state_time > 9 or team_size > 1}
  Rest:
    transitions:
      - {to: Order, when: not done(task) and not action_done, after: 0.05}
      - {to: Alone, when: conflict}
  Alone: {capacity: 1}
"""
TASK = """
vicode: 1
component: Task
initial: Busy
states:
  Busy: {transitions: [{to: Over, after: 0.03}]}
  Over: {final: true}
"""


def test_done_action_done_conflict_and_the_size_of_the_team_are_known_in_a_trace(tmp_path: Path) -> None:
    (tmp_path / "project.yaml").write_text("vicode: 1\nproject: Office\n", encoding="utf-8")
    for name, text in (("boss.yaml", BOSS), ("task.yaml", TASK)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    project = open_project(tmp_path).project
    boss = project.design("Boss")
    assert boss is not None
    prepared = prepare_run(project, boss, RunConfig(), {}, tmp_path)
    texts: list[str] = []

    async def record(simulation: Simulation) -> None:
        await simulation.step(12)
        texts.append(trace_of(simulation))

    simulate(prepared, tmp_path, record)
    seen: set[tuple[str, bool]] = set()
    for iteration in read_iterations(texts[0], boss):
        found = evaluate_guards(project, boss, iteration, {"Task": iteration.tree[-1]})
        assert {key: each["parts"] for key, each in found.items()} == {
            key: each["parts"] for key, each in iteration.guards.items()
        }
        seen.add((iteration.state, found[f"{iteration.state}/0"]["reads"]["done(task)"]))
    assert seen == {("Order", False), ("Order", True), ("Rest", False), ("Rest", True)}


def test_a_heat_map_counts_states_and_transitions(lamps: Path) -> None:
    states = ["Dark", "Lit", "Lit", "Lit", "Dark", "Lit"]
    lines = [
        {"iteration": number, "time_ns": number * 10**9, "tree": [{"component": "Lamp", "by": None, **step}]}
        for number, step in enumerate(
            ({"state": now, "changed_from": left if left != now else None} for left, now in pairwise([None, *states])),
            start=1,
        )
    ]
    text = "\n".join(json.dumps(line) for line in (TRACE_HEADER, *lines))
    recording = Recording()
    for iteration in read_iterations(text, lamp_of(lamps)):
        recording.add(iteration, {})
    heat = measure_heat(recording, lamp_of(lamps))
    state = {item.id: (heat.colors[item], heat.words[item]) for item in heat.words if item.kind == "states"}
    assert state["Lit"] == ("red", "entered 2 times, 3.00 s (60%), longest 3.00 s")
    assert state["Dark"] == ("orange", "entered 2 times, 2.00 s (40%), longest 1.00 s")
    assert state["Broken"] == ("never", "never entered")
    taken = {item.id: heat.words[item] for item in heat.words if item.kind == "transitions"}
    # Both lead from Dark to Lit and have no ids.
    assert taken["Dark/0"] == taken["Dark/1"] == "taken 2 times"
    assert taken["Lit/0"] == "taken 1 time"
    assert taken["@common/0"] == "never taken"
