"""Origins of lines of generated C++ match the content of the lines."""

from pathlib import Path

import pytest

from vicode.generators import Origin, component_generator, list_origins
from vicode.model.design import Design, Transition
from vicode.model.project import Project
from vicode.model.traversal import find_decision, iter_transitions
from vicode.regions import find_regions
from vicode.store import open_project

ROOT = Path(__file__).parents[2]
PROJECTS = {name: open_project(ROOT / "designs" / name).project for name in ("forward", "rescue")}
DESIGNS = [
    pytest.param(project, design, id=design.component) for project in PROJECTS.values() for design in project.designs
]


def source_of(project: Project, design: Design) -> tuple[str, tuple[Origin, ...]]:
    code = component_generator(project, "cpp", {})(design)
    assert code is not None
    return code.file.text, code.origins


@pytest.mark.parametrize(("project", "design"), DESIGNS)
def test_the_lines_of_a_decision_contain_its_target(project: Project, design: Design) -> None:
    text, origins = source_of(project, design)
    lines, found = text.split("\n"), 0
    for origin in origins:
        located = find_decision(design, origin.path)
        if located is None or not isinstance(located.decision, Transition):
            continue
        block = "\n".join(lines[origin.first - 1 : origin.last])
        if located.decision.to != located.source:
            assert f"change_to(State::{located.decision.to}" in block
        assert block.count("return") == 1
        found += 1
    # States with the same decisions share their lines.
    assert found == len(list(iter_transitions(design)))


@pytest.mark.parametrize(("project", "design"), DESIGNS)
def test_a_region_belongs_to_its_code(project: Project, design: Design) -> None:
    text, origins = source_of(project, design)
    for region in find_regions(text, "//").regions:
        innermost = [origin for origin in origins if origin.first <= region.line <= origin.last][-1]
        assert innermost.last >= region.end_line, region.id


def test_states_and_comments() -> None:
    project = PROJECTS["forward"]
    design = project.design("Player")
    assert design is not None
    text, origins = source_of(project, design)
    lines = text.split("\n")
    first = {origin.path: lines[origin.first - 1].strip() for origin in reversed(origins)}
    assert first["states", "Kick"] == "case State::Kick:"
    assert first["states", "LookForBall", "transitions", 0] == "// ball seen"
    assert first["common", "transitions", 0] == "// fallen"
    assert first["states", "Kick", "enter", 1, "code"].startswith("void Player::do_kick_enter(")
    assert set(design.states) == {state for state in design.states if ("states", state.name) in first}


def test_sections_of_a_header() -> None:
    text = "// <vicode module 00000000>\n#include <cstdio>\n// </vicode>\n"
    (origin,) = list_origins(PROJECTS["forward"], "Player", "cpp", text)
    assert (origin.path, origin.first, origin.last) == (("module",), 1, 3)


def test_other_texts_have_no_origins() -> None:
    assert list_origins(PROJECTS["forward"], "Player", "cpp", "class {\n") == ()
