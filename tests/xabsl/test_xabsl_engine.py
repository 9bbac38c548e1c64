"""The engine with custom worlds: behavior that the traces of the original engine do not cover."""

import json
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

import vicode.xabsl.engine
from tests.xabsl.xabsl_cases import CASES, load_texts
from vicode.xabsl.compiler import compile_source, declared_symbols
from vicode.xabsl.engine import (
    CodeError,
    Engine,
    LoadError,
    Program,
    SymbolList,
    SymbolListError,
    read_code,
    read_symbols,
)
from vicode.xabsl.engine.replay import ReplayError, read_rows, replay, replay_team

SYMBOLS = """namespace symbols("Symbols") {
  enum side { left, right };
  float input ball.distance;
  bool input ball.seen;
  enum side input ball.side;
  float input add(float x; float y;);
  enum side input other(enum side of;);
  float output speed;
  bool output led;
  enum side output chosen;
  float internal count;
}
"""
ACTS = (
    'namespace acts("Acts") {\n  behavior walk { float speed; enum side foot; bool fast; }\n  behavior stand { }\n}\n'
)


def compiled(*options: str, agents: str = 'agent main("Main", main);\n') -> tuple[Program, SymbolList]:
    """Compile options, the first of them named main."""
    files = {"symbols.xabsl": SYMBOLS, "acts.xabsl": ACTS}
    files |= {f"option{number}.xabsl": text + "\n" for number, text in enumerate(options)}
    files["agents.xabsl"] = "".join(f'include "{name}";\n' for name in files) + agents
    result = compile_source(load_texts(files))
    assert result.program, [(finding.location, finding.message) for finding in result.findings]
    return result.program, declared_symbols(result.table)


@dataclass
class Robot:
    """A world with attributes, functions and basic behaviors."""

    ball_distance: float = 1000.0
    ball_side: str = "right"
    speed: float = 0.0
    led: bool = False
    chosen: str = "left"
    now: int = 0
    calls: list[Any] = field(default_factory=list)

    @property
    def ball_seen(self) -> bool:
        return self.ball_distance < 500

    def add(self, x: float, y: float) -> float:
        return x + 2 * y

    def other(self, of: str) -> str:
        return {"left": "right", "right": "left"}[of]

    def walk(self, speed: float, foot: str, fast: bool) -> None:
        self.calls.append((speed, foot, fast))

    def stand(self) -> None:
        self.calls.append("stand")


def make_engine(*options: str, robot: Robot | None = None, **more: Any) -> tuple[Engine, Robot]:
    world = robot or Robot()
    program, symbols = compiled(*options)
    return Engine(program, world, symbols=symbols, clock=lambda: world.now, **more), world


def test_symbols_are_attributes_and_methods_and_behaviors_are_called() -> None:
    engine, robot = make_engine(
        """option main {
  initial state far { decision { if (ball.seen) goto near; else stay; } action { walk(speed = ball.distance / 10); } }
  state near { action { chosen = other(of = ball.side); led = !led; speed = add(x = 1, y = 2); count = count + 1; } }
}"""
    )
    engine.execute()
    assert robot.calls == [(100.0, "left", False)]
    robot.ball_distance = 3
    robot.ball_side = "left"
    engine.execute()
    assert (robot.chosen, robot.led, robot.speed) == ("right", True, 5.0)
    assert [view.state for view in engine.active_options] == ["near"]


def test_state_time_and_option_time() -> None:
    engine, robot = make_engine(
        """option main {
  initial state one { decision { if (state_time >= 100) goto two; else stay; } action { speed = state_time; } }
  state two { action { speed = state_time; count = option_time; } }
}"""
    )
    observed = []
    for robot.now in (1000, 1050, 1100, 1130):
        engine.execute()
        observed.append((engine.options[0].state, robot.speed, engine.options[0].option_time))
    assert observed == [("one", 0.0, 0), ("one", 50.0, 50), ("two", 0.0, 100), ("two", 30.0, 130)]


def test_times_survive_a_wraparound_of_the_clock() -> None:
    engine, robot = make_engine("option main { initial state one { action { speed = state_time; } } }")
    for robot.now in (2**32 - 20, 2**32 + 30):
        engine.execute()
    assert robot.speed == 50


def test_calls_of_a_function_share_its_parameters() -> None:
    action = "speed = add(x = 1, y = add(x = 5, y = 6)); count = add(x = add(x = 5, y = 6), y = 1);"
    engine, robot = make_engine(f"option main {{ initial state one {{ action {{ {action} }} }} }}")
    engine.execute()
    # 5 + 2 × 17 instead of 1 + 2 × 17: the inner call overwrites the parameter x of the outer call.
    assert robot.speed == 39
    assert engine.memory.v0 == 19


