"""vicode run: a fresh process plays, we watch; Ctrl-C ends both."""

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.command_runner import LAMP, lamps, vicode
from vicode.semantics import Interpreter
from vicode.store import open_project

__all__ = ["lamps"]

PROGRAM = "import sys; from vicode.cli import main; sys.exit(main())"
HOME = str(Path(__file__).parents[2])


def start(*arguments: str) -> "subprocess.Popen[str]":
    environment = {**os.environ, "PYTHONPATH": HOME}
    command = [sys.executable, "-c", PROGRAM, "run", *arguments]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)


def test_changes_of_state_and_a_summary_are_printed(lamps: Path) -> None:
    process = start("lamps/lamp.yaml", "--seconds", "0.5")
    out, err = process.communicate(timeout=60)
    assert (process.returncode, err) == (0, "")
    lines = out.splitlines()
    assert lines[:5] == [
        "    0.00 s  Lamp: Dark",
        "    0.10 s  Lamp: Dark → Lit",
        "    0.10 s  Bulb: On",
        "    0.30 s  Lamp: Lit → Dark",
        "    0.40 s  Lamp: Dark → Lit",
    ]
    assert re.search(r"^0\.4\d s in 25 iterations, stopped: limit, last state: Lit$", out, re.MULTILINE)
    assert re.search(r"^Bulb +\d+ ", out, re.MULTILINE)
    assert lines[-1] == "errors: 0"


def test_a_trace_has_values_when_they_are_asked_for(lamps: Path) -> None:
    process = start("lamps/lamp.yaml", "--ticks", "2", "--trace", "trace", "--values")
    process.communicate(timeout=60)
    assert "values" in json.loads(Path("trace").read_text().splitlines()[1])["tree"][0]


def test_a_robot_without_a_team_enters_the_states_that_it_would_coordinate(lamps: Path) -> None:
    design = """vicode: 1
component: Lift
initial: Wait
states:
  Wait: {transitions: [{to: Up, when: "true"}]}
  Up: {synchronized: 1, transitions: [{to: Down, after: 0.2}]}
  Down: {capacity: 1, transitions: [{to: Wait, when: team_size == 1}]}
"""
    Path("lift").mkdir()
    Path("lift/lift.yaml").write_text(design, encoding="utf-8")
    process = start("lift/lift.yaml", "--ticks", "12", "--tick-ms", "100", "--trace", "trace")
    process.communicate(timeout=60)
    records = [json.loads(line) for line in Path("trace").read_text().splitlines()[1:-1]]
    robot = Interpreter(open_project(Path("lift")).project, "Lift")
    expected = [robot.step(number * 100_000_000)["tree"][0]["state"] for number in range(12)]
    assert [record["tree"][0]["state"] for record in records] == expected
    assert set(expected) == {"Wait", "Up", "Down"}


def test_the_same_seed_gives_the_same_trace(lamps: Path) -> None:
    for name in ("one", "two"):
        process = start("lamps/lamp.yaml", "--ticks", "40", "--seed", "3", "--trace", name)
        process.communicate(timeout=60)
        assert process.returncode == 0
    assert Path("one").read_bytes() == Path("two").read_bytes()
    assert json.loads(Path("one").read_text().splitlines()[1])["tree"][0]["component"] == "Lamp"


def test_an_interrupt_ends_it_with_a_summary(lamps: Path) -> None:
    process = start("lamps/lamp.yaml", "--real-time")
    assert process.stdout is not None
    assert process.stdout.readline() == "    0.00 s  Lamp: Dark\n"
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "stopped: interrupted" in out
    assert err == "stopping after this iteration; press Ctrl-C again to stop immediately\n"


