"""Recorded iterations and their plots."""

import math
from xml.etree import ElementTree as ET

import pytest

from tests.editor.simulation.plots import draw_plot
from vicode.editor.view.activation import activation_rows
from vicode.editor.view.plot import PlotSeries, band_labels, state_runs
from vicode.runs import Recording
from vicode.simulation import IterationResult


def moment(number: int, state: str, **values: object) -> IterationResult:
    transition = f"{state}/0" if number > 1 and state == "Lit" else None
    tree = [{"component": "Lamp", "by": None, "state": state, "transition": transition, "values": values}]
    return IterationResult(iteration=number, time_ns=(number - 1) * 20, tree=tree)


def recorded(*states: str) -> Recording:
    recording = Recording()
    for number, state in enumerate(states, start=1):
        changes = {"Eye": {"light": number}} if number % 2 else {}
        recording.add(moment(number, state, turns=number, lit=state == "Lit", word="x"), changes)
    return recording


def test_inputs_are_plotted() -> None:
    recording = Recording()
    for number, slope in enumerate((1.0, 2.0), start=1):
        tree = [{"component": "Lamp", "by": None, "state": "Dark", "transition": None}]
        recording.add(IterationResult(iteration=number, time_ns=0, tree=tree, inputs={"Floor": {"slope": slope}}), {})
    assert recording.names == ("Floor.slope",)
    assert list(recording.column("Floor.slope")) == [1.0, 2.0]


def test_iterations_are_stored_completely() -> None:
    recording = recorded("Dark", "Lit", "Lit")
    assert recording.iteration(2) == moment(2, "Lit", turns=2, lit=True, word="x")
    assert recording.iteration(0) is recording.iteration(4) is None
    assert recording.states == ["Dark", "Lit", "Lit"]
    assert recording.latest_transition(3) == "Lit/0"
    assert recording.latest_transition(1) == ""
    recording.add(moment(4, "Off"), {})
    assert recording.latest_transition(4) == "", "the change to Off is newer, its transition is not known"


def test_the_past_is_split_into_segments_between_inputs() -> None:
    recording = recorded("Dark", "Dark", "Lit", "Lit")
    assert list(recording.input_segments(4)) == [({"Eye": {"light": 1}}, 2), ({"Eye": {"light": 3}}, 2)]
    assert list(recording.input_segments(3)) == [({"Eye": {"light": 1}}, 2), ({"Eye": {"light": 3}}, 1)]
    assert list(recording.input_segments(0)) == []
    assert recording.inputs_at(2) == {"Eye": {"light": 1}}


def test_later_iterations_can_be_truncated() -> None:
    recording = recorded("Dark", "Dark", "Lit", "Lit")
    recording.truncate(2)
    assert len(recording) == 2
    assert list(recording.column("Lamp.turns")) == [1, 2]
    assert recording.inputs_at(9) == {"Eye": {"light": 1}}
    recording.add(moment(3, "Off", late=1.5), {})
    assert [value for value in recording.column("Lamp.late") if math.isfinite(value)] == [1.5]
    assert len(recording.column("Lamp.turns")) == 3
    assert recording.names == ("Lamp.turns", "Lamp.lit", "Lamp.late")


def test_a_plot_is_valid_xml_for_any_name() -> None:
    states = ["Dark", "<b>&\"'", "Dark"]
    drawing = draw_plot([PlotSeries(name="</svg>", values=[1.0, math.nan, 3.0])], states, 2)
    root = ET.fromstring(drawing)
    titles = [element.text for element in root.iter("title")]
    assert titles == ["Dark", "<b>&\"'", "Dark"]


def test_a_long_plot_is_downsampled_and_keeps_its_peaks() -> None:
    values = [0.0] * 20_000
    values[12_345] = 1.0
    drawing = draw_plot([PlotSeries(name="x", values=values)], ["Dark"] * 20_000, 20_000)
    assert len(drawing) < 20_000
    assert "18.0H" in drawing


def test_states_are_drawn_as_spans() -> None:
    assert state_runs(["A", "A", "B", "A"]) == [("A", 0, 2), ("B", 2, 3), ("A", 3, 4)]
    assert band_labels(["A"] * 99 + ["B"]) == [("A", 0.0, 99.0)]
    assert draw_plot([], [], 0).startswith("<svg")


def test_the_activation_tree_is_indented() -> None:
    tree = [
        {"component": "Lamp", "by": None, "link": "root", "state": "Lit", "worked": True},
        {"component": "Eye", "by": "Lamp", "link": "requires"},
        {"component": "Timer", "by": "Lamp", "link": "modulates", "parameters": {"speed": 2.0}},
        {"component": "Eye", "by": "Timer", "link": "requires"},
    ]
    rows = activation_rows(tree)
    assert [(row.depth, row.link, row.component) for row in rows] == [
        (0, "", "Lamp"),
        (1, "requires", "Eye"),
        (1, "modulates", "Timer"),
        (2, "requires", "Eye"),
    ]
    assert rows[2].detail == "speed 2"


def test_a_full_recording_loses_its_older_half(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vicode.runs.recording.MAX_ITERATIONS", 4)
    recording = recorded("Dark", "Dark", "Lit", "Lit")
    recording.make_room()
    recording.make_room()
    recording.add(moment(5, "Off", turns=5), {})
    assert recording.dropped == 2
    assert recording.states == ["Lit", "Lit", "Off"]
    assert list(recording.column("Lamp.turns")) == [3, 4, 5]
    assert recording.inputs_at(1) == {"Eye": {"light": 3}}
    last = recording.iteration(3)
    assert last is not None
    assert last.iteration == 5
