"""Generated XABSL compiles and behaves like the generated Python."""

import importlib
import itertools
import random
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.generators.code_tools import write_files
from tests.generators.portable_designs import portable_projects
from tests.strategies.designs import designs, projects
from tests.xabsl.xabsl_cases import load_texts
from vicode import regions
from vicode.bica import Component, Root, SimulatedClock
from vicode.check import check_project
from vicode.findings import Severity, render_text
from vicode.generators import UnsoundDesignError, generate, list_origins, list_outputs, python_class_path
from vicode.model.design import (
    CommonSection,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    State,
    Stay,
    Transition,
)
from vicode.model.project import Project
from vicode.model.traversal import find_decision
from vicode.xabsl.compiler import CompileResult, compile_source, declared_symbols
from vicode.xabsl.engine import Engine
from vicode.xabsl.parser import parse
from vicode.xabsl.printer import print_file

_NUMBERS = itertools.count()
# Warnings that random designs may cause: unreachable states, numbers out of range, duplicate calls.
EXPECTED_WARNINGS = {"X643", "X645", "X646", "X647"}


def texts_of(project: Project) -> dict[str, str]:
    """Generate the XABSL files of a project, by path relative to its folder."""
    folder = next(path for path in list_outputs(project, languages=["xabsl"]) if path.endswith("/agents.xabsl"))
    root = folder.removesuffix("agents.xabsl")
    return {file.path.removeprefix(root): file.text for file in generate(project, languages=["xabsl"])}


def compiled_of(project: Project) -> CompileResult:
    return compile_source(load_texts(texts_of(project)))


@given(portable_projects())
def test_sound_designs_compile(project: Project) -> None:
    errors = [finding for finding in check_project(project) if finding.severity is Severity.ERROR]
    assert not errors, render_text(errors)
    result = compiled_of(project)
    bad = [
        finding
        for finding in result.findings
        if finding.severity is not Severity.NOTE and finding.rule.code not in EXPECTED_WARNINGS
    ]
    assert not bad, render_text(bad)
    assert not any(
        finding.rule.code in ("X651", "X652") for finding in result.findings if project.designs[0].arithmetic == ""
    )
    assert result.program is not None
    assert result.program.title == "Law"


@given(portable_projects())
def test_files_are_formatted_and_have_a_header(project: Project) -> None:
    files = generate(project, languages=["xabsl"])
    assert [file.path for file in files] == sorted(list_outputs(project, languages=["xabsl"]))
    for file in files:
        assert regions.has_header(file.text)
        assert print_file(parse(file.text).file) == file.text
    assert files == generate(project, languages=["xabsl"])


def option_of(transitions: tuple[Decision, ...], common: tuple[Decision, ...] = ()) -> str:
    """Generate an option, with whitespace collapsed."""
    names = ("a", "b", "c", "d", "e")
    design = Design(
        component="One",
        initial="S",
        variables=(*(Declaration(name=name, type="bool") for name in names), *map(number, "nm")),
        common=CommonSection(transitions=common),
        states=(State(name="S", transitions=transitions), *(State(name=name) for name in "XYZ")),
    )
    project = Project(name="Law", languages=("xabsl",), designs=(design,))
    assert not [finding for finding in check_project(project) if finding.severity is Severity.ERROR]
    assert compiled_of(project).program is not None
    return " ".join(texts_of(project)["Options/One.xabsl"].replace("one.", "").split())


def number(name: str) -> Declaration:
    return Declaration(name=name, type="float")


def to(state: str, when: str = "") -> Transition:
    return Transition(to=state, guard=Guard(when=when))


def test_groups_that_fall_through_are_flattened() -> None:
    inner = DecisionGroup(guard=Guard(when="b"), then=(to("X", "c"),), otherwise=(to("Y", "d"),))
    text = option_of((DecisionGroup(guard=Guard(when="a"), then=(inner,), otherwise=()), to("Z", "e")))
    assert "decision { if (a && b && c) goto X; else if (a && !b && d) goto Y; else if (e) goto Z; else stay; }" in text


