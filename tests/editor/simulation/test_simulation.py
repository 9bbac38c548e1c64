"""Steps of a simulation, its past, and its guards."""

import asyncio
import os
import time
from pathlib import Path

import pytest

from tests.editor.simulation.lamp_project import prepare_lamp, recorded_iterations, simulate, write_lamps
from vicode.runs import RunStatus, Simulation
from vicode.runs.process import ProcessTransport
from vicode.simulation import StopConditions

SEEN = ("Eye", "seen")


@pytest.fixture
def lamps(tmp_path: Path) -> Path:
    return write_lamps(tmp_path / "lamps")


def test_an_input_changes_the_state(lamps: Path) -> None:
    async def act(simulation: Simulation) -> None:
        assert await simulation.step() == "count"
        assert simulation.shown_iteration is not None
        assert simulation.shown_iteration.state == "Dark"
        assert await simulation.set_input(SEEN, True)
        assert simulation.guards["Dark/0"] == {
            "holds": True,
            "parts": [True],
            "reads": {"eye.seen": True, "eye.light": 0.0},
        }
        assert simulation.guards["Dark/1"]["parts"] == [False, True]
        await simulation.step()
        moment = simulation.shown_iteration
        assert (moment.state, moment.changed_from, moment.transition) == ("Lit", "Dark", "Dark/0")
        assert moment.prints == ["lit 1"]
        assert [(call["output"], call["arguments"]) for call in moment.calls] == [("toward", {"x": 2.0})]
        assert [step["component"] for step in moment.tree] == ["Lamp", "Eye", "Bulb", "Timer"]
        assert moment.tree[2]["parameters"] == {"power": 3.0}

    simulate(prepare_lamp(lamps), lamps, act)


def test_evaluating_guards_runs_no_user_code(lamps: Path) -> None:
    async def act(simulation: Simulation) -> None:
        await simulation.set_input(SEEN, True)
        await simulation.step(2)
        assert simulation.guards["Lit/0"]["holds"] is False
        assert simulation.guards["Lit/0"]["parts"] == [False, None]
        await simulation.set_input(SEEN, False)
        assert simulation.guards["Lit/0"]["holds"] is None
        await simulation.step()
        assert simulation.guards["Lit/0"]["parts"] == [True, False]
        assert simulation.shown_iteration is not None
        assert simulation.shown_iteration.tree[0]["values"]["asked"] == 1
        await simulation.set_input(SEEN, True)
        await simulation.step()
        assert simulation.guards["Lit/0"]["parts"] == [False, None]

    simulate(prepare_lamp(lamps), lamps, act)


def test_evaluating_guards_calls_no_functions_of_running_components(lamps: Path) -> None:
    async def act(simulation: Simulation) -> None:
        await simulation.step(30)
        assert simulation.shown_iteration is not None
        assert simulation.shown_iteration.state == "Lit"
        assert simulation.guards["Lit/2"]["reads"] == {"eye.toward(x=2.0)": 4.0}
        # The design called the function once to test its guard; evaluating guards did not.
        assert simulation.shown_iteration.prints == ["asked"]

    simulate(prepare_lamp(lamps, stubbed=frozenset({"Bulb"})), lamps, act)


@pytest.mark.parametrize("back", [1, 7, 24])
def test_stepping_back_and_forward_gives_the_same_past(lamps: Path, back: int) -> None:
    async def act(simulation: Simulation) -> None:
        changes = {3: True, 9: False, 14: True}
        for number in range(1, 25):
            if number in changes:
                await simulation.set_input(SEEN, changes[number])
            await simulation.step()
        before = recorded_iterations(simulation)
        simulation.step_back(back)
        assert simulation.is_past
        assert simulation.shown_iteration == (before[23 - back] if back < 24 else None)
        for number in range(25 - back, 25):
            if number in changes:
                await simulation.set_input(SEEN, changes[number])
            await simulation.step()
        assert recorded_iterations(simulation) == before
        # Again in a new process, which replays the inputs up to here.
        simulation.step_back(back)
        simulation.truncate()
        assert len(simulation.recording) == 24 - back
        for number in range(25 - back, 25):
            if number in changes:
                await simulation.set_input(SEEN, changes[number])
            await simulation.step()
        assert recorded_iterations(simulation) == before
        assert simulation.warning == ""

    simulate(prepare_lamp(lamps), lamps, act)


def test_an_input_in_the_past_discards_later_iterations(lamps: Path) -> None:
    async def act(simulation: Simulation) -> None:
        await simulation.step(10)
        before = recorded_iterations(simulation)
        simulation.go_to(4)
        await simulation.set_input(SEEN, True)
        assert len(simulation.recording) == 4
        await simulation.step()
        assert recorded_iterations(simulation)[:4] == before[:4]
        assert simulation.shown_iteration is not None
        assert simulation.shown_iteration.state == "Lit"
        assert simulation.inputs["Eye"]["seen"] is True
        simulation.step_back()
        assert simulation.inputs["Eye"]["seen"] is False

    simulate(prepare_lamp(lamps), lamps, act)


