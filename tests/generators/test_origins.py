"""Which lines come from which thing: what stands in them says the same, in shipped and in random designs."""

import re
from pathlib import Path

import pytest
from hypothesis import given

from tests.generators.sound_designs import project_of, sound_designs
from vicode.generators import Origin, generate, list_origins
from vicode.model.design import Design, Transition
from vicode.model.project import Project
from vicode.model.traversal import find_decision
from vicode.store import open_project

ROOT = Path(__file__).parents[2]
FORWARD = open_project(ROOT / "designs" / "forward").project


def text_of(project: Project, component: str) -> str:
    """The module of a component."""
    others = {design.component for design in project.designs} - {component}
    whole = {file.path: file.text for file in generate(project, components=(component,), exclude=others)}
    shared = {file.path for file in generate(project, components=(component,), exclude={*others, component})}
    (text,) = (text for path, text in whole.items() if path not in shared)
    return text


def assert_lines_say_it(project: Project, component: str) -> int:
    """Every decision's lines hold its target, inside the lines of its state; how many there are."""
    text = text_of(project, component)
    lines, design = text.split("\n"), project.design(component)
    assert design is not None
    origins = list_origins(project, component, "python", text)
    states = {origin.path[1]: origin for origin in origins if origin.path[0] == "states" and len(origin.path) == 2}
    enabled = {state.name for state in design.states if not state.disabled}
    assert set(states) == enabled
    count = 0
    for origin in origins:
        assert 1 <= origin.first <= origin.last <= len(lines)
        located = find_decision(design, origin.path)
        if located is None:
            continue
        count += 1
        block = "\n".join(lines[origin.first - 1 : origin.last])
        if isinstance(located.decision, Transition) and located.decision.to != located.source:
            assert f'self._change_to("{located.decision.to}"' in re.sub(r"\(\s+", "(", block)
        else:
            assert "self._stay()" in block
        assert located.source not in states or is_inside(origin, states[located.source])
    return count


def is_inside(inner: Origin, outer: Origin) -> bool:
    return outer.first <= inner.first and inner.last <= outer.last


@pytest.mark.parametrize("component", [design.component for design in FORWARD.designs])
def test_the_shipped_designs(component: str) -> None:
    assert_lines_say_it(FORWARD, component)


def test_the_player_in_full() -> None:
    assert assert_lines_say_it(FORWARD, "Player") == 16
    text = text_of(FORWARD, "Player")
    lines = text.split("\n")
    found = {origin.path: lines[origin.first - 1].strip() for origin in list_origins(FORWARD, "Player", "python", text)}
    assert found["states", "Kick"].startswith("def _in_kick(")
    assert found["states", "Kick", "enter"] == "def _enter_kick(self) -> None:"
    assert found["states", "LookForBall", "transitions", 0] == "# ball seen"
    assert found[("module",)].startswith("# <vicode module")
    assert found["common", "transitions", 0] == "# fallen"


@given(sound_designs())
def test_random_designs(design: Design) -> None:
    assert_lines_say_it(project_of(design), design.component)


def test_a_text_that_is_no_module_has_no_origins() -> None:
    assert list_origins(FORWARD, "Player", "python", "def (") == ()
    assert list_origins(FORWARD, "Nobody", "python", "") == ()
