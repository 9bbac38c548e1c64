"""`vicode sim`: options, summary, errors."""

import re
import sys
from pathlib import Path

import pytest

from tests.simulated_robot.fake_bridge import fake_bridge_thread
from vicode.cli import main


def test_lock_step_ends_with_a_summary(capsys: pytest.CaptureFixture[str]) -> None:
    with fake_bridge_thread() as port:
        assert main(["sim", "room", "--port", str(port), "--robots", "2", "--lock-step", "--seconds", "14"]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[0].startswith("robot 1: ")
    assert printed[1].endswith("0 contacts, stop")
    assert printed[2].startswith("14.0 s simulated in ")


def test_in_real_time_state_changes_are_printed(capsys: pytest.CaptureFixture[str]) -> None:
    with fake_bridge_thread() as port:
        assert main(["sim", "arena", "--port", str(port), "--seconds", "0.3", "--view"]) == 0
    printed = capsys.readouterr().out
    assert "The world is shown at http://127.0.0.1:" in printed
    assert "robot 1: turn" in printed


def test_a_map_of_the_user_is_read(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "hall.yaml"
    path.write_text("vicode: 1\nwalls:\n  - [[2, -1], [2, 1]]\ngoals:\n  - {at: [0, 0], radius: 1}\n")
    with fake_bridge_thread() as port:
        assert main(["sim", str(path), "--port", str(port), "--lock-step", "--until-goal"]) == 0
    assert "at a goal" in capsys.readouterr().out
    path.write_text("vicode: 1\nwalls:\n  - [2, -1]\n")
    assert main(["sim", str(path)]) == 1
    assert f"{path}:3:6: error" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["nowhere"], "no map 'nowhere'; name a file, or one of: arena, bent, room, straight, t, two_rooms"),
        (["room", "--port", "1"], "nothing listens on 127.0.0.1:1; start 'vicode bridge DESIGN' first"),
        (["room", "--jxi", "--lock-step"], "JXI has no lock step; leave out --jxi or --lock-step"),
    ],
)
def test_errors_are_one_line(arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sim", *arguments]) == 2
    assert capsys.readouterr().err == f"vicode: {message}\n"


def test_own_sensors_and_a_world_of_the_bridge(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "path", [*sys.path])
    page = (Path(__file__).parents[2] / "docs" / "experiments.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    (tmp_path / "sonar.py").write_text(example, encoding="utf-8")
    (tmp_path / "heading.py").write_text(
        'from vicode.bridge import Sensor, World\n\nclass Heading(World):\n    ins = Sensor("INS", float, length=3)\n'
    )
    for arguments, targets in (
        (["--robot", "sonar:SonarRobot"], {"SONAR", "BUMPS"}),
        (["--world", "heading:Heading"], {"INS"}),
    ):
        received: list[str] = []
        with fake_bridge_thread(received) as port:
            options = ["--port", str(port), "--path", str(tmp_path), "--jxi", "--seconds", "0.2"]
            assert main(["sim", "room", *options, *arguments]) == 0
        names = {line.partition(":")[0] for line in received if line}
        assert names - {"ROBOT", "ACK"} == targets
    capsys.readouterr()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--robot", "nowhere:Robot"], "cannot load nowhere:Robot"),
        (
            ["--robot", "vicode.bridge:World"],
            "vicode.bridge:World is not a RobotModel; derive it from vicode.simulated",
        ),
        (
            ["--world", "vicode.bridge:Sensor"],
            "vicode.bridge:Sensor is not a World; derive it from vicode.bridge.world",
        ),
    ],
)
def test_robots_that_cannot_be_loaded(arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sim", "room", *arguments]) == 2
    assert message in capsys.readouterr().err