def test_runs_stop_at_breakpoints_also_in_the_past(lamps: Path) -> None:
    async def act(simulation: Simulation) -> None:
        await simulation.set_input(SEEN, True)
        await simulation.set_input(("Eye", "light"), 50)
        stops = StopConditions(transitions=("Dark/1",))
        assert await simulation.step(100, stops) == "transition"
        assert simulation.cursor == 6
        assert await simulation.step(3) == "count"
        simulation.go_to(0)
        assert await simulation.step(100, StopConditions(states=("Lit",))) == "state"
        assert simulation.cursor == 6
        simulation.go_to(0)
        assert await simulation.step(100, StopConditions(changes=True)) == "change"

    simulate(prepare_lamp(lamps), lamps, act)


def test_a_final_state_stops_the_run_once(lamps: Path) -> None:
    async def act(simulation: Simulation) -> None:
        await simulation.set_input(("Eye", "mood"), "Mood.angry")
        assert await simulation.step(10) == "done"
        assert simulation.cursor == 1
        assert await simulation.step(3) == "count"

    simulate(prepare_lamp(lamps), lamps, act)


def test_parameters_and_stubbed_designs_can_be_set(lamps: Path) -> None:
    async def act(simulation: Simulation) -> None:
        await simulation.set_input(SEEN, True)
        await simulation.set_input(("", "patience"), 1.5)
        await simulation.step(2)
        assert simulation.shown_iteration is not None
        assert simulation.shown_iteration.tree[0]["values"]["patience"] == 1.5
        await simulation.set_input(("Timer", "is_done"), True)
        # The state calls the timer after the decision, so its value is read in the next iteration.
        await simulation.step(2)
        assert simulation.shown_iteration.transition == "Lit/1"

    simulate(prepare_lamp(lamps, stubbed=frozenset({"Eye", "Bulb", "Timer"})), lamps, act)


def test_a_function_has_values_for_some_arguments(lamps: Path) -> None:
    async def act(simulation: Simulation) -> None:
        await simulation.set_input(SEEN, True)
        await simulation.step(2)
        assert simulation.shown_iteration is not None
        assert simulation.shown_iteration.calls == [
            {"component": "Eye", "output": "toward", "arguments": {"x": 2.0}, "value": 0.0}
        ]
        assert not await simulation.set_input(("Eye", "toward"), {"value": 1, "table": [[{"x": 2.0}, "much"]]})
        assert await simulation.set_input(("Eye", "toward"), {"value": 1, "table": [[{"x": 2.0}, 70]]})
        assert simulation.guards["Lit/2"]["reads"] == {"eye.toward(x=2.0)": 70.0}
        await simulation.step()
        assert simulation.shown_iteration.state == "Broken"

    simulate(prepare_lamp(lamps), lamps, act)


def test_invalid_values_are_rejected(lamps: Path) -> None:
    async def act(simulation: Simulation) -> None:
        for key, value in [
            (SEEN, "yes"),
            (("Eye", "light"), float("nan")),
            (("Eye", "light"), "12"),
            (("Eye", "mood"), "Mood.glad"),
            (("Eye", "nothing"), 1),
            (("Nobody", "seen"), True),
        ]:
            assert not await simulation.set_input(key, value)

    simulate(prepare_lamp(lamps), lamps, act)


def test_the_process_ends_with_the_simulation(lamps: Path) -> None:
    async def act(simulation: Simulation) -> None:
        await simulation.start()
        client = simulation._client
        assert client is not None
        assert isinstance(client.transport, ProcessTransport)
        folder, pid = client.transport.folder, client.transport.process.pid
        assert folder.is_dir()
        simulation.end()
        assert simulation.status is RunStatus.ENDED
        assert not folder.exists()
        await simulation.wait_closed()
        with pytest.raises(ProcessLookupError):
            os.kill(pid, 0)
        assert not (lamps / "__pycache__").exists()

    simulate(prepare_lamp(lamps), lamps, act)


def test_pausing_ends_a_long_run_early(lamps: Path) -> None:
    async def act(simulation: Simulation) -> None:
        await simulation.start()
        running = asyncio.create_task(simulation.step(20_000))
        end = time.monotonic() + 30
        while len(simulation.recording) < 30 and time.monotonic() < end:
            await asyncio.sleep(0.01)
        simulation.pause()
        assert await running == "pause"
        assert 30 <= len(simulation.recording) < 20_000

    simulate(prepare_lamp(lamps), lamps, act)
