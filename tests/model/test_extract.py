"""Extracted components: the same behavior in each iteration, and what is refused."""

import random
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import settings

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
    Latch,
    NeverProperty,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.extract import Extraction, extract_component
from vicode.model.inline import inline_component
from vicode.model.project import Project

INSIDE = ("A", "B", "C")
OUTSIDE = ("X", "Y", "Z")
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


class Drawer:
    """Draws a design whose states A, B and C can be extracted, except for some requirements."""

    def __init__(self, seed: int) -> None:
        self.rng = random.Random(seed)
        self.ends = self.pick(("X",), ("X", "Y"), ("Y", "Z"))
        self.is_entered = self.rng.random() < 0.8

    def pick(self, *choices: Any) -> Any:
        return self.rng.choice(choices)

    def guard(self, number: str) -> Guard:
        whens = ("", "eyes.seen", "not eyes.seen", f"{number} > 2", "state_time > 0.05", "done(helper)", "action_done")
        return Guard(when=self.pick(*whens), after=self.pick("", "", "", "0.03", "pause"))

    def decision(self, number: str, targets: tuple[str, ...], depth: int = 1) -> Decision:
        match self.pick(*("to",) * 5, "stay", "group") if depth else "to":
            case "stay":
                return Stay(guard=self.guard(number))
            case "group":
                then = tuple(self.decision(number, targets, 0) for _ in range(self.rng.randint(1, 2)))
                return DecisionGroup(guard=self.guard(number), then=then, otherwise=(Stay(guard=self.guard(number)),))
            case _:
                is_off = self.rng.random() < 0.1
                return Transition(to=self.pick(*targets), guard=self.guard(number), disabled=is_off)

    def assignments(self, number: str) -> tuple[Action, ...]:
        added = self.pick("1", "state_time", "eyes.distance")
        values = [(number, f"{number} + {added}"), (number, self.pick("0", "helper.runs"))]
        if number == "a":
            values += [("seen", f"not seen and {number} > 1"), ("shown", "a"), ("a", "a * fixed")]
        return tuple(Assign(values=(self.pick(*values),)) for _ in range(self.rng.randint(0, 2)))

    def state(self, name: str) -> State:
        number = "a" if name in INSIDE else "b"
        others = (*("A", "A") * self.is_entered, *OUTSIDE) if name in OUTSIDE else (*INSIDE, *self.ends)
        targets = tuple(each for each in others if each != name)
        calls: tuple[Action, ...] = (Call(alias="helper", arguments=(("k", number),)), Call(alias="legs"))
        code = RunCode(code=Code(texts=(("python", f"self.{number} = self.{number} + 2"),)))
        reads = (Assign(values=(("b", "b + shown"),)),) if name in OUTSIDE else ()
        return State(
            name=name,
            disabled=name not in ("A", "X") and self.rng.random() < 0.1,
            requires=self.pick((), (), ("eyes",), ("eyes", "notes")),
            enter=self.assignments(number),
            actions=(*self.assignments(number), *self.pick((), (), calls[:1], calls[1:], calls, (code,)), *reads),
            leave=self.assignments(number),
            transitions=tuple(self.decision(number, targets) for _ in range(self.rng.randint(1, 3))),
        )


def draw_design(seed: int) -> Design:
    drawer = Drawer(seed)
    pick = drawer.pick
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
        initial=pick("A", "X") if drawer.is_entered else "A",
        states=tuple(drawer.state(name) for name in drawer.rng.sample((*INSIDE, *OUTSIDE), 6)),
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


def observed(run: ConformanceRun, hidden: tuple[str, ...] = ()) -> str:
    """What the rest of the robot sees in each iteration: the steps of other components, outputs, done.

    As a text, since nan differs from itself.
    """
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
    return repr(sorted_within_iterations(seen))


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


def test_extracted_states_behave_the_same() -> None:
    for seed in range(settings().max_examples * 4):
        design = draw_design(seed)
        extraction = extract_component(design, INSIDE, "Part")
        if not extraction.problems:
            before = project_with(reference(design, extraction))
            run = random_run(before, "Outer", iterations=80, seed=seed)
            after = replace(run, project=project_with(extraction.caller, extraction.component))
            assert observed(after, hidden=("Part",)) == observed(run), seed


def test_inlined_components_behave_as_before() -> None:
    for seed in range(settings().max_examples * 2):
        design = draw_design(seed)
        extraction = extract_component(design, INSIDE, "Part")
        if not extraction.problems:
            inlining = inline_component(extraction.caller, "Part", extraction.component)
            assert not inlining.problem, seed
            run = random_run(project_with(design), "Outer", iterations=80, seed=seed)
            after = replace(run, project=project_with(inlining.caller))
            assert observed(after) == observed(run), seed


def plain(*states: State, **fields: Any) -> Design:
    return Design(component="Player", initial=states[0].name, states=states, **fields)


def to(*names: str, when: str = "") -> tuple[Transition, ...]:
    return tuple(Transition(to=name, guard=Guard(when=when)) for name in names)


def test_one_way_out_needs_no_output_and_a_state_that_is_only_started_no_start() -> None:
    design = plain(State(name="A", transitions=to("B")), State(name="B", transitions=to("X")), State(name="X"))
    extraction = extract_component(design, ["A", "B"], "GetBall")
    call = State(name="GetBall", requires=("get_ball",), transitions=to("X", when="done(get_ball)"))
    assert extraction.caller.states == (call, State(name="X"))
    assert extraction.component == Design(
        component="GetBall",
        doc="Extracted from Player.",
        initial="A",
        states=(*design.states[:1], State(name="B", transitions=to("ToX")), State(name="ToX", final=True)),
    )
    assert not extraction.note