def test_the_description_of_a_flattened_group_stays() -> None:
    group = DecisionGroup(guard=Guard(when="a"), then=(to("X", "b"), to("Y", "c")), doc="Only with a.")
    assert "decision { /** Only with a. */ if (a && b)" in option_of((group, to("Z", "e")))


def test_groups_that_always_end_stay_nested() -> None:
    group = DecisionGroup(guard=Guard(when="a"), then=(to("X", "b"), Stay()), otherwise=(to("Y", "c"),))
    text = option_of((group, to("Z")))
    assert "decision { if (a) { if (b) goto X; else stay; } else if (c) goto Y; else goto Z; }" in text


def test_common_decisions_are_common_where_xabsl_can_express_them() -> None:
    ending = DecisionGroup(guard=Guard(when="a"), then=(to("X", "b"), to("Y")))
    text = option_of((to("Z", "c"),), (ending, to("X", "d")))
    assert "common decision { if (a) { if (b) goto X; else goto Y; } else if (d) goto X; }" in text
    assert "initial state S { decision { else if (c) goto Z; else stay; }" in text
    text = option_of((to("Z", "c"),), (Stay(guard=Guard(when="a")), to("X", "d")))
    assert "common" not in text
    assert "initial state S { decision { if (a) stay; else if (d) goto X; else if (c) goto Z; else stay; }" in text
    assert "state X { decision { if (a) stay; else if (d) goto X; else stay; }" in text


@given(projects, st.lists(designs, max_size=2))
def test_any_project_is_generated_or_rejected(project: Project, some: list[Design]) -> None:
    unique = {design.component: design for design in some}
    combined = replace(project, languages=("xabsl",), designs=tuple(unique.values()))
    paths = list_outputs(combined)
    assert len({path.casefold() for path in paths}) == len(paths)
    assert all(path.startswith("xabsl/") and ".." not in path.split("/") for path in paths)
    errors = [finding for finding in check_project(combined) if finding.severity is Severity.ERROR]
    try:
        files = generate(combined)
    except UnsoundDesignError:
        assert errors
        return
    assert {file.path for file in files} == set(paths)


@pytest.mark.parametrize(
    ("when", "xabsl"),
    [
        ("min(n, m) > 1", "(m < n ? m : n) > 1"),
        ("max(n, m) > 1", "(m > n ? m : n) > 1"),
        ("clamp(n, 1, m) > 1", "(n < 1 ? 1 : (m < n ? m : n)) > 1"),
        ("sign(n) > -1", "(n > 0 ? 1 : (n < 0 ? -1 : 0)) > -1"),
        ("abs(-n) > 1e-3", "(-n < 0 ? -(-n) : -n) > 0.001"),
        ("is_nan(float(n))", "n != n"),
        ("a == b", "(a && b) || (!a && !b)"),
        ("a != b", "(a && !b) || (!a && b)"),
        ("b if a else c", "(a && b) || (!a && c)"),
        ("0 < n < m == 3", "0 < n && n < m && m == 3"),
        ("a and b or not (c or d)", "(a && b) || !(c || d)"),
        ("(n - (m - 1)) * 2 / 4 > -(n + m)", "(n - (m - 1)) * 2 / 4 > -(n + m)"),
        ("component_time > 2 and state_time < 3", "option_time / 1000 > 2 && state_time / 1000 < 3"),
    ],
)
def test_expressions_are_translated(when: str, xabsl: str) -> None:
    assert f"initial state S {{ decision {{ if ({xabsl}) goto X;" in option_of((to("X", when),))


class World:
    """The world of both programs: Python uses the names of the design, XABSL the symbol names."""

    def __init__(self) -> None:
        self.log: list[dict[str, Any]] = []
        self.seen = self.eyes_seen = False
        self.distance = self.eyes_distance = 0.0
        self.side = self.eyes_side = "left"
        self.led = self.eyes_led = False

    def bearing(self, x: float, y: float) -> float:
        return x - 2 * y + self.distance / 100

    eyes_bearing = bearing

    def legs(self, speed: float, side: str) -> None:
        self.log.append({"speed": speed, "side": side})

    Legs = legs

    def sense(self, *, seen: bool, distance: float, side: str) -> None:
        self.log.clear()
        self.seen = self.eyes_seen = seen
        self.distance = self.eyes_distance = distance
        self.side = self.eyes_side = side


