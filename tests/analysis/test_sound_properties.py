"""Properties that hold at first sight, and are broken by what is easily forgotten: none of them is guaranteed."""

from pathlib import Path

import pytest

from vicode.analysis.guards import analyze_guards
from vicode.analysis.properties import PropertyVerdict, judge_properties
from vicode.store import open_project

COUNTER = """\
component: B
outputs: {n: 0}
initial: S
states: {S: {actions: [{set: {n: n + 1}}]}}
"""
CALLER = """\
component: A
uses: {b: B}
initial: S
states: {S: {actions: [{call: b}]}}
"""
PROJECT = """\
vicode: 1
project: p
constants: {TUN: {value: 1.0, range: [0, 20], tunable: true}}
components: {W: {implementation: internal, variables: {v: 0}}}
"""
STATES = """
initial: S
states:
  S: {enter: [{set: {k: 0}}], actions: [{set: {k: 0}}%s], transitions: [{to: T, when: %s}]}
  T: {enter: [{set: {k: 1}}%s], actions: [%s], transitions: [{to: S, when: %s}]}
properties: [{holds: %s}]
"""


def judge(folder: Path, **texts: str) -> PropertyVerdict:
    for name, text in {"project": PROJECT, **texts}.items():
        (folder / f"{name}.yaml").write_text(text if name == "project" else f"vicode: 1\n{text}", encoding="utf-8")
    project = open_project(folder).project
    design = project.design("R")
    assert design is not None
    (judged,) = judge_properties(project, design)
    return judged.verdict


@pytest.mark.parametrize("uses", ["{a: A, b: B}", "{a: B, b: B}"])
def test_a_called_component_steps_the_one_that_is_read(uses: str, tmp_path: Path) -> None:
    states = STATES % (", {call: a}", "b.n == 1", "", "{call: a}", "b.n != 1", "k == 0 or b.n != 2")
    design = f"component: R\nuses: {uses}\nvariables: {{k: 0}}{states}"
    assert judge(tmp_path, b=COUNTER, a=CALLER, r=design) is not PropertyVerdict.GUARANTEED


def test_variables_of_other_components_are_set(tmp_path: Path) -> None:
    states = STATES % ("", "w.v == 0", ", {set: {w.v: 5}}", "", "w.v == 5", "k == 0 or w.v != 5")
    design = f"component: R\nuses: {{w: W}}\nvariables: {{k: 0}}{states}"
    assert judge(tmp_path, r=design) is not PropertyVerdict.GUARANTEED


def test_inputs_change_between_periods(tmp_path: Path) -> None:
    states = STATES % ("", "w.v == 1", "", "", "w.v != 1", "k == 0 or w.v == 1")
    design = f"component: R\nfrequency: 10\nuses: {{w: W}}\nvariables: {{k: 0}}{states}"
    assert judge(tmp_path, r=design) is not PropertyVerdict.GUARANTEED


@pytest.mark.parametrize(
    ("promised", "verdict"),
    [
        ("{reach: T, within: TUN}", PropertyVerdict.FAILS),
        ("{reach: T, within: 6}", PropertyVerdict.GUARANTEED),
        ("{reach: T, within: 1e300}", PropertyVerdict.UNDECIDED),
        ("{holds: v <= TUN}", PropertyVerdict.UNDECIDED),
    ],
)
def test_constants_are_tuned(promised: str, verdict: PropertyVerdict, tmp_path: Path) -> None:
    design = f"""
component: R
variables: {{v: 0.0}}
initial: S
states: {{S: {{transitions: [{{to: T, after: 5}}]}}, T: {{enter: [{{set: {{v: TUN}}}}], final: true}}}}
properties: [{promised}]
"""
    assert judge(tmp_path, r=design) is verdict


@pytest.mark.parametrize(("value", "is_kept"), [("r + 1", False), ("min(r + 1, 3)", True), ("2", True), ("4", False)])
def test_a_range_counts_if_the_design_keeps_it(value: str, is_kept: bool, tmp_path: Path) -> None:
    design = f"""
component: R
variables: {{r: {{type: int, initial: 0, range: [0, 3]}}}}
initial: S
states: {{S: {{actions: [{{set: {{r: "{value}"}}}}], transitions: [{{to: T, when: r > 3}}]}}, T: {{final: true}}}}
properties: [{{never: T}}]
"""
    verdict = judge(tmp_path, r=design)
    assert (verdict is PropertyVerdict.GUARANTEED) == is_kept
    project = open_project(tmp_path).project
    verdicts = list(analyze_guards(project, project.designs[0]).find_verdicts())
    assert bool(verdicts) == is_kept
