"""Constructs become plain states when a design is read, and only they are saved.

What they mean is tested by tests/conformance in each language; here two are compared with programs written by hand.
"""

import random
from dataclasses import replace

import pytest
from hypothesis import given

from tests.strategies.designs import lowered_designs, written_designs
from vicode.check import check_project
from vicode.findings import Severity
from vicode.model.design import Design, Latch, Transition
from vicode.model.edits import remove_states, rename_state
from vicode.model.lowering import find_lost_edit, lift_design, lower_design, lower_edit, source_path
from vicode.model.project import Interface, Project
from vicode.model.rename import SymbolRef, rename_alias, rename_symbol
from vicode.semantics import Interpreter
from vicode.store import read_design, save_design

INTERRUPTED = """\
vicode: 1
component: Player
uses: {eyes: Eyes}
initial: GotoA
latches:
  near: {on: eyes.distance < 300, off: eyes.distance > 400, hold: 0.25}
interrupts:
  - {do: Wait, while: [Goto*], when: eyes.person, every: 1.95}
states:
  GotoA: {transitions: [{to: GotoB, when: near}]}
  GotoB: {transitions: [{to: GotoA, when: not near}]}
  Wait: {}
"""
COMPETENCE = """\
vicode: 1
component: Fetch
uses: {eyes: Eyes}
competence:
  goal: eyes.distance < 10
  steps:
    Look: {when: eyes.person, retries: 2}
    Wait: {}
"""
EYES = "eyes: {outputs: {distance: {type: float, initial: 900}, person: bool}}"


def read(text: str) -> Design:
    found = read_design(text)
    assert not found.findings
    assert found.design is not None
    return found.design


def project_of(*designs: Design) -> Project:
    eyes = read_project_component()
    return Project(name="P", components=(eyes,), designs=designs)


def read_project_component() -> Interface:
    from vicode.store import read_project_file

    text = f"vicode: 1\nproject: P\ncomponents:\n  {EYES.replace('eyes', 'Eyes', 1)}\n"
    project = read_project_file(text).project
    assert project is not None
    return project.components[0]


@given(written_designs)
def test_lowering_is_undone_and_repeated_without_a_difference(design: Design) -> None:
    lowered = lower_design(design)
    assert lift_design(lowered) == design
    assert lower_design(lowered) == lowered
    assert not find_lost_edit(lowered)


@given(lowered_designs)
def test_a_renamed_state_leaves_a_lowered_design(design: Design) -> None:
    for state in design.states[:1]:
        assert not find_lost_edit(rename_state(design, state.name, "Renamed"))
        assert not find_lost_edit(remove_states(design, {state.name}))


def test_an_edit_of_something_derived_is_refused() -> None:
    design = read(INTERRUPTED)
    state = design.state("GotoA")
    assert state is not None
    edited = replace(design, states=tuple(replace(each, transitions=()) for each in design.states))
    with pytest.raises(ValueError, match="derived from 'interrupts'"):
        save_design(edited, INTERRUPTED)
    only_derived = replace(
        design,
        states=tuple(
            replace(each, transitions=each.transitions[1:]) if each is state else each for each in design.states
        ),
    )
    assert lower_edit(design, only_derived) == (
        design,
        "this part is derived from 'interrupts' (number 1); edit it in the form of the design",
    )


def test_renaming_reaches_the_constructs() -> None:
    design = rename_state(read(INTERRUPTED), "Wait", "Stop")
    assert "do: Stop" in save_design(design, INTERRUPTED)
    design = rename_alias(design, "eyes", "camera")
    saved = save_design(design, INTERRUPTED)
    assert "on: camera.distance < 300" in saved
    assert "when: camera.person" in saved
    renamed = rename_symbol(
        project_of(read(INTERRUPTED)), SymbolRef(component="Player", section="variables", name="near"), "close"
    )
    saved = save_design(renamed.designs[0], INTERRUPTED)
    assert "close: {on:" in saved
    assert "when: not close" in saved
    fetch = rename_state(read(COMPETENCE), "Look", "Search")
    assert "Search: {when: eyes.person" in save_design(fetch, COMPETENCE)


def test_findings_are_at_the_constructs() -> None:
    text = INTERRUPTED.replace("when: eyes.person", "when: eyes.nobody").replace("on: eyes.d", "on: eyes.z")
    found = read_design(text)
    assert found.design is not None
    errors = [each for each in check_project(project_of(found.design)) if each.rule.code == "E303"]
    lines = sorted(
        found.source_map.locate(each.subject.path, each.subject.span).line for each in errors if each.subject
    )
    assert lines == [6, 8]


def test_paths_of_written_items_skip_what_is_derived() -> None:
    design = read(INTERRUPTED)
    assert source_path(design, ("states", "GotoA", "transitions", 1)) == ("states", "GotoA", "transitions", 0)
    assert source_path(design, ("states", "GotoA", "transitions", 0, "then", 0)) == ("interrupts", 0)
    assert source_path(design, ("variables", "near")) == ("latches", "near")


