"""Imported names, comments, groups and declarations, and their files."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import pytest

from tests.importers.differential_harness import import_checked
from tests.xabsl.xabsl_cases import CASES, PROGRAMS, load_texts
from vicode.findings import DesignPath
from vicode.importers import PlacedComment
from vicode.model.design import Assign, Call, DecisionGroup, Design, Stay, Transition
from vicode.model.project import INTERNAL, WORLD, Project
from vicode.store import add_comments, read_design, read_project_file, save_design, save_project_file
from vicode.xabsl.source_loader import load_source

SYMBOLS = """
/*** Title: ignored here */
namespace ball.symbols("The ball") {
  /** where it is */
  enum ball.side { left, right.most, _initial };
  float const near = -12.50 "mm"; // nearer than this
  float const patience = 300. "ms";
  /** how far */
  float input ball.distance [0..9000] "mm";
  float input ball.odd [mm];
  bool input class;
  float input x;
  bool input x;
  enum ball.side input _seen;
  float input angle(float to.x [-1..1]; enum ball.side side;);
  float output speed "mm/s";
  enum ball.side internal memory;
}
"""
ACTS = """
namespace acts("What it does") {
  /** go there */
  behavior go.to { float to.x "mm"; bool fast; }
  behavior main { }
}
"""
MAIN = """
/*** what the file is */
/** plays */
option main {
  /** how far */ float @reach [0..10] "m";
  bool @near;
  common decision {
    /** all is lost */
    if (state_time >= patience) goto lost;
  }
  common action { speed = 1; }
  // looks around
  // for the ball
  initial state search.all {
    decision {
      else {
        // is it near?
        if (ball.distance < 100 && !class) {
          if (state_time >= 20 && @near) goto lost;
          /** otherwise */
          else stay;
        }
        else if (angle(to.x = 0.5) > 1 || state_time >= near) goto search.all;
        else stay;
      }
    }
    action {
      speed = speed + 1; // faster
      memory = right.most;
      speed = -@reach;
      go.to(to.x = ball.odd, fast = true);
      main behavior();
      helper(@a = 1, side = memory);
    }
  }
  //state old {
  //  action { go.to(); }
  //}
  target state lost { action { } }
}
"""
HELPER = """
option helper {
  float @a;
  enum ball.side @side;
  initial state only { decision { if (@side == _initial) stay; else stay; } action { } }
}
"""


def pairs(comments: Iterable[PlacedComment]) -> list[tuple[DesignPath, str]]:
    return [(comment.path, comment.text) for comment in comments]


def texts() -> dict[str, str]:
    files = {
        "Symbols/ball.xabsl": SYMBOLS,
        "Symbols/acts.xabsl": ACTS,
        "Options/main.xabsl": MAIN,
        "Options/Skills/helper.xabsl": HELPER.replace("@a =", "a ="),
    }
    files["Options/main.xabsl"] = files["Options/main.xabsl"].replace("@a = 1", "a = 1")
    agents = "/*** Title: Ball player\n Platform: none\n Written in a night. */\n"
    agents += "".join(f'include "{file}";\n' for file in files)
    return {**files, "agents.xabsl": agents + '/** the one */ agent player.one("A player", main);\n// the end\n'}


@pytest.fixture(scope="module")
def project() -> Project:
    return import_checked(load_texts(texts()))[0].project


@pytest.fixture(scope="module")
def main(project: Project) -> Design:
    design = project.design("main")
    assert design is not None
    return design


def test_declarations_become_enumerations_constants_and_components(project: Project) -> None:
    (side,) = project.enumerations
    assert (side.name, side.xabsl_name, side.doc, side.internal) == ("ball_side", "ball.side", "where it is", False)
    assert side.element_names == ("left", "right_most", "initial_")
    assert side.xabsl_elements == (("right_most", "right.most"), ("initial_", "_initial"))
    near, patience = project.constants
    assert (near.name, near.initial, near.unit) == ("near", "-12.50", "mm")
    assert (patience.name, patience.initial) == ("patience", "300.0")
    by_name = project.interfaces()
    ball, kept = by_name["ball_symbols"], by_name["ball_symbols_internal"]
    assert (ball.implementation, ball.title, ball.xabsl_name) == (WORLD, "The ball", "ball.symbols")
    assert [(output.name, output.xabsl_name, output.type) for output in ball.outputs] == [
        ("ball_distance", "ball.distance", "float"),
        ("ball_odd", "ball.odd", "float"),
        ("class_", "class", "bool"),
        ("x", "x", "float"),
        ("x_2", "x", "bool"),
        ("seen", "_seen", "ball_side"),
        ("angle", "angle", "float"),
    ]
    assert ball.outputs[0].range == (0, 9000)
    assert (ball.outputs[1].range, ball.outputs[1].doc) == (None, "[mm]")
    assert [output.xabsl_name for output in ball.outputs[-1].arguments or ()] == ["to.x", ""]
    assert [variable.name for variable in ball.variables] == ["speed"]
    assert kept.implementation == INTERNAL
    assert [(variable.name, variable.type) for variable in kept.variables] == [("memory", "ball_side")]


def test_option_and_basic_behavior_with_the_same_name_are_two_components(project: Project, main: Design) -> None:
    assert main.component == "main"
    behavior = next(component for component in project.components if component.xabsl_name == "main")
    assert behavior.component == "main_2"
    calls = [action for action in main.states[0].actions if isinstance(action, Call)]
    used = {use.alias: use.component for use in main.uses}
    assert [used[call.alias] for call in calls] == ["go_to", "main_2", "helper"]


def test_agents_have_titles(project: Project) -> None:
    (agent,) = project.agents
    assert (agent.name, agent.xabsl_name, agent.title, agent.doc, agent.root) == (
        "player_one",
        "player.one",
        "A player",
        "the one",
        "main",
    )
    assert project.doc == "Ball player\nPlatform: none\nWritten in a night."


def test_nested_decisions_become_groups(main: Design) -> None:
    state = main.states[0]
    assert (state.name, state.xabsl_name, state.doc) == ("search_all", "search.all", "looks around\nfor the ball")
    near, far = state.transitions
    assert isinstance(near, DecisionGroup)
    assert near.guard.when == "ball_symbols.ball_distance < 100 and not ball_symbols.class_"
    first, second = near.then
    assert isinstance(first, Transition)
    assert (first.guard.after, first.guard.when) == ("20", "near_2")
    assert isinstance(second, Stay)
    assert second.doc == "otherwise"
    assert isinstance(far, Transition)
    assert (far.to, far.guard.when) == ("search_all", "ball_symbols.angle(to_x=0.5) > 1 or state_time >= near")
    (lost,) = main.common.transitions
    assert isinstance(lost, Transition)
    assert (lost.guard.after, lost.guard.when, lost.doc) == ("patience", "", "all is lost")
    assert main.states[1].final


def test_actions_keep_their_order(main: Design) -> None:
    first, second, *calls = main.states[0].actions
    assert first == Assign(
        values=(
            ("ball_symbols.speed", "ball_symbols.speed + 1"),
            ("ball_symbols_internal.memory", "ball_side.right_most"),
        )
    )
    assert second == Assign(values=(("ball_symbols.speed", "-reach"),))
    assert [call.arguments for call in calls if isinstance(call, Call)] == [
        (("to_x", "ball_symbols.ball_odd"), ("fast", "True")),
        (),
        (("a", "1"), ("side", "ball_symbols_internal.memory")),
    ]


def test_files_contain_every_comment() -> None:
    imported, _compiled = import_checked(load_texts(texts()))
    text = add_comments(save_project_file(imported.project), pairs(imported.comments), is_project_file=True)
    for words in ("nearer than this", "namespace acts: What it does", "the end", "Title: ignored here"):
        assert words in text
    for design, imported_design in zip(imported.project.designs, imported.designs, strict=True):
        written = add_comments(save_design(design), pairs(imported_design.comments))
        assert read_design(written).design == design
        if design.component == "main":
            assert imported_design.path == "Options/main.yaml"
            for line in ("# what the file is", "# is it near?", "# faster", "#  action { go.to(); }"):
                assert line in written
            lines = [line.strip() for line in written.splitlines()]
            assert lines[lines.index("# is it near?") + 1].startswith("- when: ball_symbols.ball_distance")
            assert lines.index("# state old {") < lines.index("lost: {final: true}")


@pytest.mark.parametrize("program", PROGRAMS)
def test_files_load_as_the_imported_project(program: str) -> None:
    source = load_source(CASES / "programs" / program / "agents.xabsl")
    imported, _compiled = import_checked(source)
    again, _ = import_checked(source)
    assert again == imported
    text = add_comments(save_project_file(imported.project), pairs(imported.comments), is_project_file=True)
    assert read_project_file(text).project == replace(imported.project, designs=())
    for design, imported_design in zip(imported.project.designs, imported.designs, strict=True):
        read = read_design(add_comments(save_design(design), pairs(imported_design.comments)))
        assert read.findings == ()
        assert read.design == design


def test_comments_do_not_change_the_content_of_a_file(tmp_path: Path) -> None:
    text = "vicode: 1\ncomponent: X\nmodule: |\n  one\n  two\ninitial: a\nstates: {a: {}}\n"
    marked = add_comments(text, [(("module",), "about the module"), (("states", "a"), "evil: {\n\x00 }"), ((), "top")])
    assert read_design(marked).design == read_design(text).design
    assert marked.startswith("# top\n")
    assert "# about the module\nmodule: |" in marked
