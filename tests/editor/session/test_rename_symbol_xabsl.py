"""Rename symbol in hand-written C++ and XABSL: renamed where certain, else listed."""

from pathlib import Path

import pytest

from vicode.editor.session import Library, Workspace
from vicode.editor.session.project.renames import apply_component_rename, apply_symbol_rename
from vicode.model.design import Design
from vicode.model.rename import SymbolRef
from vicode.model.traversal import iter_code
from vicode.services.rename.component import plan_component_rename
from vicode.services.rename.symbol import SymbolRenamePlan, plan_symbol_rename

PROJECT = """\
vicode: 1
project: Team
languages: [xabsl]
enumerations:
  Side: [left, right]
  Foot: [left, both]
constants:
  far: {value: 300, unit: mm}
components:
  Legs:
    implementation: world
    parameters:
      speed: {type: float}
      side: {type: Side}
    outputs:
      near: {type: bool}
      reach: {type: float, arguments: {x: {type: float}}}
"""
WALK = """\
vicode: 1
component: Walk
uses: {legs: Legs}
parameters:
  pace: {type: float, default: 1}
outputs:
  done_so_far: {type: float, initial: 0}
initial: Go
states:
  Go:
    actions:
      - code:
          xabsl: |
            walk.done_so_far = walk.done_so_far + @pace; // walk.done_so_far
            Legs(speed = @pace + far, side = Side.right);
          cpp: |
            this->done_so_far += this->pace; // pace
            log("pace", pace);
    transitions:
      - {to: Go, code: {xabsl: "legs.near && legs.reach(x = far) > far", cpp: "this->legs->near && far > 2"}}
"""
MAIN = """\
vicode: 1
component: Main
uses: {walk: Walk, legs: Legs}
initial: On
states:
  On:
    actions:
      - code:
          xabsl: |
            Walk(pace = 2);
            Legs(speed = 1, side = left);
          cpp: |
            this->walk->pace = Side::left;
    transitions:
      - {to: On, code: {xabsl: "walk.done_so_far > far", cpp: "this->walk.done_so_far > 1"}}
"""


@pytest.fixture
def workspace(tmp_path: Path) -> Workspace:
    for name, text in (("project", PROJECT), ("walk", WALK), ("main", MAIN)):
        (tmp_path / f"{name}.yaml").write_text(text)
    return Library(tmp_path).workspaces[0]


def make_plan(workspace: Workspace, symbol: SymbolRef, new: str) -> SymbolRenamePlan:
    plan = plan_symbol_rename(workspace, symbol, new)
    assert plan.error == ""
    return plan


def rename(workspace: Workspace, symbol: SymbolRef, new: str) -> tuple[str, SymbolRenamePlan]:
    """Rename a symbol; returns all code of the project, and the plan."""
    plan = make_plan(workspace, symbol, new)
    assert apply_symbol_rename(workspace, plan) == ""
    return "\n".join(code_of(design) for design in workspace.project.designs), plan


def code_of(design: Design) -> str:
    return "\n".join(text for placed in iter_code(design) for _language, text in placed.code.texts)


def test_a_parameter_is_renamed_in_calls_and_expressions(workspace: Workspace) -> None:
    code, plan = rename(workspace, SymbolRef(component="Walk", section="parameters", name="pace"), "tempo")
    assert "walk.done_so_far + @tempo; // walk.done_so_far" in code
    assert "Legs(speed = @tempo + far, side = Side.right)" in code
    assert "Walk(tempo = 2)" in code
    assert "this->done_so_far += this->tempo; // pace" in code
    assert 'log("pace", pace);' in code
    assert "this->walk->tempo = Side::left;" in code
    assert plan.ambiguous_places == ("Walk: action 1 of state Go, C++",)


def test_an_output_is_renamed_as_a_symbol(workspace: Workspace) -> None:
    symbol = SymbolRef(component="Walk", section="outputs", name="done_so_far")
    code, plan = rename(workspace, symbol, "way")
    assert "walk.way = walk.way + @pace; // walk.done_so_far" in code
    assert "walk.way > far" in code
    assert "this->walk.way > 1" in code
    assert plan.ambiguous_places == ()
    # And back, to the same bytes.
    files = {
        design.component: file.read_text()
        for design in workspace.project.designs
        for file in [workspace.files[design.component]]
    }
    back, _plan = rename(workspace, SymbolRef(component="Walk", section="outputs", name="way"), "done_so_far")
    assert "walk.way" not in back
    assert files != {"Walk": WALK, "Main": MAIN}
    assert {name: workspace.files[name].read_text() for name in files} == {"Walk": WALK, "Main": MAIN}


def test_an_element_of_two_enumerations_is_ambiguous(workspace: Workspace) -> None:
    code, plan = rename(workspace, SymbolRef(section="elements", owner="Side", name="left"), "west")
    assert "side = left" in code
    assert "this->walk->pace = Side::west;" in code
    assert plan.ambiguous_places == ("Main: action 1 of state On, XABSL",)
    code, plan = rename(workspace, SymbolRef(section="elements", owner="Side", name="right"), "east")
    assert "side = Side.east" in code
    assert plan.ambiguous_places == ()


def test_constants_and_function_arguments_are_renamed(workspace: Workspace) -> None:
    code, plan = rename(workspace, SymbolRef(section="constants", name="far"), "afar")
    assert "legs.reach(x = afar) > afar" in code
    assert "@pace + afar" in code
    # A name by itself may be anything in C++.
    assert "this->legs->near && far > 2" in code
    assert plan.ambiguous_places == ("Walk: transition 1 of state Go, C++",)
    symbol = SymbolRef(component="Legs", section="arguments", owner="reach", name="x")
    code, _plan = rename(workspace, symbol, "ahead")
    assert "legs.reach(ahead = afar) > afar" in code
    code, _plan = rename(workspace, SymbolRef(section="components", name="Legs"), "Feet")
    assert "Feet(speed = @pace + afar, side = Side.right)" in code
    assert "feet.near && feet.reach(ahead = afar) > afar" in code


def test_invalid_code_is_ambiguous(workspace: Workspace, tmp_path: Path) -> None:
    (tmp_path / "walk.yaml").write_text(WALK.replace("@pace; //", "@pace ; ) //"))
    workspace.sync_from_disk()
    plan = make_plan(workspace, SymbolRef(component="Walk", section="outputs", name="done_so_far"), "way")
    assert plan.ambiguous_places == ("Walk: action 1 of state Go, XABSL, 2 times",)


def test_a_component_is_renamed_as_an_option(workspace: Workspace, tmp_path: Path) -> None:
    plan = plan_component_rename(workspace, "Walk", "GoAhead")
    assert [change.summary for change in plan.changes] == [
        "component Walk → GoAhead; walk.yaml is renamed to go_ahead.yaml",
        "Main uses GoAhead as walk",
    ]
    assert apply_component_rename(workspace, plan) == ""
    assert "go_ahead.done_so_far = go_ahead.done_so_far + @pace" in (tmp_path / "go_ahead.yaml").read_text()
    assert "GoAhead(pace = 2);" in (tmp_path / "main.yaml").read_text()
    back = plan_component_rename(workspace, "GoAhead", "Walk")
    assert apply_component_rename(workspace, back) == ""
    assert (tmp_path / "main.yaml").read_text() == MAIN
    assert (tmp_path / "walk.yaml").read_text() == WALK