@pytest.mark.parametrize("seed", range(5))
def test_a_latch_and_an_interrupt_are_what_a_program_does(seed: int) -> None:
    """The oracle: the same behavior as a loop, with the times of each state kept by hand."""
    rng = random.Random(seed)
    interpreter = Interpreter(project_of(read(INTERRUPTED)), "Player")
    near, changed, state, back, again = False, -1.0, "", "", 0.0
    for step in range(200):
        now, distance, person = step * 0.1, rng.choice([100.0, 350.0, 500.0]), rng.random() < 0.2
        interpreter.set_input("Eyes", "distance", distance)
        interpreter.set_input("Eyes", "person", person)
        if not state:
            state = "GotoA"
        if state == "Wait":
            if not person:
                state, again = back, now + 1.95
        elif person and now >= again:
            back, state = state, "Wait"
        elif state == "GotoA" and near:
            state = "GotoB"
        elif state == "GotoB" and not near:
            state = "GotoA"
        if changed < 0 or now >= changed + 0.25:
            wanted = distance < 300 or (near and not distance > 400)
            changed, near = (now, wanted) if wanted != near else (changed, near)
        record = interpreter.step(round(now * 1e9))
        assert record["tree"][0]["state"] == state, step


def test_written_common_transitions_come_before_those_of_layers() -> None:
    text = """\
vicode: 1
component: Rover
uses: {eyes: Eyes}
common: {transitions: [{to: Stop, when: eyes.person}]}
layers:
  Go: {}
  Stop: {when: eyes.distance < 1}
"""
    design = read(text)
    assert [(each.to, bool(each.origin)) for each in design.common.transitions if isinstance(each, Transition)] == [
        ("Stop", False),
        ("Stop", True),
        ("Go", True),
    ]
    assert save_design(design, text) == text


def test_an_edit_of_written_and_derived_parts_is_refused_as_a_whole() -> None:
    design = read(INTERRUPTED)
    emptied = replace(design, doc="new", states=tuple(replace(each, transitions=()) for each in design.states))
    assert lower_edit(design, emptied)[0] == design
    state = design.state("GotoA")
    assert state is not None
    pasted = replace(design, states=(*design.states, replace(state, name="GotoC")))
    lowered, reason = lower_edit(design, pasted)
    assert (lowered.states[-1].name, reason) == ("GotoC", "")
    assert not find_lost_edit(lowered)


def test_conditions_may_be_conditional_expressions() -> None:
    text = """\
vicode: 1
component: Player
uses: {eyes: Eyes}
latches: {near: {on: true if eyes.person else false, off: false if eyes.person else true, hold: 1}}
layers:
  Go: {}
  Stop: {when: eyes.person if eyes.distance > 1 else false, for: 1}
"""
    assert [each for each in check_project(project_of(read(text))) if each.severity is Severity.ERROR] == []


def test_a_state_handles_one_interrupt() -> None:
    text = INTERRUPTED.replace("states:", "  - {do: Wait, when: near, then: restart}\nstates:")
    found = [each for each in check_project(project_of(read(text))) if each.severity is Severity.ERROR]
    assert [(each.rule.code, each.subject.path) for each in found if each.subject] == [
        ("D447", ("interrupts", 1, "do"))
    ]


def test_who_was_not_interrupted_does_not_resume() -> None:
    """`Wait` is also reached by a common transition, from a state that the interrupt leaves alone."""
    text = INTERRUPTED.replace(
        "states:", "common: {transitions: [{to: Wait, when: eyes.distance < 1}]}\nstates:"
    ).replace("  Wait: {}", "  Wait: {transitions: [{to: Rest, after: 0.15}]}\n  Rest: {}")
    text = text.replace("transitions: [{to: GotoB, when: near}]", "transitions: [{to: Rest, after: 0.15}]")
    interpreter = Interpreter(project_of(read(text)), "Player")
    states = []
    for step in range(8):
        interpreter.set_input("Eyes", "person", value=False)
        interpreter.set_input("Eyes", "distance", 0.0 if step == 4 else 900.0)
        states.append(interpreter.step(step * 100_000_000)["tree"][0]["state"])
    assert states == ["GotoA", "GotoA", "Rest", "Rest", "Wait", "Wait", "Rest", "Rest"]


def test_an_interrupted_interrupt_finds_the_way_back() -> None:
    text = """\
vicode: 1
component: Player
uses: {eyes: Eyes}
initial: Go
interrupts:
  - {do: Wait, when: eyes.person}
  - {do: Avoid, when: eyes.distance < 300}
states:
  Rest: {}
  Go: {}
  Wait: {}
  Avoid: {}
"""
    interpreter = Interpreter(project_of(read(text)), "Player")
    states = []
    for step, (person, distance) in enumerate([(0, 900), (0, 100), (1, 100), (1, 100), (0, 100), (0, 900), (0, 900)]):
        interpreter.set_input("Eyes", "person", value=bool(person))
        interpreter.set_input("Eyes", "distance", float(distance))
        states.append(interpreter.step(step * 100_000_000)["tree"][0]["state"])
    assert states == ["Go", "Avoid", "Wait", "Wait", "Avoid", "Go", "Go"]


def test_a_latch_without_condition_is_a_variable() -> None:
    design = lower_design(Design(component="Player", latches=(Latch(name="near", hold="1"), Latch(name="far"))))
    assert {each.name for each in design.variables} >= {"near", "far"}
    assert "()" not in str(design.common.actions)
