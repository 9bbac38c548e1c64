"""Extracted components: the same behavior in each iteration, and what is refused."""

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.generators.portable_designs import project_of
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.random_inputs import random_run
from vicode.conformance.reference import ReferenceRobots
from vicode.model.design import (
    Action,
    Assign,
    Call,
    Code,
    CommonSection,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    NeverProperty,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.extract import Extraction, extract_component
from vicode.model.project import Project

INSIDE = ("A", "B", "C")
OUTSIDE = ("X", "Y", "Z")
OWN = {"A": "a", "X": "b"}
HELPER = Design(
    component="Helper",
    parameters=(Declaration(name="k", type="float"),),
    outputs=(Declaration(name="runs", initial="0"),),
    initial="Run",
    states=(
        State(
            name="Run",
            actions=(Assign(values=(("runs", "runs + 1"),)),),
            transitions=(Transition(to="End", guard=Guard(when="runs % 3 == 0")),),
        ),
        State(name="End", final=True, actions=(Assign(values=(("runs", "runs + 1"),)),)),
    ),
)


@st.composite
def designs(draw: st.DrawFn) -> Design:
    """Draw a design whose states A, B and C can be extracted, except for some requirements."""

    def pick(*choices: Any) -> Any:
        return draw(st.sampled_from(choices))

    def guard(number: str) -> Guard:
        whens = ("", "eyes.seen", "not eyes.seen", f"{number} > 2", "state_time > 0.05", "done(helper)", "action_done")
        return Guard(when=pick(*whens), after=pick("", "", "", "0.03", "pause"))

    def decision(number: str, targets: tuple[str, ...], depth: int = 1) -> Decision:
        match pick("to", "to", "to", "stay", "group") if depth else "to":
            case "stay":
                return Stay(guard=guard(number))
            case "group":
                then = tuple(decision(number, targets, 0) for _ in range(draw(st.integers(1, 2))))
                return DecisionGroup(guard=guard(number), then=then, otherwise=(Stay(guard=guard(number)),))
            case _:
                return Transition(to=pick(*targets), guard=guard(number), disabled=pick(False, False, False, True))

    def assignments(number: str) -> tuple[Action, ...]:
        values = [
            (number, f"{number} + {pick('1', 'state_time', 'eyes.distance')}"),
            (number, pick("0", "helper.runs")),
        ]
        if number == "a":
            values += [("seen", f"not seen and {number} > 1"), ("shown", "a"), ("a", "a * fixed")]
        return tuple(Assign(values=(pick(*values),)) for _ in range(draw(st.integers(0, 2))))

    def state(name: str) -> State:
        number = "a" if name in INSIDE else "b"
        targets = ("A", *OUTSIDE) if name in OUTSIDE else (*INSIDE, *INSIDE, pick("X", "Z"), "Y")
        calls: tuple[Action, ...] = (Call(alias="helper", arguments=(("k", number),)), Call(alias="legs"))
        code = RunCode(code=Code(texts=(("python", f"self.{number} = self.{number} + 2"),)))
        reads = (Assign(values=(("b", "b + shown"),)),) if name in OUTSIDE else ()
        return State(
            name=name,
            disabled=name not in ("A", "X") and pick(False, False, False, False, True),
            requires=pick((), (), ("eyes",), ("eyes", "notes")),
            enter=assignments(number),
            actions=(*assignments(number), *pick((), (), calls[:1], calls[1:], calls, (code,)), *reads),
            leave=assignments(number),
            transitions=tuple(decision(number, targets) for _ in range(draw(st.integers(1, 3)))),
        )

    return Design(
        component="Player",
        frequency_hz=pick(None, None, 15.0, 40.0),
        resume=pick(False, False, True),
        time_unit=pick("", "ms"),
        arithmetic=pick("", "", "xabsl"),
        uses=tuple(Use(alias=alias, component=alias.capitalize()) for alias in ("eyes", "legs", "notes", "helper")),
        outputs=(Declaration(name="seen", type="bool"),),
        variables=(
            Declaration(name="a", type="float"),
            Declaration(name="b", type="float", initial="1"),
            Declaration(name="shown", type="float"),
            Declaration(name="fixed", initial="1.5"),
        ),
        initial=pick("A", "X"),
        states=tuple(state(name) for name in draw(st.permutations((*INSIDE, *OUTSIDE)))),
    )


def outer() -> Design:
    """A root that steps the player, with pauses of one or more iterations."""
    call = State(
        name="On",
        actions=(Call(alias="player"),),
        transitions=(Transition(to="Off", guard=Guard(when="eyes.seen", after="0.2")),),
    )
    off = State(name="Off", transitions=(Transition(to="On", guard=Guard(when="eyes.distance > 0")),))
    uses = (Use(alias="player", component="Player"), Use(alias="eyes", component="Eyes"))
    return Design(component="Outer", uses=uses, initial="On", states=(call, off))


def project_with(*designs: Design) -> Project:
    return project_of(*designs, HELPER, outer())


def reference(original: Design, extraction: Extraction) -> Design:
    """The original; where the extraction says so, its first decision comes an iteration later."""
    if not extraction.note:
        return original
    start = State(name="Start", transitions=(Transition(to=original.initial),))
    return replace(original, initial="Start", states=(*original.states, start))


def observed(run: ConformanceRun, hidden: tuple[str, ...] = ()) -> list[Any]:
    """What the rest of the robot sees in each iteration: the steps of other components, outputs, done."""
    robots = ReferenceRobots(run.project, run.root, run.inputs)
    seen: list[Any] = []
    for step in run.steps:
        for record in robots.step(step)[0]["tree"]:
            if record["component"] == "Player":
                values = record["values"]
                seen.append((record["worked"], record["done"], values["seen"], values["shown"], values["b"]))
            elif record["component"] not in hidden:
                seen.append({key: value for key, value in record.items() if key != "by"})
        seen.append(step.time_ns)
    return sorted_within_iterations(seen)


def sorted_within_iterations(seen: list[Any]) -> list[Any]:
    """The player's record begins before those of what it steps, with the values at its end: its place is free."""
    result: list[Any] = []
    waiting: list[Any] = []
    for each in seen:
        if isinstance(each, int):
            result += [*(item for item in waiting if isinstance(item, dict)), *waiting, each]
            waiting = []
        else:
            waiting.append(each)
    return [each for each in result if not isinstance(each, dict)] + [each for each in result if isinstance(each, dict)]


@settings(max_examples=settings().max_examples * 3)
@given(designs(), st.integers(0, 1000))
def test_extracted_states_behave_the_same(design: Design, seed: int) -> None:
    extraction = extract_component(design, INSIDE, "Part")
    assume(not extraction.problems)
    before = project_with(reference(design, extraction))
    run = random_run(before, "Outer", iterations=60, seed=seed)
    after = replace(run, project=project_with(extraction.caller, extraction.component))
    assert observed(after, hidden=("Part",)) == observed(run)
