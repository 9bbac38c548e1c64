"""Traces are compared by the declared types of their values, and without what a language cannot tell."""

from dataclasses import replace
from typing import Any

import pytest

from vicode.conformance.traces import (
    TraceDifference,
    TraceIteration,
    TraceNormalizer,
    TraceStep,
    first_difference,
    large_ints_limit,
    reduce_for,
)
from vicode.model.design import Declaration, Design, State
from vicode.model.project import INTERNAL, WORLD, Interface, Project

LAMP = Design(
    component="Lamp",
    initial="A",
    parameters=(Declaration(name="speed", type="float"),),
    outputs=(Declaration(name="on", type="bool"),),
    variables=(Declaration(name="count", type="int"), Declaration(name="side", type="Side")),
    states=(State(name="A"),),
)
PROJECT = Project(
    name="p",
    designs=(LAMP,),
    components=(
        Interface(component="Board", implementation=INTERNAL, variables=(Declaration(name="total", type="int"),)),
        Interface(component="Field", implementation=WORLD, outputs=(Declaration(name="ball", type="float"),)),
    ),
)
STEP: dict[str, Any] = {
    "component": "Lamp",
    "by": None,
    "link": "root",
    "worked": True,
    "state": "A",
    "state_time_ns": 1_500_000,
    "component_time_ns": 20_000_000,
    "changed_from": None,
    "transition": None,
    "done": False,
    "parameters": {},
    "values": {},
}


def normalized(step: dict[str, Any], **record: Any) -> TraceIteration:
    return TraceNormalizer(PROJECT).iteration({"iteration": 3, "time_ns": 40, "tree": [{**STEP, **step}], **record}, 2)


def fields(**step: Any) -> dict[str, str]:
    return dict(normalized(step).steps[0].fields)


def test_a_step_is_written_in_one_form() -> None:
    assert fields() == {
        "by": "",
        "link": "root",
        "worked": "true",
        "state": "A",
        "state_time": "1.5",
        "component_time": "20",
        "changed_from": "",
        "transition": "",
        "done": "false",
    }
    written = fields(by="Main", worked=False, changed_from="B", transition="t1", done=True, state_time_ns=1)
    changed = {name: written[name] for name in ("by", "worked", "changed_from", "transition", "done", "state_time")}
    assert changed == {
        "by": "Main",
        "worked": "false",
        "changed_from": "B",
        "transition": "t1",
        "done": "true",
        "state_time": "0.000001",
    }


@pytest.mark.parametrize(
    ("name", "value", "text"),
    [
        ("count", 7, "7"),
        ("count", 7.0, "7"),
        ("count", -7.0, "-7"),
        ("count", 7.5, "7.5"),
        ("count", -0.25, "-0.25"),
        ("count", True, "1"),
        ("count", float("inf"), "inf"),
        ("count", float("nan"), "nan"),
        ("on", 1, "true"),
        ("on", 0.0, "false"),
        ("side", "left", "left"),
        ("side", "7.0", "7.0"),
        ("speed", 7, "7.0"),
        ("speed", 0.1, "0.1"),
    ],
)
def test_values_are_written_by_their_type(name: str, value: Any, text: str) -> None:
    section = "parameters" if name == "speed" else "values"
    assert fields(**{section: {name: value}})[f"{section}.{name}"] == text


def test_an_int_with_a_fraction_differs_from_the_whole_number() -> None:
    whole, half = ([normalized({"values": {"count": value}})] for value in (7, 7.5))
    found = TraceDifference(index=0, component="Lamp", field="values.count", values=("7", "7.5"))
    assert first_difference(whole, half) == found


def test_only_values_of_the_design_and_shared_variables_are_compared() -> None:
    assert "values.other" not in fields(values={"other": 1, "count": 1})
    iteration = normalized({}, inputs={"Board": {"total": 2.0}, "Field": {"ball": 1.0}})
    assert iteration.shared == {"Board.total": "2"}
    assert (iteration.number, iteration.time_ns, iteration.robot) == (3, 40, 2)
    assert normalized({}, inputs=None).shared == {}
    assert TraceNormalizer(PROJECT).iteration({"iteration": 1, "time_ns": 0, "tree": []}).robot == FIRST.robot == 0
    outside = TraceNormalizer(PROJECT).iteration(
        {"iteration": 1, "time_ns": 0, "tree": [{**STEP, "component": "Field", "values": {"ball": 1.0}}]}
    )
    assert dict(outside.steps[0].fields) == {"by": "", "link": "root", "worked": "true"}


def test_the_components_with_errors_are_compared() -> None:
    raised = normalized({}, errors=[{"component": "Lamp"}, {"component": "Board"}])
    assert raised.errors == ("Lamp", "Board")
    assert normalized({}, errors=None).errors == ()
    found = TraceDifference(index=0, component="", field="errors", values=("Lamp, Board", ""))
    assert first_difference([raised], [normalized({})]) == found


