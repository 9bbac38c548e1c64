"""Test suites of designs, against expectations written by hand and against the generated Python."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from benchmarks.analysis import make_design, make_machine
from vicode.conformance.design_mutants import try_mutants
from vicode.conformance.suite import (
    GENERATED,
    Suite,
    SuiteError,
    format_suite,
    iterate_expected,
    make_run,
    observe_records,
    read_suite,
)
from vicode.conformance.suite_cases import find_cases
from vicode.conformance.suite_runner import check_suite
from vicode.model.project import Project
from vicode.store import open_project

GATE_PROJECT = """\
vicode: 1
project: Gates
components:
  Eye: {implementation: hands:Eye, outputs: {distance: {type: float, range: [0, 10]}, seen: bool}}
"""
GATE = """\
vicode: 1
component: Gate
uses: {eye: Eye}
outputs: {speed: 0.0}
initial: Closed
states:
  Closed:
    requires: [eye]
    actions: [{set: {speed: 0}}]
    transitions:
      - {to: Blocked, when: eye.distance < 1}
      - {to: Open, when: eye.seen and eye.distance < 4}
  Open:
    requires: [eye]
    actions: [{set: {speed: 0.5}}]
    transitions:
      - {to: Blocked, when: eye.distance < 1}
      - {to: Closed, after: 2}
  Blocked:
    requires: [eye]
    actions: [{set: {speed: -0.5}}]
    transitions: [{to: Closed, when: eye.distance >= 1.5}]
"""
SPEEDS = {"Closed": 0.0, "Open": 0.5, "Blocked": -0.5}


def decide(state: str, time_ns: int, inputs: Mapping[str, Any]) -> str:
    """The next state of the gate, as its author means it."""
    distance, seen = inputs.get("Eye.distance", 0.0), inputs.get("Eye.seen", False)
    if state == "Blocked":
        return "Closed" if distance >= 1.5 else "Blocked"
    if distance < 1:
        return "Blocked"
    if state == "Closed":
        return "Open" if seen and distance < 4 else "Closed"
    return "Closed" if time_ns >= 2_000_000_000 else "Open"


def load(folder: Path, design: str = GATE, project: str = GATE_PROJECT) -> Project:
    (folder / "project.yaml").write_text(project, encoding="utf-8")
    (folder / "gate.yaml").write_text(design, encoding="utf-8")
    return open_project(folder).project


def make_suite(project: Project, component: str = "Gate") -> Suite:
    cases = find_cases(project, component).cases
    return Suite(component=component, design="gate.yaml", source=GENERATED, languages=("python",), cases=cases)


def test_the_expected_states_are_those_that_the_author_means(tmp_path: Path) -> None:
    suite = make_suite(load(tmp_path))
    taken = set[tuple[str, str]]()
    for case in suite.cases:
        state, entered_ns, inputs = "Closed", 0, dict[str, Any]()
        for step, seen in zip(case.steps, iterate_expected(case), strict=True):
            inputs |= step.set
            following = decide(state, step.time_ns - entered_ns, inputs)
            assert (seen["Gate"], seen["Gate.speed"]) == (following, SPEEDS[following]), (case.name, step)
            if following != state:
                taken.add((state, following))
                state, entered_ns = following, step.time_ns
    assert taken == {
        ("Closed", "Blocked"),
        ("Closed", "Open"),
        ("Open", "Blocked"),
        ("Open", "Closed"),
        ("Blocked", "Closed"),
    }


def test_limits_are_tried_on_both_sides(tmp_path: Path) -> None:
    steps = [step for case in make_suite(load(tmp_path)).cases for step in case.steps]
    assert {"eye.distance < 4: just below 4", "eye.distance < 4: 4", "after 2: 1 ns before"} <= {
        step.shows for step in steps
    }
    distances = {step.set.get("Eye.distance") for step in steps}
    assert {1.0, 0.9999999999999999, 4.0, 3.9999999999999996, 1.5, 1.4999999999999998} <= distances


def test_each_fault_of_a_small_design_is_noticed(tmp_path: Path) -> None:
    project = load(tmp_path)
    suite = make_suite(project)
    runs = [make_run(suite, case, project) for case in suite.cases]
    report = try_mutants(runs, observe=observe_records(project), is_root_only=True)
    # The first iteration sets the output, so that nothing shows its initial value.
    assert [mutant.text for mutant in report.survivors if mutant.path[0] != "outputs"] == []
    assert report.count > 40


def test_generated_python_agrees_on_all_steps(tmp_path: Path) -> None:
    design = replace(make_design(make_machine(8), has_ranges=True), component="Gate")
    project = Project(name="drawn", components=(), designs=(design,))
    suite = make_suite(project)
    assert suite.steps > 200
    assert not any(check_suite(suite, project, tmp_path, "python"))


def test_another_behavior_is_reported_with_the_step_and_its_inputs(tmp_path: Path) -> None:
    suite = make_suite(load(tmp_path))
    changed = load(tmp_path, GATE.replace("eye.distance < 4", "eye.distance <= 4"))
    problems = [problem for problem in check_suite(suite, changed, tmp_path, "python") if problem]
    first, *lines = problems[0].splitlines()
    assert first.endswith("Python: Gate is Open, expected Closed")
    assert lines[0] == "the step shows: eye.distance < 4: 4"
    assert "  Eye.distance = 4.0" in lines


def test_a_used_design_is_led_to_where_the_guard_holds(tmp_path: Path) -> None:
    (tmp_path / "lock.yaml").write_text(
        "vicode: 1\ncomponent: Lock\nuses: {eye: Eye}\ninitial: Locked\nstates:\n"
        "  Locked: {transitions: [{to: Turning, when: eye.seen}]}\n"
        "  Turning: {transitions: [{to: Unlocked, after: 3}]}\n"
        "  Unlocked: {final: true}\n",
        encoding="utf-8",
    )
    design = (
        "vicode: 1\ncomponent: Gate\nuses: {lock: Lock}\ninitial: Shut\nstates:\n"
        "  Shut: {modulates: [lock], transitions: [{to: Open, when: done(lock)}]}\n"
        "  Open: {final: true}\n"
    )
    found = find_cases(load(tmp_path, design), "Gate")
    assert [each.text for each in found.coverage.never] == []
    assert any(case.name == "Shut → Open" for case in found.cases)


def test_a_suite_is_the_same_after_it_was_written_and_read(tmp_path: Path) -> None:
    project = load(tmp_path)
    suite = make_suite(project)
    file = tmp_path / "gate.suite.json"
    file.write_text(format_suite(suite), encoding="utf-8")
    assert read_suite(file) == suite
    assert format_suite(make_suite(project)) == format_suite(suite)


@pytest.mark.parametrize("text", ["[]", "{", '{"vicode-suite": 2}', '{"vicode-suite": 1, "component": "Gate"}'])
def test_a_file_that_is_no_suite_is_named(text: str, tmp_path: Path) -> None:
    file = tmp_path / "gate.suite.json"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(SuiteError, match=r"gate\.suite\.json"):
        read_suite(file)


def test_an_input_that_the_design_no_longer_has_is_named(tmp_path: Path) -> None:
    suite = make_suite(load(tmp_path))
    changed = load(tmp_path, GATE.replace("eye.seen and ", ""), GATE_PROJECT.replace(", seen: bool", ""))
    with pytest.raises(SuiteError, match=r"Gate has no input Eye\.seen"):
        check_suite(suite, changed, tmp_path, "python")
