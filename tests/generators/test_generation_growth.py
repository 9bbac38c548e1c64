"""Checking and generating a project twice as big runs each line of the product twice as often, not four times.

Lines are counted rather than seconds: the machine and its load do not matter, and a failure names the line.
"""

import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

import vicode
from vicode.check import check_project
from vicode.findings import Severity
from vicode.generators import generate
from vicode.model.design import (
    Assign,
    Call,
    Code,
    CommonSection,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.project import Enumeration, Interface, Project

_SIZE = 24
_COUNTED = (str(Path(vicode.__file__).parent), "<string>")
"""The files of the product, and the methods of its dataclasses."""
_LEGS = Interface(
    component="Legs", implementation="parts:Legs", parameters=(Declaration(name="speed", type="float", initial="1"),)
)
_EYES = Interface(component="Eyes", implementation="parts:Eyes", outputs=(Declaration(name="seen", type="bool"),))
_OTHER = Design(component="Other", initial="A", states=(State(name="A", final=True),))
_COUNT = Declaration(name="count", type="int")


def _code(text: str) -> Code:
    return Code(texts=(("python", text),))


def _project(*designs: Design, interfaces: tuple[Interface, ...] = (_LEGS, _EYES), **declared: Any) -> Project:
    return Project(name="Scaled", components=interfaces, designs=designs, **declared)


def _machine(*states: State, common: CommonSection | None = None, **values: Any) -> Design:
    uses = tuple(Use(alias=each.lower(), component=each) for each in ("Legs", "Eyes", "Other"))
    return Design(
        component="Machine",
        uses=values.pop("uses", uses),
        outputs=(_COUNT, *values.pop("outputs", ())),
        initial=states[0].name,
        common=common or CommonSection(),
        states=states,
        **values,
    )


def with_states(size: int) -> Project:
    """States that use only what all languages have."""

    def make_state(number: int) -> State:
        def to(offset: int, **guard: str) -> Transition:
            return Transition(to=f"S{(number + offset) % size}", guard=Guard(**guard), doc=f"Text {number}.")

        group = DecisionGroup(guard=Guard(when="eyes.seen"), then=(to(2, when="count > 1"), Stay()), otherwise=(to(3),))
        return State(
            name=f"S{number}",
            doc=f"State {number}.",
            final=number % 2 == 0,
            capacity=2 if number % 3 == 0 else None,
            actions=(
                Assign(values=(("count", f"count + {number}"),)),
                Call(alias="legs", arguments=(("speed", str(number)),)),
                Call(alias="other"),
            ),
            transitions=(to(1, when=f"count > {number}"), to(1, after=str(number + 1)), group),
        )

    return _project(_machine(*map(make_state, range(size))), _OTHER)


def with_code(size: int) -> Project:
    """States that use what Python and C++ have in addition."""

    def make_state(number: int) -> State:
        return State(
            name=f"S{number}",
            requires=("legs", "other") if number % 2 else ("legs",),
            enter=(Assign(values=(("count", f"count + {number}"),)),),
            leave=(Assign(values=(("count", f"count - {number}"),)),),
            actions=(RunCode(code=_code(f"self.count += {number}")),),
            transitions=(
                Transition(to=f"S{number}", guard=Guard(when="action_done and conflict")),
                Transition(to=f"S{(number + 1) % size}", guard=Guard(code=_code(f"return self.count > {number}"))),
            ),
        )

    return _project(_machine(*map(make_state, range(size)), frequency_hz=10.0), _OTHER)


def with_items_in_a_state(size: int) -> Project:
    """Many actions and transitions of one state, with code whose names collide."""
    calls = tuple(Call(alias="legs", arguments=(("speed", str(number)),)) for number in range(size))
    actions = tuple(RunCode(code=_code(f"self.count += {number}")) for number in range(size))
    code = tuple(_code(f"return self.count > {number}") for number in range(size))
    tests = tuple(Transition(to="B", guard=Guard(code=each)) for each in code)
    return _project(_machine(State(name="A", actions=(*calls, *actions), transitions=tests), State(name="B")), _OTHER)


def with_names(size: int) -> Project:
    """Many declarations, each of which is used."""
    numbers = range(size)
    outputs = [Declaration(name=f"o{each}", type="float") for each in numbers]
    sides = [Declaration(name=f"side{each}", type=f"Side{each}") for each in numbers]
    guard = Guard(when=" or ".join(f"(o{each} > c{each} and side{each} == Side{each}.left)" for each in numbers))
    actions = tuple(
        Assign(values=((f"o{each}", f"c{each} + 1"), (f"side{each}", f"Side{each}.right"))) for each in numbers
    )
    state = State(name="A", actions=actions, transitions=(Transition(to="B", guard=guard),))
    return _project(
        _machine(state, State(name="B"), outputs=(*outputs, *sides)),
        _OTHER,
        enumerations=tuple(Enumeration(name=f"Side{each}", elements=(("left", ""), ("right", ""))) for each in numbers),
        constants=tuple(Declaration(name=f"c{each}", initial=f"{each}.5") for each in numbers),
    )


def with_used_components(size: int) -> Project:
    """A state that steps and reads many components."""
    parts = [
        Interface(component=f"Part{each}", implementation=f"parts:Part{each}", outputs=_EYES.outputs)
        for each in range(size)
    ]
    uses = tuple(Use(alias=f"part{each}", component=f"Part{each}") for each in range(size))
    state = State(
        name="A",
        requires=tuple(use.alias for use in uses[::2]),
        actions=tuple(Call(alias=use.alias) for use in uses[1::2]),
        transitions=tuple(Transition(to="B", guard=Guard(when=f"{use.alias}.seen")) for use in uses),
    )
    return _project(_machine(state, State(name="B"), uses=uses), interfaces=tuple(parts))


def with_designs(size: int) -> Project:
    """Many designs; each second one steps the one before."""

    def make_design(number: int) -> Design:
        uses = (Use(alias="other", component=f"M{number - 1}"),) if number % 2 else ()
        states = (
            State(name="A", actions=tuple(Call(alias=use.alias) for use in uses), transitions=(Transition(to="B"),)),
            State(name="B"),
        )
        return Design(component=f"M{number}", uses=uses, initial="A", states=states)

    return _project(*map(make_design, range(size)), interfaces=())


PROJECTS = (with_states, with_code, with_items_in_a_state, with_names, with_used_components, with_designs)
IN_XABSL = (with_states, with_designs)
CASES = [
    *((make, language) for make in PROJECTS for language in ("check", "python", "cpp")),
    *((make, "xabsl") for make in IN_XABSL),
]


def work_on(project: Project, language: str) -> None:
    if language == "check":
        errors = [each for each in check_project(project) if each.severity is Severity.ERROR]
        assert not errors
    else:
        assert generate(project, languages=[language])


def count_lines(run: Callable[[], object]) -> Counter[tuple[str, str, int]]:
    """How often each line of the product is executed: file, function, line."""
    counts: Counter[tuple[str, str, int]] = Counter()

    def trace_line(frame: FrameType, event: str, _argument: object) -> Any:
        if event == "line":
            counts[frame.f_code.co_filename, frame.f_code.co_name, frame.f_lineno] += 1
        return trace_line

    def trace_call(frame: FrameType, _event: str, _argument: object) -> Any:
        return trace_line if frame.f_code.co_filename.startswith(_COUNTED) else None

    before = sys.gettrace()
    sys.settrace(trace_call)
    try:
        run()
    finally:
        sys.settrace(before)
    return counts


@pytest.mark.parametrize(("make", "language"), CASES, ids=lambda value: getattr(value, "__name__", value))
def test_work_grows_with_the_size_and_not_with_its_square(make: Callable[[int], Project], language: str) -> None:
    small, large = (count_lines(lambda size=size: work_on(make(size), language)) for size in (_SIZE, 2 * _SIZE))
    assert small
    assert [f"{line}: {small[line]} → {count}" for line, count in large.items() if count > 2.5 * small[line] + 50] == []
