"""The generated Python of an imported behavior behaves like the XABSL engine in every cycle."""

import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.importers.differential_harness import compare_runs, compare_team_runs
from tests.strategies.xabsl_behaviors import behaviors
from tests.xabsl.xabsl_cases import CASES, PROGRAMS, load_texts
from vicode.xabsl import tree
from vicode.xabsl.compiler import compile_source
from vicode.xabsl.printer import print_file
from vicode.xabsl.source_loader import load_source

WRITTEN = [path for path in os.environ.get("VICODE_XABSL_BEHAVIORS", "").split(":") if path]

NESTED = """
namespace symbols("Symbols") {
  float input two(float a; float b;);
  bool input is(float a; bool b;);
  float input x;
  float output out;
  bool output flag;
}
"""
NESTING = """
option main {
  initial state run {
    decision { if (two(a = 1, b = two(a = 5, b = x)) > 10) goto rest; else stay; }
    action {
      out = two(a = 1, b = x > 0 ? two(a = 2) : 3);
      flag = is(b = is(a = 3), a = x);
    }
  }
  state rest {
    decision { if (is(a = 1, b = !is(a = x, b = true))) goto run; else stay; }
    action { out = two(b = two(b = two(a = 7))); }
  }
}
"""
TOGETHER = """
option main {
  initial state wait {
    decision {
      if (wants_ball) goto handle;
      else if (wants_pass) goto pass;
      else stay;
    }
    action { out = 0; }
  }
  state handle capacity 1 {
    decision {
      if (conflict) goto wait;
      else if (wants_ball) stay;
      else goto wait;
    }
    action { out = 1; support(); }
  }
  state pass synchronized 2 {
    decision { if (wants_pass) stay; else goto wait; }
    action { out = 2; }
  }
}
"""
SUPPORT = """
option support {
  common decision { if (wants_pass) goto near; }
  initial state far { decision { else if (wants_ball) goto near; else stay; } action { out = 3; } }
  state near synchronized { action { out = 4; } }
}
"""
TEAM = """
namespace symbols("Symbols") {
  bool input wants_ball;
  bool input wants_pass;
  float output out;
}
"""


def agents(*files: str) -> str:
    return "".join(f'include "{file}";\n' for file in files) + 'agent one("One", main);\n'


@pytest.mark.parametrize("program", PROGRAMS)
def test_programs_behave_the_same(program: str, tmp_path: Path) -> None:
    source = load_source(CASES / "programs" / program / "agents.xabsl")
    compiled = compile_source(source)
    assert compiled.program is not None
    for number, (agent, _root) in enumerate(compiled.program.agents[:2]):
        compare_runs(source, tmp_path / str(number), agent, count=150, seed=number)


@given(behaviors(with_functions=True), st.integers(0, 1000))
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_random_behaviors_behave_the_same(
    tmp_path_factory: pytest.TempPathFactory, files: dict[str, tree.FileNode], seed: int
) -> None:
    source = load_texts({name: print_file(file) for name, file in files.items()})
    compare_runs(source, tmp_path_factory.mktemp("behavior"), "main", count=15, seed=seed)


def test_nested_call_overwrites_earlier_arguments(tmp_path: Path) -> None:
    texts = {"agents.xabsl": agents("symbols.xabsl", "main.xabsl"), "symbols.xabsl": NESTED, "main.xabsl": NESTING}
    assert compare_runs(load_texts(texts), tmp_path, "one", count=300) == 300


def test_teams_cooperate_the_same_way(tmp_path: Path) -> None:
    texts = {
        "agents.xabsl": agents("symbols.xabsl", "main.xabsl", "support.xabsl"),
        "symbols.xabsl": TEAM,
        "main.xabsl": TOGETHER,
        "support.xabsl": SUPPORT,
    }
    seen = compare_team_runs(load_texts(texts), tmp_path, "one", robots=3, count=400)
    assert {"handle", "pass", "wait", "far", "near"} <= seen


@pytest.mark.parametrize("path", WRITTEN or [str(CASES / "programs" / "drive_circle" / "agents.xabsl")])
def test_complete_behaviors_behave_the_same(path: str, tmp_path: Path) -> None:
    source = load_source(Path(path))
    compiled = compile_source(source)
    assert compiled.program is not None
    for number, (agent, _root) in enumerate(compiled.program.agents):
        compare_runs(source, tmp_path / str(number), agent, count=3000 if number == 0 else 300, seed=number)