def test_several_ways_out_are_told_apart_by_outputs_and_a_disabled_target_stays_disabled() -> None:
    states = (State(name="X", transitions=to("A")), State(name="A", transitions=to("X", "Y")))
    extraction = extract_component(plain(*states, State(name="Y", disabled=True)), ["A"], "Part")
    call = extraction.caller.state("Part")
    assert call is not None
    assert [each.guard.when for each in call.transitions] == ["done(part) and part.to_x", "done(part) and part.to_y"]
    assert [(each.name, each.disabled) for each in extraction.component.states if each.final] == [
        ("ToX", False),
        ("ToY", True),
    ]


A = State(name="A", transitions=to("X"))
X = State(name="X", transitions=to("A"))
NUMBER = Declaration(name="n", initial="0")
COUNT = Assign(values=(("n", "n + 1"),))
READER = State(name="A", transitions=to("X", when="n > 1"))
CODE = RunCode(code=Code(texts=(("python", "self.go()"),)))


@pytest.mark.parametrize(
    ("design", "problem"),
    [
        (plain(X), "select the states to extract"),
        (plain(A, X, common=CommonSection(transitions=to("X"))), "the common section applies to each state"),
        (plain(A, X, State(name="B", transitions=to("X"))), ""),
        (plain(X, State(name="Y", transitions=to("B")), A, State(name="B")), "several places: A (from X), B (from Y)"),
        (plain(State(name="X"), A), "no transition enters the states"),
        (plain(X, replace(A, final=True)), "A is a final state"),
        (plain(X, replace(A, capacity=1)), "A is entered together with other robots"),
        (plain(X, A, resume=True, arithmetic="xabsl"), "the component is not done"),
        (plain(replace(X, capacity=1), A), "X is entered together with other robots"),
        (plain(X, State(name="A", transitions=to("X", when="component_time > 1"))), "A reads component_time"),
        (
            plain(X, State(name="A", transitions=to("X", when="n > 1")), parameters=(NUMBER,)),
            "A reads the parameter 'n'",
        ),
        (
            plain(
                replace(X, actions=(COUNT,)), State(name="A", transitions=to("X", when="n > 1")), variables=(NUMBER,)
            ),
            "A uses 'n', which X sets",
        ),
        (plain(X, replace(A, actions=(CODE,)), members=CODE.code), "the code of A may use 'members'"),
        (plain(X, A, latches=(Latch(name="late", on="state_time > 1"),)), "the design has latches"),
        (plain(X, A, properties=(NeverProperty(never="A"),)), "a property of Player names the state A"),
        (plain(replace(X, requires=("eyes",)), replace(A, requires=("eyes",))), ""),
        (
            plain(X, State(name="A", requires=("eyes",), transitions=to("B")), State(name="B", transitions=to("X"))),
            "",
        ),
        (
            plain(
                replace(X, requires=("eyes",)),
                State(name="A", requires=("eyes",), transitions=to("B")),
                State(name="B", transitions=to("X")),
            ),
            "X and A both require 'eyes', which would be stepped twice",
        ),
    ],
)
def test_what_cannot_keep_its_behavior_is_refused_with_its_place(design: Design, problem: str) -> None:
    found = "; ".join(extract_component(design, ["A", "B"], "Part").problems)
    assert problem in found if problem else not found


def extracted() -> Extraction:
    return extract_component(plain(X, A, State(name="Y", transitions=to("X"))), ["A"], "Part")


def test_an_edited_component_is_inlined_with_its_edits() -> None:
    part = extracted().component
    grown = replace(
        part,
        states=(
            *(replace(each, transitions=to("B")) if each.name == "A" else each for each in part.states),
            State(name="B", actions=(COUNT,), transitions=to("ToX", when="n > 3")),
        ),
        variables=(NUMBER,),
    )
    inlining = inline_component(extracted().caller, "Part", grown)
    assert not inlining.problem
    assert [*inlining.names.values()] == ["A", "B"]
    assert inlining.caller.variables == (NUMBER,)
    assert inlining.caller.state("B") == State(name="B", actions=(COUNT,), transitions=to("X", when="n > 3"))


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"frequency_hz": 5.0}, "differ in 'frequency'"),
        ({"resume": True}, "differ in 'resume'"),
        ({"parameters": (NUMBER,)}, "Part has parameters"),
        ({"common": CommonSection(actions=(COUNT,))}, "Part has a common section"),
        ({"latches": (Latch(name="late", on="state_time > 1"),)}, "Part has latches"),
        ({"initial": "A"}, "the behavior would change"),
        ({"states": extracted().component.states[:-1]}, "A: there is no state 'ToX'"),
    ],
)
def test_a_component_that_does_more_is_not_inlined(change: dict[str, Any], problem: str) -> None:
    assert problem in inline_component(extracted().caller, "Part", replace(extracted().component, **change)).problem


def test_a_component_that_is_used_twice_or_by_a_state_that_does_more_is_not_inlined() -> None:
    caller, part = extracted().caller, extracted().component
    other = replace(caller, states=(*caller.states, State(name="Also", requires=("part",))))
    assert "used in several places: Part, Also" in inline_component(other, "Part", part).problem
    busy = tuple(replace(each, enter=(COUNT,)) if each.name == "Part" else each for each in caller.states)
    assert "the behavior would change" in inline_component(replace(caller, states=busy), "Part", part).problem