@pytest.fixture(scope="module")
def folder() -> Iterator[Path]:
    """Folder that generated Python is imported from."""
    with tempfile.TemporaryDirectory() as name:
        sys.path.insert(0, name)
        yield Path(name)
        sys.path.remove(name)


def main_of(project: Project, folder: Path) -> Root:
    """Generate Python and create its root."""
    renamed = replace(project, name=f"law{next(_NUMBERS)}")
    write_files(generate(renamed, languages=["python"]), folder / renamed.name)
    sys.path.insert(0, str(folder / renamed.name / "python"))
    try:
        importlib.invalidate_caches()
        module, _colon, name = python_class_path(renamed, "Player").partition(":")
        return Root(
            getattr(importlib.import_module(module), name), clock=SimulatedClock(), world=World(), on_error="stop"
        )
    finally:
        sys.path.pop(0)


@given(portable_projects(), st.integers(0, 10_000))
def test_both_programs_behave_the_same(folder: Path, project: Project, seed: int) -> None:
    root, rng = main_of(project, folder), random.Random(seed)
    result = compiled_of(project)
    assert result.program is not None
    world, now = World(), SimpleNamespace(ms=0)
    engine = Engine(result.program, world, symbols=declared_symbols(result.table), clock=lambda: now.ms)
    components = {type(component).__name__: component for component in root.components}
    for iteration in range(14):
        if iteration:
            step = rng.choice((1, 10, 30, 60))
            root.clock.advance(step * 1_000_000)  # type: ignore[attr-defined]
            now.ms += step
        sensed = {
            "seen": rng.random() < 0.5,
            "distance": rng.choice((-5.0, 0.0, 2.0, 300.0)),
            "side": rng.choice(SIDES),
        }
        for target in (world, root.world):
            target.sense(**sensed)
        root.step()
        engine.execute()
        assert states_of(engine, components) == []
        assert known(values_of(engine)) == known(values_in(components, engine))
        assert [known(dict(entry)) for entry in world.log] == [known(dict(entry)) for entry in root.world.log]
        assert world.eyes_led == root.world.led


SIDES = ("left", "right")


def states_of(engine: Engine, components: dict[str, Component]) -> list[str]:
    """List the active components whose states differ."""
    return [
        f"{view.name}: {view.state} in XABSL, {components[view.name].state} in Python"
        for view in engine.active_options
        if view.state != components[view.name].state
    ]


def values_of(engine: Engine) -> dict[str, Any]:
    slots = engine.program.symbols
    return {slot.name: getattr(engine.memory, f"v{number}") for number, slot in enumerate(slots)}


def values_in(components: dict[str, Component], engine: Engine) -> dict[str, Any]:
    """Return the values of the symbols in Python; elements of enumerations as names."""
    values = {}
    for slot in engine.program.symbols:
        owner, _dot, name = slot.name.partition(".")
        value = getattr(components[owner.capitalize()], name)
        values[slot.name] = getattr(value, "name", value)
    return values


def known(values: dict[str, Any]) -> dict[str, Any]:
    """Replace nan, which is not equal to itself."""
    return {name: "nan" if value != value else value for name, value in values.items()}  # noqa: PLR0124


@given(portable_projects())
def test_origins_of_decisions_lie_inside_those_of_their_state(project: Project) -> None:
    for design in project.designs:
        text = texts_of(project)[f"Options/{design.component}.xabsl"]
        lines = text.split("\n")
        origins = list_origins(project, design.component, "xabsl", text)
        states = {origin.path[1]: origin for origin in origins if len(origin.path) == 2 and origin.path[0] == "states"}
        assert set(states) == {state.name for state in design.states if not state.disabled}
        for origin in origins:
            assert 1 < origin.first <= origin.last < len(lines)
            located = find_decision(design, origin.path)
            if located is None:
                continue
            block = "\n".join(lines[origin.first - 1 : origin.last])
            target = getattr(located.decision, "to", located.source)
            assert "stay;" in block if target == located.source else f"goto {target};" in block
            if located.source in states:
                outer = states[located.source]
                assert outer.first <= origin.first <= origin.last <= outer.last