def test_division_and_remainder_match_the_original() -> None:
    action = "speed = 1 / (ball.distance - 1000); count = -7.9 % 3.9;"
    engine, robot = make_engine(f"option main {{ initial state one {{ action {{ {action} }} }} }}")
    engine.execute()
    assert robot.speed == 1 / 0.0000001
    assert engine.memory.v0 == -1
    engine, robot = make_engine("option main { initial state one { action { speed = 5 % (ball.distance - 1000); } } }")
    engine.execute()
    assert robot.speed == 0


def test_a_conditional_expression_of_bools() -> None:
    engine, robot = make_engine("option main { initial state one { action { led = ball.seen ? led : true; } } }")
    engine.execute()
    assert robot.led is True


def test_an_option_not_called_in_a_cycle_restarts() -> None:
    main = """option main {
  initial state with { decision { if (state_time > 30) goto without; else stay; } action { sub(x = 1); } }
  state without { decision { goto with; } action { stand(); } }
}"""
    sub = """option sub { float @x;
  initial state s { decision { if (state_time >= 20) goto t; else stay; } action { speed = @x; } }
  target state t { action { speed = 7; } }
}"""
    engine, robot = make_engine(main, sub)
    observed = []
    for robot.now in range(0, 120, 20):
        engine.execute()
        observed.append([view.state for view in engine.active_options])
    assert observed == [["with", "s"], ["with", "t"], ["without"], ["with", "s"], ["with", "t"], ["without"]]


TWICE = (
    """option main {
  initial state one { action { sub(); sub(); } }
}""",
    "option sub { initial state s { decision { goto t; } action { count = count + 1; } } state t { action { } } }",
)


def test_two_executions_in_a_cycle_are_reported_and_run() -> None:
    engine, _robot = make_engine(*TWICE)
    engine.execute()
    assert engine.errors_occurred
    assert 'option "sub" is executed multiple times' in engine.errors[0]
    engine.reset()
    assert not engine.errors_occurred


def test_strict_engines_reject_double_activation() -> None:
    with pytest.raises(LoadError, match="another possible activation tree"):
        make_engine(*TWICE, strict=True)


def test_the_load_error_lists_all_missing_symbols() -> None:
    program, symbols = compiled(
        "option main { initial state one { action { walk(speed = 1); speed = ball.distance; } } }"
    )
    fewer = SymbolList(symbols=tuple(symbol for symbol in symbols.symbols if symbol.name != "ball.distance"))
    with pytest.raises(LoadError) as caught:
        Engine(program, Robot(), symbols=fewer)
    assert set(caught.value.problems) == {
        "decimal input symbol ball.distance is not registered",
        "basic behavior walk is not registered",
    }
    with pytest.raises(LoadError, match="the world has no ball_distance"):
        Engine(program, object(), symbols=symbols)


def test_agents_and_roots() -> None:
    agents = 'agent main("Main", main);\nagent other("Other", other);\n'
    program, symbols = compiled(
        "option main { initial state one { action { speed = 1; } } }",
        "option other { float @x; initial state one { action { speed = @x; } } }",
        agents=agents,
    )
    robot = Robot()
    engine = Engine(program, robot, symbols=symbols)
    assert not engine.select("unknown")
    engine.execute()
    assert (engine.agent, robot.speed) == ("main", 1)
    assert engine.select("other")
    engine.execute()
    assert robot.speed == 0
    engine.set_root("other", x=4.0)
    engine.add_root("walk", speed=9.0, foot="left", fast=True)
    engine.execute()
    assert (robot.speed, robot.calls) == (4, [(9.0, "left", True)])


def test_the_engine_runs_without_a_symbol_list() -> None:
    program, _symbols = compiled(
        "option main { initial state one { action { walk(speed = ball.distance, fast = true); } } }"
    )
    calls: list[dict[str, Any]] = []
    engine = Engine(program, Robot(), behaviors={"walk": lambda **arguments: calls.append(arguments)})
    engine.execute()
    assert calls == [{"speed": 1000.0, "fast": True}]


COOPERATIVE = """option main {
  initial state wait { decision { if (ball.seen) goto ready; else stay; } action { speed = 0; } }
  state ready synchronized 2 { decision { goto kick; } action { speed = 1; } }
  state kick capacity 1 { decision { if (conflict) goto wait; else stay; } action { speed = 2; } }
}"""