def test_a_termination_closes_the_world(lamps: Path) -> None:
    with (lamps / "project.yaml").open("a", encoding="utf-8") as file:
        file.write("world: own:World\n")
    text = "class World:\n    is_open = True\n    def close(self):\n        self.is_open = False\n"
    (lamps / "own.py").write_text(f"{text}    def summary(self):\n        return self.is_open\n", encoding="utf-8")
    process = start("lamps/lamp.yaml", "--real-time")
    assert process.stdout is not None
    process.stdout.readline()
    process.terminate()
    out, _err = process.communicate(timeout=60)
    assert process.returncode == 143
    assert "stopped: interrupted" in out
    assert "world: False" in out


def test_failing_code_is_told_and_counted(lamps: Path) -> None:
    (lamps / "lamp.yaml").write_text(LAMP.replace("self.count = 1", "self.count = 1 / 0"), encoding="utf-8")
    process = start("lamps/lamp.yaml", "--seconds", "0.1")
    out, err = process.communicate(timeout=60)
    assert process.returncode == 1
    assert "errors: 1\n" in out
    assert "lamp.yaml" in err
    assert "ZeroDivisionError" in err


def test_what_cannot_start_is_told(lamps: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert vicode("run", "lamps") == 2
    assert "specify the design to run" in capfd.readouterr().err
    with (lamps / "project.yaml").open("a", encoding="utf-8") as file:
        file.write("world: nowhere:World\n")
    assert vicode("run", "lamps/lamp.yaml", "--ticks", "1") == 2
    assert "nowhere" in capfd.readouterr().err
    (lamps / "lamp.yaml").write_text(LAMP.replace("to: Lit", "to: Lot"), encoding="utf-8")
    assert vicode("run", "lamps/lamp.yaml") == 1
    assert "D402" in capfd.readouterr().err


def test_components_without_an_implementation_keep_their_initial_values(tmp_path: Path) -> None:
    components = "{Sensors: {outputs: {order_given: {type: bool}}}}"
    (tmp_path / "project.yaml").write_text(f"vicode: 1\nproject: Lamps\ncomponents: {components}\n")
    design = "vicode: 1\ncomponent: Waiter\nuses: {sensors: Sensors}\ninitial: Wait\nstates:\n"
    design += "  Wait: {transitions: [{to: Go, when: sensors.order_given}]}\n  Go: {final: true}\n"
    (tmp_path / "waiter.yaml").write_text(design)
    process = start(str(tmp_path), "--ticks", "5")
    out, err = process.communicate(timeout=60)
    assert process.returncode == 0
    assert "last state: Wait" in out
    assert out.splitlines()[-1] == "errors: 0"
    assert "P209 not-implemented: 'Sensors' has no implementation: its outputs keep their initial values" in err


def test_a_class_that_differs_from_its_declaration_does_not_start(
    lamps: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with (lamps / "project.yaml").open("a") as project:
        project.write("components:\n  Eye: {implementation: 'eyes:Eye', outputs: {seen: bool}}\n")
    design = LAMP.replace("Bulb}", "Bulb, eye: Eye}").replace("Dark:\n", "Dark:\n    requires: [eye]\n", 1)
    (lamps / "lamp.yaml").write_text(design.replace("after: 0.2", "when: eye.seen"))
    (lamps / "eyes.py").write_text("from vicode.bica import Component\n\n\nclass Eye(Component):\n    sees = True\n")
    assert vicode("check", "lamps") == 0
    problem = "eyes.py:4:1: warning P212 different-class: 'Eye' has no attribute 'seen'"
    assert problem in capsys.readouterr().out
    assert vicode("run", "lamps/lamp.yaml") == 1
    assert problem in capsys.readouterr().err
    assert vicode("run", "lamps/bulb.yaml", "--ticks", "1") == 0


def test_control_needs_viewers(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("run", "lamps/lamp.yaml", "--control") == 2
    assert "--control has no effect without --watch" in capsys.readouterr().err


def test_a_world_of_the_bridge_is_not_run_alone(capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("run", f"{HOME}/designs/meeting/meet.yaml") == 2
    assert "meet needs the world of a bridge; start it with: vicode bridge" in capsys.readouterr().err
