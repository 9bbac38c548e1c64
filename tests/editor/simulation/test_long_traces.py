"""A trace in the project folder is viewed without loading it."""

import json
from dataclasses import asdict
from pathlib import Path

import pytest

from tests.editor.simulation.lamp_project import prepare_lamp, recorded_iterations, simulate, write_lamps
from tests.editor.simulation.plots import draw_plot
from vicode.bica.observer import TRACE_HEADER
from vicode.editor.view.plot import WIDTH, state_runs
from vicode.runs import Simulation
from vicode.runs.design_trace import read_iterations
from vicode.runs.trace_recording import find_traces, read_beginning, read_recording
from vicode.traces.reader import TraceError


@pytest.fixture
def lamps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return write_lamps(tmp_path / "lamps")


def record(folder: Path) -> Path:
    lines: list[str] = [json.dumps(TRACE_HEADER)]

    async def run(simulation: Simulation) -> None:
        await simulation.step(4)
        await simulation.set_input(("Eye", "mood"), "Mood.angry")
        await simulation.step(1)
        await simulation.step(5)
        lines.extend(json.dumps(asdict(each)) for each in recorded_iterations(simulation))

    simulate(prepare_lamp(folder), folder, run)
    path = folder / "runs" / "a.jsonl"
    path.parent.mkdir()
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_a_long_trace_looks_like_a_short_one(lamps: Path) -> None:
    path = record(lamps)
    stage = prepare_lamp(lamps)
    whole = Simulation(prepared=stage, cwd=lamps, replay=read_iterations(path.read_text(), stage.design))
    view = Simulation(prepared=stage, cwd=lamps, replay=read_recording(path, stage.design))
    assert view.is_view
    assert not view.can_step or view.is_past
    assert [view.recording.iteration(number) for number in range(12)] == [
        whole.recording.iteration(number) for number in range(12)
    ]
    assert (view.recording.states, view.recording.transitions) == (whole.recording.states, whole.recording.transitions)
    assert any(view.recording.transitions)
    name = "Eye.light"
    assert [*view.recording.column(name)] == pytest.approx([*whole.recording.column(name)], nan_ok=True)
    assert read_beginning(path, stage.design)[3].iteration == 4


def test_a_time_leads_to_the_iteration_of_that_time(lamps: Path) -> None:
    path = record(lamps)
    lines = path.read_text().splitlines()
    # A robot has no even period.
    moved = [{**json.loads(line), "time_ns": number * 22_173_913} for number, line in enumerate(lines[1:])]
    path.write_text("\n".join([lines[0], *map(json.dumps, moved)]) + "\n")
    recording = read_recording(path, prepare_lamp(lamps).design)
    assert recording.number_at(0) == 1
    assert recording.number_at(8 * 22_173_913) == 9
    assert recording.number_at(8 * 22_173_913 + 1) == 10
    assert recording.number_at(10**12) is None


def test_traces_of_the_folder_are_listed_and_records_by_their_name(lamps: Path) -> None:
    for name in ("old.trace", "runs/run.1.000001.jsonl", "runs/run.2.000014.jsonl", ".git/no.jsonl"):
        (lamps / name).parent.mkdir(exist_ok=True)
        (lamps / name).write_text("")
    assert sorted(find_traces(lamps)) == ["old.trace", "runs/run.jsonl"]


def test_a_trace_of_another_design_is_refused(lamps: Path) -> None:
    path = record(lamps)
    path.write_text(path.read_text().replace('"Lamp"', '"Torch"'))
    with pytest.raises(TraceError, match="this is a trace of Torch, not of Lamp"):
        read_recording(path, prepare_lamp(lamps).design)


def test_the_states_of_a_long_run_are_drawn_at_most_once_per_pixel() -> None:
    states = [f"S{(number // 3) % 5}" for number in range(100_000)]
    assert len(state_runs(states)) > 10 * WIDTH
    assert draw_plot([], states, 7).count("<rect") < 1.1 * WIDTH