def test_synchronized_and_capacity_states_of_a_team() -> None:
    program, symbols = compiled(COOPERATIVE)
    columns = ["time", *(f"{robot}:ball.seen" for robot in range(3))]
    rows = [",".join(columns)] + [f"{20 * number},{int(number > 1)},{int(number > 5)},0" for number in range(20)]
    _header, *lines = [json.loads(line) for line in replay_team(program, symbols, read_rows(rows), 3, 2)]
    states = [[line["tree"][0]["state"] for line in lines if line["robot"] == robot] for robot in range(3)]
    # Robot 2 executes the option but never wants to enter, so no robot becomes ready.
    assert states[2] == ["wait"] * 20
    assert not any("ready" in robot for robot in states)
    rows = [",".join(columns)] + [f"{20 * number},{int(number > 1)},{int(number > 5)},1" for number in range(20)]
    _header, *lines = [json.loads(line) for line in replay_team(program, symbols, read_rows(rows), 3, 2)]
    states = [[line["tree"][0]["state"] for line in lines if line["robot"] == robot] for robot in range(3)]
    entered = [robot.index("ready") for robot in states]
    # The last robot also waits for answers, so all enter within one cycle. Only one at a time may kick.
    assert max(entered) - min(entered) <= 1
    assert all(sum(robot[cycle] == "kick" for robot in states) <= 1 for cycle in range(20))
    assert states[2][-1] == "kick"


def test_a_copy_of_the_folder_runs_without_vicode(tmp_path: Path) -> None:
    shutil.copytree(Path(vicode.xabsl.engine.__file__).parent, tmp_path / "engine")
    program = CASES / "programs" / "drive_circle"
    script = f"""
import sys
sys.path.insert(0, {str(tmp_path)!r})
from engine import Engine, read_code

class World:
    amount_turned = 0
    def turn(self, speed): print("turn", speed)
    def halt(self): print("halt")

engine = Engine(read_code(open({str(program / "intermediate.dat")!r}).read()), World())
engine.execute()
World.amount_turned = 400
engine.execute()
assert not any(name.startswith("vicode") for name in sys.modules)
"""
    run = subprocess.run([sys.executable, "-I", "-c", script], capture_output=True, text=True, check=False)
    assert (run.stdout, run.stderr) == ("turn 45.0\nhalt\n", "")


@pytest.mark.parametrize(
    "text",
    [
        *("", "x", "0 0 1 o 0 1 s n s 0 0 t", "0 0 1 o 0 1 s n s 0 1 d x q", "0 0 1 o 0 1 s z s 0 0 t s 0"),
        "0 0 1 o 0 1 s n s 0 1 d x v one t s 0",
        "0 0 1 o 0 1 s n s 0 0 " + "i ! " * 500,
    ],
)
def test_invalid_code_is_rejected(text: str) -> None:
    with pytest.raises(CodeError, match="word "):
        read_code(text)


@pytest.mark.parametrize("text", ["0 0 1 o 0 1 s n s 0 0 t nowhere 0", "0 0 1 o 0 1 s n s 0 1 o o2 0 t s 1 a unknown"])
def test_code_with_missing_states_or_options_does_not_load(text: str) -> None:
    with pytest.raises(LoadError, match=r"there is no option|has no state"):
        Engine(read_code(text), object())


def test_names_in_the_code_are_never_executed() -> None:
    expression = "__import__('os').system('true')"
    code = f"0 0 1 o 0 1 s n s 0 1 d {expression} i {expression} 0 t s 1 a o"
    with pytest.raises(LoadError, match="the world has no"):
        Engine(read_code(code), object())


@pytest.mark.parametrize("text", ["din", "din x 1 d", "enum e 2 a", "zin x 0", "bb b 1 d x y"])
def test_invalid_symbol_lists_are_rejected(text: str) -> None:
    with pytest.raises(SymbolListError, match="line 1: "):
        read_symbols(text)


@pytest.mark.parametrize(
    ("column", "message"),
    [
        ("ball.seen", "column ball.seen is for none of the robots 0 to 1; name it 0:ball.seen"),
        ("2:ball.seen", "column 2:ball.seen is for none of the robots 0 to 1; name it 0:ball.seen"),
    ],
)
def test_columns_of_a_team_name_a_robot(column: str, message: str) -> None:
    program, symbols = compiled(COOPERATIVE)
    with pytest.raises(ReplayError, match=f"^{re.escape(message)}$"):
        list(replay_team(program, symbols, read_rows([f"time,{column}", "0,1"]), 2, 0))


def test_columns_of_a_team_need_a_team() -> None:
    program, symbols = compiled(COOPERATIVE)
    with pytest.raises(ReplayError, match="add --team"):
        list(replay(program, symbols, read_rows(["time,0:ball.seen", "0,1"])))
