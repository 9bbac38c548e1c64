"""`vicode sim`: options, summary, errors."""

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