def step(component: str = "Lamp", **values: str) -> TraceStep:
    return TraceStep(component=component, fields={"link": "root", **values})


FIRST = TraceIteration(number=1, time_ns=0, steps=(step(state="A"), step("Arm")), shared={"Board.total": "1"})


@pytest.mark.parametrize(
    ("other", "component", "field", "values"),
    [
        (replace(FIRST, time_ns=5), "", "time", ("0", "5")),
        (replace(FIRST, shared={}), "", "Board.total", ("1", "")),
        (replace(FIRST, shared={"Board.total": "1", "Board.a": "2"}), "", "Board.a", ("", "2")),
        (replace(FIRST, steps=FIRST.steps[:1]), "Arm", "component", ("Arm", "")),
        (replace(FIRST, steps=(*FIRST.steps, step("Leg"))), "Leg", "component", ("", "Leg")),
        (replace(FIRST, steps=(step("Leg"), step("Arm"))), "Lamp", "component", ("Lamp", "Leg")),
        (replace(FIRST, steps=(step(state="B"), step("Arm"))), "Lamp", "state", ("A", "B")),
        (replace(FIRST, steps=(step(), step("Arm"))), "Lamp", "state", ("A", "")),
        (replace(FIRST, steps=(step(state="A", done="true"), step("Arm"))), "Lamp", "done", ("", "true")),
    ],
)
def test_the_first_difference_is_told(
    other: TraceIteration, component: str, field: str, values: tuple[str, str]
) -> None:
    expected = TraceDifference(index=1, component=component, field=field, values=values)
    assert first_difference([FIRST, FIRST, FIRST], [FIRST, other, FIRST]) == expected


def test_a_trace_that_ends_early_differs_there() -> None:
    assert first_difference([FIRST], [FIRST]) is None
    for pair, counts in (((1, 3), ("1 iterations", "3 iterations")), ((2, 1), ("2 iterations", "1 iterations"))):
        expected = TraceDifference(index=1, component="", field="length", values=counts)
        assert first_difference([FIRST] * pair[0], [FIRST] * pair[1]) == expected


FULL = TraceIteration(
    number=1,
    time_ns=0,
    shared={"Board.x": "-0.0"},
    errors=("Lamp",),
    steps=tuple(
        TraceStep(
            component=component,
            fields={
                "link": link,
                "worked": "true",
                "transition": "t",
                "done": "true",
                "state": "A",
                "parameters.speed": "-0.0",
                "values.n": "3",
            },
        )
        for component, link in (("Lamp", "root"), ("Arm", "requires"), ("Leg", "call"), ("Leg", "call"))
    ),
)


@pytest.mark.parametrize("language", ["python", "cpp"])
def test_languages_without_limits_are_compared_in_all_parts(language: str) -> None:
    assert reduce_for(language, [FULL]) == [FULL]


def test_the_simulator_is_compared_without_the_ids_of_transitions() -> None:
    (reduced,) = reduce_for("simulator", [FULL])
    assert [set(FULL.steps[0].fields) - set(each.fields) for each in reduced.steps] == [{"transition"}] * 4
    assert (reduced.errors, reduced.shared) == (("Lamp",), {"Board.x": "-0.0"})
    assert reduced.steps[0].fields["parameters.speed"] == "-0.0"


def test_xabsl_is_compared_without_what_its_engine_does_not_have() -> None:
    (reduced,) = reduce_for("xabsl", [FULL])
    assert (reduced.errors, reduced.shared) == ((), {"Board.x": "0.0"})
    common = {"state": "A", "parameters.speed": "0.0"}
    assert [(each.component, dict(each.fields)) for each in reduced.steps] == [
        ("Lamp", {"link": "root", **common, "values.n": "3"}),
        ("Leg", {"link": "call", **common}),
        ("Leg", {"link": "call", **common, "values.n": "3"}),
    ]


@pytest.mark.parametrize(
    ("language", "large_at", "explains"),
    [("xabsl", 0, True), ("xabsl", 1, True), ("xabsl", 2, False), ("cpp", 0, False)],
)
def test_large_ints_explain_a_difference_from_then_on(language: str, large_at: int, explains: bool) -> None:
    trace = [replace(FIRST, had_large_ints=index >= large_at) for index in range(4)]
    limit = large_ints_limit(language, trace, TraceDifference(index=1, component="", field="", values=("", "")))
    assert (limit is not None) == explains
    assert (
        large_ints_limit(language, [FIRST], TraceDifference(index=0, component="", field="", values=("", ""))) is None
    )
    if limit is not None:
        assert (limit.language, limit.part) == (language, "large ints")
