"""docs/ros2.md: the robot of the page drives."""

import os
import random
import re
import subprocess
import sys
from pathlib import Path

import pytest

from vicode.cli import main

HOME = Path(__file__).parents[2]
PAGE = HOME / "docs" / "ros2.md"
FILES = re.findall(r"^```(?:yaml|python) (\S+)\n(.*?)^```$", PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL)


def test_the_robot_of_the_page_turns_at_a_wall(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, text in FILES:
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ROS_DOMAIN_ID", str(random.randint(100, 200)))
    monkeypatch.delenv("CYCLONEDDS_URI", raising=False)
    assert main(["check", "."]) == 0
    environment = {**os.environ, "PYTHONPATH": str(HOME)}
    command = [
        sys.executable,
        "-m",
        "vicode",
        "run",
        "scout.yaml",
        "--profile",
        "ros2",
        "--real-time",
        "--seconds",
        "40",
    ]
    with (
        subprocess.Popen([sys.executable, "turtle.py"], stdout=subprocess.DEVNULL, env=environment) as robot,
        subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as run,
    ):
        try:
            assert run.stdout is not None
            changes = []
            for line in run.stdout:
                changes.append(line.split(": ")[-1].strip())
                if line.endswith("Turn → Go\n"):
                    break
        finally:
            run.terminate()
            robot.kill()
    assert changes == ["Wait", "Wait → Go", "Go → Turn", "Turn → Go"]
