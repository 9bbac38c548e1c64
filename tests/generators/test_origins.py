"""Origins of generated lines match the content of the lines, in shipped and random designs."""

import re
from pathlib import Path

import pytest
from hypothesis import given

from tests.generators.sound_designs import project_of, sound_designs
from vicode.generators import Origin, generate, list_origins
from vicode.model.design import Design, Transition
from vicode.model.project import Project
from vicode.model.traversal import find_decision
from vicode.regions import find_regions
from vicode.store import open_project

ROOT = Path(__file__).parents[2]
FORWARD = open_project(ROOT / "designs" / "forward").project


def text_of(project: Project, component: str) -> str:
    others = {design.component for design in project.designs} - {component}
    whole = {file.path: file.text for file in generate(project, components=(component,), exclude=others)}
    shared = {file.path for file in generate(project, components=(component,), exclude={*others, component})}
    (text,) = (text for path, text in whole.items() if path not in shared)
    return text


def assert_lines_say_it(project: Project, component: str) -> int:
    """Check that the lines of each decision contain its target and lie inside its state; return their number."""
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
def test_shipped_designs(component: str) -> None:
    assert_lines_say_it(FORWARD, component)


def test_player() -> None:
    assert assert_lines_say_it(FORWARD, "Player") == 16
    text = text_of(FORWARD, "Player")
    lines = text.split("\n")
    first_lines = {
        origin.path: lines[origin.first - 1].strip() for origin in list_origins(FORWARD, "Player", "python", text)
    }
    assert first_lines["states", "Kick"].startswith("def _in_kick(")
    assert first_lines["states", "Kick", "enter"] == "def _enter_kick(self) -> None:"
    assert first_lines["states", "LookForBall", "transitions", 0] == "# ball seen"
    assert first_lines[("module",)].startswith("# <vicode module")
    assert first_lines["common", "transitions", 0] == "# fallen"


@given(sound_designs())
def test_random_designs(design: Design) -> None:
    assert_lines_say_it(project_of(design), design.component)


@pytest.mark.parametrize("component", [design.component for design in FORWARD.designs])
def test_a_region_belongs_to_one_element_with_both_marks(component: str) -> None:
    text = text_of(FORWARD, component)
    origins = list_origins(FORWARD, component, "python", text)
    for region in find_regions(text).regions:
        innermost = [origin for origin in origins if origin.first <= region.line <= origin.last][-1]
        assert innermost.last >= region.end_line, region.id


def test_other_texts_have_no_origins() -> None:
    assert list_origins(FORWARD, "Player", "python", "def (") == ()
    assert list_origins(FORWARD, "Nobody", "python", "") == ()
