"""docs/on-your-robot.md: every program on the page runs."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from vicode.generators import generate
from vicode.output import write_atomically
from vicode.store import open_project

PAGE = Path(__file__).parents[2] / "docs" / "on-your-robot.md"
BLOCKS = dict(re.findall(r"^```python (\S+)\n(.*?)^```$", PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL))
COURIER = ("ros_actions.py", "ros_courier.py")
"""See test_ros_action_page.py."""
PROGRAMS = {name: text for name, text in BLOCKS.items() if name not in COURIER}

PROJECT = """\
vicode: 1
project: Lamps
components:
  Sensor: {implementation: "rig:Sensor", outputs: {level: {type: float}}}
"""
LAMP = """\
vicode: 1
component: Lamp
uses: {sensor: Sensor}
initial: Dark
states:
  Dark: {requires: [sensor], transitions: [{to: Lit, when: sensor.level > 3}]}
  Lit: {final: true}
"""
RIG = """\
from pathlib import Path
from vicode.bica import Component


class Rig:
    level = newest = 0.0
    acted = 0

    def sense(self):
        self.level += 1

    def read(self):
        return self.newest + 1

    def act(self):
        self.acted += 1

    def close(self):
        Path("closed").write_text(str(self.acted))


class ServerRig(Rig):
    cycle = 0

    def next_cycle(self):
        self.act()
        self.cycle += 1
        self.level += 1
        return 1

    def now_ns(self):
        return self.cycle * 100_000_000


class Sensor(Component):
    level = 0.0

    def work(self):
        self.level = self.world.level
"""
ROS = {
    "rclpy/__init__.py": """\
from rclpy.node import nodes
init = try_shutdown = lambda: None
def spin(node):
    for number in range(10):
        node.callback(node.message(data=float(number)))
        node.timer()
    print(*node.published[-1:])
""",
    "rclpy/node.py": """\
nodes = []
class Node:
    def __init__(self, name):
        self.published = []
    def create_subscription(self, message, topic, callback, depth):
        self.message, self.callback = message, callback
    def create_publisher(self, message, topic, depth):
        return self
    def publish(self, message):
        self.published.append(f"state: {message.data}")
    def create_timer(self, period_s, callback):
        self.timer = callback
    def destroy_node(self):
        nodes.clear()
""",
    "std_msgs/__init__.py": "",
    "std_msgs/msg.py": """\
class Float32:
    def __init__(self, data):
        self.data = data
String = Float32
""",
}


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the generated code, the runtime, and the modules of a robot."""
    folder = tmp_path_factory.mktemp("robot")
    (folder / "designs").mkdir()
    (folder / "designs/project.yaml").write_text(PROJECT)
    (folder / "designs/lamp.yaml").write_text(LAMP)
    texts = {"rig.py": RIG, **ROS, **PROGRAMS}
    for file in generate(open_project(folder / "designs").project, standalone=True):
        texts[file.path.removeprefix("python/")] = file.text
    for path, text in texts.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        write_atomically(folder / path, text, is_durable=False)
    return folder


@pytest.mark.parametrize("name", PROGRAMS)
def test_programs_run(robot: Path, name: str) -> None:
    (robot / "closed").unlink(missing_ok=True)
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    done = subprocess.run(
        [sys.executable, "-S", name],
        cwd=robot,
        env=environment,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "state: Lit\n"
    assert int((robot / "closed").read_text()) > 0
