"""docs/ros2.md: the robot of the page drives, in simulated time and without a network."""

import copy
import importlib
import re
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from vicode.bica import Root, ros_session
from vicode.cli import main
from vicode.generators import generate
from vicode.model.project import select_profile
from vicode.output import apply_diffs, compare_files
from vicode.store import open_project

PAGE = Path(__file__).parents[2] / "docs" / "ros2.md"
FILES = re.findall(r"^```(?:yaml|python) (\S+)\n(.*?)^```$", PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL)
LONGEST_S = 60.0


class Topics:
    """A session whose topics stay in this process."""

    def __init__(self) -> None:
        self.types: dict[str, str] = {}
        self.messages: dict[str, Any] = {}

    def reader(self, topic: str, type_: str, *, is_expected: bool = True) -> Any:
        assert self.types.setdefault(topic, type_) == type_
        return SimpleNamespace(take=lambda _now_ns: self.messages.pop(topic, None))

    def writer(self, topic: str, type_: str, *, latched: bool = False) -> Callable[[Any], None]:
        assert self.types.setdefault(topic, type_) == type_
        return lambda message: self.messages.update({topic: copy.deepcopy(message)})


class Clock:
    """Not the clock of `vicode run` in simulated time, which topics refuse."""

    seconds = 0.0

    def now_ns(self) -> int:
        return round(self.seconds * 1e9)


def test_the_robot_of_the_page_turns_at_a_wall(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, text in FILES:
        (tmp_path / name).write_text(text, encoding="utf-8")
    assert main(["check", str(tmp_path)]) == 0
    project = select_profile(open_project(tmp_path).project, "ros2")
    apply_diffs(compare_files(generate(project), tmp_path), tmp_path)
    monkeypatch.syspath_prepend(tmp_path / "python")
    topics, clock, states = Topics(), Clock(), [""]
    monkeypatch.setattr(ros_session, "open_session", lambda: topics)
    with Root(importlib.import_module("scout.scout").Scout, clock=clock) as root:

        def step(seconds: float) -> None:
            clock.seconds += seconds
            root.step()
            states.extend([root.main.state] * (root.main.state != states[-1]))
            if states[-2:] == ["Turn", "Go"] or clock.seconds > LONGEST_S:
                raise StopIteration

        step(0.0)
        # The program of the page sleeps between its steps.
        monkeypatch.setattr(time, "sleep", step)
        with pytest.raises(StopIteration):
            exec(dict(FILES)["turtle.py"], {})
    assert states == ["", "Wait", "Go", "Turn", "Go"]
    assert topics.messages["/Scout/states"].data == "Scout.Go"
