"""docs/on-your-robot.md: the components of an action and a service, with a fake of the calls of rclpy."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.bica.test_on_your_robot_page import BLOCKS, COURIER, PAGE
from vicode.generators import generate
from vicode.output import write_atomically
from vicode.store import open_project

COMPONENTS = re.search(
    r"^```yaml\n(components:\n  Navigate.*?)^```$", PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL
)
assert COMPONENTS is not None
PROJECT = f"vicode: 1\nproject: Couriers\n{COMPONENTS[1]}"
DESIGN = """\
vicode: 1
component: Courier
uses: {navigate: Navigate, gripper: Gripper}
initial: Drive
states:
  Drive:
    modulates: {navigate: {x: 2.0, y: 1.0}}
    transitions:
      - {to: Failed, when: navigate.has_failed}
      - {to: Grip, when: navigate.is_there}
      - {to: Near, when: navigate.distance < 1}
      - {to: Late, after: 0.2}
  Near: {transitions: [{to: Drive, after: 0.1}]}
  Grip:
    requires: [gripper]
    transitions: [{to: Done, when: gripper.is_closed}, {to: Failed, when: gripper.has_failed}]
  Done: {final: true}
  Failed: {final: true}
  Late: {final: true}
"""
FAKE = {
    "rclpy/__init__.py": """\
import scenario
init = try_shutdown = lambda: None
def spin(node):
    for line in scenario.play(node):
        print(line)
""",
    "rclpy/node.py": """\
import scenario
class Node:
    def __init__(self, name):
        self.name = name
    def create_timer(self, period_s, callback):
        self.timer = callback
    def create_client(self, type_, name):
        assert (type_.__name__, name) == ("SetBool", "close_gripper")
        return scenario.service
    def destroy_node(self):
        print("destroyed")
""",
    "rclpy/action.py": """\
import scenario
def ActionClient(node, type_, name):
    assert (node.name, type_.__name__, name) == ("courier", "NavigateToPose", "navigate_to_pose")
    return scenario.action
""",
    "action_msgs/msg.py": "class GoalStatus:\n    STATUS_SUCCEEDED, STATUS_ABORTED = 4, 6\n",
    "std_srvs/srv.py": """\
class SetBool:
    class Request:
        def __init__(self, data):
            self.data = data
""",
    "nav2_msgs/action.py": """\
from types import SimpleNamespace as Plain
class NavigateToPose:
    def Goal():
        return Plain(pose=Plain(header=Plain(), pose=Plain(position=Plain(), orientation=Plain())))
""",
    "scenario.py": """\
import sys
import time
from types import SimpleNamespace as Plain


class Future:
    def __init__(self):
        self.callbacks = []

    def add_done_callback(self, callback):
        self.callbacks.append(callback)

    def finish(self, result):
        for callback in self.callbacks:
            callback(Plain(result=lambda: result))


class Handle:
    def __init__(self, accepted=True):
        self.accepted, self.finished = accepted, Future()

    def get_result_async(self):
        return self.finished

    def cancel_goal_async(self):
        print("cancelled")


class Action:
    def __init__(self):
        self.is_ready, self.goals = False, []

    def server_is_ready(self):
        return self.is_ready

    def send_goal_async(self, goal, feedback_callback):
        position = goal.pose.pose.position
        print("goal", position.x, position.y)
        sent = Future()
        self.goals.append(Plain(sent=sent, feedback=feedback_callback))
        return sent


class Service:
    def __init__(self):
        self.requests = []

    def service_is_ready(self):
        return True

    def call_async(self, request):
        print("request", request.data)
        self.requests.append(Future())
        return self.requests[-1]


action, service = Action(), Service()


def play(node):
    root = node.root.main
    def step(count=2):
        for _number in range(count):
            node.timer()
    step()
    action.is_ready = True
    step()
    goal, name, handle = action.goals[0], (sys.argv + ["arrive"])[1], Handle()
    if name == "refused":
        goal.sent.finish(Handle(accepted=False))
    elif name == "late":
        while root.state == "Drive":
            step()
        goal.sent.finish(handle)
    else:
        goal.sent.finish(handle)
        goal.feedback(Plain(feedback=Plain(distance_remaining=0.5 if name == "near" else 5.0)))
        if name in ("near", "held"):
            step()
            yield root.state
            if name == "held":
                return
            # What an earlier goal says does not count.
            handle.finished.finish(Plain(status=4))
            while root.state == "Near":
                step()
            step(1)
            handle = Handle()
            action.goals[1].sent.finish(handle)
        handle.finished.finish(Plain(status=6 if name == "aborted" else 4))
        step(3)
        if name != "aborted":
            service.requests[0].finish(Plain(success=name != "stuck"))
    step(3)
    yield root.state
""",
}
LIMIT_S = 60


@pytest.fixture(scope="module")
def courier(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("courier")
    (folder / "designs").mkdir()
    (folder / "designs/project.yaml").write_text(PROJECT)
    (folder / "designs/courier.yaml").write_text(DESIGN)
    texts = {**FAKE, **{name: BLOCKS[name] for name in COURIER}}
    for file in generate(open_project(folder / "designs").project, standalone=True):
        texts[file.path.removeprefix("python/")] = file.text
    for path, text in texts.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        write_atomically(folder / path, text, is_durable=False)
    return folder


@pytest.mark.parametrize(
    ("scenario", "lines"),
    [
        ("arrive", ["goal 2.0 1.0", "request True", "Done"]),
        ("stuck", ["goal 2.0 1.0", "request True", "Failed"]),
        ("aborted", ["goal 2.0 1.0", "Failed"]),
        ("refused", ["goal 2.0 1.0", "Failed"]),
        ("near", ["goal 2.0 1.0", "cancelled", "Near", "goal 2.0 1.0", "request True", "Done"]),
        ("late", ["goal 2.0 1.0", "cancelled", "Late"]),
        ("held", ["goal 2.0 1.0", "Drive", "cancelled"]),
    ],
)
def test_an_action_and_a_service(courier: Path, scenario: str, lines: list[str]) -> None:
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    done = subprocess.run(
        [sys.executable, "-S", "ros_courier.py", scenario],
        cwd=courier,
        env=environment,
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines() == [*lines, "destroyed"]
