"""Components of topics of ROS 2: messages, stop commands, latched states, and messages of strangers."""

import math
import random
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from enum import Enum
from pathlib import Path
from typing import Any

import pytest

from tests.bica.live_robot import Viewer, close_connections
from tests.bica.ros_robot import SCAN, TWIST, make_scan, read_latched, write_bag
from vicode.bica import Component, Root, SimulatedClock, State, ros_messages, ros_session
from vicode.bica.errors import NetworkError
from vicode.bica.live import NoHoldError
from vicode.bica.ros_messages import FieldError, find_field
from vicode.bica.ros_topic import TopicComponent

__all__ = ["close_connections"]

LIMIT_S = 30.0


class Mode(Enum):
    off = 0
    on = 1


class Scan(TopicComponent):
    def __init__(self, root: Root) -> None:
        super().__init__(root, "/scan", SCAN, outputs={"nearest": "min(ranges)", "points": "count(ranges)"}, max_age=1)
        self.nearest = 9.0
        self.points = 0


class Drive(TopicComponent):
    def __init__(self, root: Root) -> None:
        super().__init__(root, "/cmd_vel", TWIST, parameters={"speed": "linear.x"})
        self.speed = 0.0

    def modulate(self, *, speed: float = 0.0) -> None:
        self.speed = speed


class Player(Component):
    """Drives until something is near; a design without hand-written code would be generated like this."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.scan, self.drive = root.component(Scan), root.component(Drive)
        self._set_states(
            State("Go", self._in_go, requires=(self.scan,)), State("Near", self._in_near, requires=(self.scan,))
        )

    def _in_go(self, decide: bool = True) -> None:
        if decide and self.scan.is_alive and self.scan.nearest < 1.0:
            self._change_to("Near")
        elif self.scan.is_alive:
            self._call(self.drive, speed=1.0)

    def _in_near(self, decide: bool = True) -> None:
        pass


@pytest.fixture(autouse=True)
def _domain(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(random.randint(100, 200)))
    monkeypatch.delenv("ROS_AUTOMATIC_DISCOVERY_RANGE", raising=False)
    monkeypatch.delenv("CYCLONEDDS_URI", raising=False)


def wait(condition: Callable[[], Any], root: Root | None = None) -> Any:
    """Wait for a result, stepping a root."""
    end_s = time.monotonic() + LIMIT_S
    while time.monotonic() < end_s:
        if root is not None:
            root.step()
        if result := condition():
            return result
        time.sleep(0.01)
    raise AssertionError("nothing happened")


def test_a_design_drives_a_robot_in_another_process_and_the_bag_leads_to_the_same_states(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = [sys.executable, "-m", "tests.bica.ros_robot", "turtle", str(tmp_path)]
    with subprocess.Popen(program, stdout=subprocess.PIPE, text=True) as robot:
        states = []
        with Root(Player) as root:
            wait(lambda: states.append(root.main.state) or root.main.state == "Near", root)
            # The command stops when the component is not stepped any more: the robot sees it and ends.
            output, _errors = robot.communicate(timeout=LIMIT_S)
    position, speed = map(float, output.split())
    assert 1.0 < position < 2.0
    assert speed == 0.0
    monkeypatch.setenv(ros_session.BAG, str(tmp_path / "bag"))
    clock = SimulatedClock()
    replayed = []
    with Root(Player, clock=clock) as root:
        for _ in range(2000):
            root.step()
            replayed.append(root.main.state)
            clock.advance(20_000_000)
    assert list(dict.fromkeys(replayed)) == list(dict.fromkeys(states)) == ["Go", "Near"]


def test_arrays_without_finite_items_give_the_initial_value() -> None:
    with Root(Scan) as root:
        publish = ros_session.open_session().writer("/scan", SCAN)
        scan: Any = root.main

        def send(*ranges: float) -> bool:
            publish(make_scan(*ranges))
            return True

        wait(lambda: send(4.0, math.nan, 3.0) and scan.nearest == 3.0, root)
        assert (scan.points, scan.is_alive) == (2, True)
        wait(lambda: send(math.nan, math.inf) and scan.nearest == 9.0, root)
        wait(lambda: send(2.0) and scan.nearest == 2.0, root)
        wait(lambda: send() and scan.nearest == 9.0, root)


def test_long_arrays_are_reported_and_ignored(capsys: pytest.CaptureFixture[str]) -> None:
    with Root(Scan) as root:
        publish = ros_session.open_session().writer("/scan", SCAN)
        reported = []

        def is_reported() -> bool:
            publish(make_scan(*[1.0] * 100_001))
            reported.append(capsys.readouterr().err)
            return "100001 items" in "".join(reported)

        wait(is_reported, root)
        assert root.main.nearest == 9.0
        assert not root.main.is_alive


def test_another_type_on_the_topic_is_ignored() -> None:
    with Root(Scan) as root:
        session = ros_session.open_session()
        wrong, right = session.writer("/scan", TWIST), session.writer("/scan", SCAN)

        def send() -> bool:
            wrong(ros_session.make_message(TWIST))
            right(make_scan(1.0))
            return bool(root.main.nearest == 1.0)

        wait(send, root)


def test_data_gets_too_old(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_bag(tmp_path / "bag", [(5_000_000_000, make_scan(1.0)), (5_500_000_000, make_scan(2.0))])
    monkeypatch.setenv(ros_session.BAG, str(tmp_path / "bag"))
    clock = SimulatedClock()
    seen = []
    with Root(Scan, clock=clock) as root:
        for _ in range(5):
            root.step()
            seen.append((root.main.nearest, root.main.data_age, root.main.is_alive))
            clock.advance(500_000_000)
    assert seen == [(1.0, 0.0, True), (2.0, 0.0, True), (2.0, 0.5, True), (2.0, 1.0, True), (2.0, 1.5, False)]


def test_states_reach_who_joins_late() -> None:
    with Root(Player) as root:
        root.step()
        reader = read_latched("/Player/states")
        assert wait(lambda: reader.take(1))[0].data == "Player.Go"
        root.step()
        time.sleep(0.1)
        # Nothing has changed.
        assert reader.take(1) == []


class Commander(Component):
    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.drive = root.component(Drive)

    def work(self) -> None:
        self._call(self.drive, speed=1.0)


@pytest.mark.parametrize("stop", [Root.hold, Root.close])
def test_a_robot_that_is_held_or_closed_stops(stop: Callable[[Root], None]) -> None:
    root = Root(Commander)
    commands = ros_session.open_session().reader("/cmd_vel", TWIST)
    assert wait(lambda: commands.take(0), root).linear.x == 1.0
    stop(root)
    assert wait(lambda: commands.take(0)).linear.x == 0.0
    stop(root)
    time.sleep(0.1)
    assert commands.take(0) is None
    root.close()


class Motor(Component):
    def work(self) -> None:
        """Would move the robot."""


class Lifter(Commander):
    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.motor = root.component(Motor)


class Planner(Component):
    """Like a generated component."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.drive = root.component(Drive)
        self._set_states(State("Go", self._in_go))

    def _in_go(self, decide: bool = True) -> None:
        self._call(self.drive, speed=1.0)


class Loader(Planner):
    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.motor = root.component(Motor)


def test_a_paused_robot_gets_the_stop_command() -> None:
    with Root(Planner) as root:
        viewer = Viewer(root.watch(control=True), root)
        commands = ros_session.open_session().reader("/cmd_vel", TWIST)

        def speed() -> float | None:
            message = commands.take(0)
            return None if message is None else float(message.linear.x)

        wait(lambda: speed() == 1.0, root)
        threading.Timer(0.5, lambda: viewer.send({"do": "resume", "robot": "Planner"})).start()
        viewer.send({"do": "pause", "robot": "Planner"})
        # The step of the root returns when the viewer resumes; until then, the newest command stops the robot.
        held = []
        holders, root.holders = root.holders, [*root.holders, lambda: held.append(wait(lambda: speed() == 0.0))]
        wait(lambda: held, root)
        root.holders = holders
        wait(lambda: speed() == 1.0, root)


@pytest.mark.parametrize("component", [Lifter, Loader])
def test_a_robot_with_other_motors_needs_hold(component: type[Component]) -> None:
    with Root(component) as root, pytest.raises(NoHoldError, match=r"(Motor|Lifter) is no topic"):
        root.watch(control=True)


def test_parameters_are_limited_to_their_fields_and_headers_filled() -> None:
    class Range(TopicComponent):
        def __init__(self, root: Root) -> None:
            fields = {"kind": "radiation_type", "range": "range"}
            super().__init__(root, "/range", "sensor_msgs/msg/Range", parameters=fields, frame="base")
            self.modulate()

        def modulate(self, *, kind: int = 300, range: float = 1.5) -> None:  # noqa: A002 - as in a design
            self.kind, self.range = kind, range

    with Root(Range) as root:
        ranges = ros_session.open_session().reader("/range", "sensor_msgs/msg/Range")
        message = wait(lambda: ranges.take(0), root)
    assert (message.radiation_type, message.range, message.header.frame_id) == (255, 1.5, "base")
    assert message.header.stamp.sec > 0


def test_a_parameter_without_a_default_cannot_stop_the_robot() -> None:
    class Wheels(TopicComponent):
        def __init__(self, root: Root) -> None:
            super().__init__(root, "/cmd_vel", TWIST, parameters={"speed": "linear.x", "turn": "angular.z"})

        def modulate(self, *, speed: float = 0.0, turn: float) -> None:
            self.speed, self.turn = speed, turn

    with pytest.raises(NetworkError, match=r"no default for 'turn'"):
        Root(Wheels)


def test_elements_are_numbers_or_texts() -> None:
    class Modes(TopicComponent):
        def __init__(self, root: Root) -> None:
            super().__init__(root, "/mode", "std_msgs/msg/String", outputs={"mode": "data"})
            self.mode = Mode.off

    with Root(Modes) as root:
        publish = ros_session.open_session().writer("/mode", "std_msgs/msg/String")
        message = ros_session.make_message("std_msgs/msg/String")
        message.data = "on"
        wait(lambda: publish(message) or root.main.mode == Mode.on, root)
        message.data = "nowhere"
        for _ in range(20):
            publish(message)
            root.step()
        assert root.main.mode == Mode.on


@pytest.mark.parametrize(
    ("source", "message"),
    [
        ("rangs", "has no field 'rangs'"),
        ("ranges", "is an array"),
        ("header", "is a message"),
        ("min(range_min)", "is no array"),
        ("sum(ranges)", "unknown function 'sum'"),
        ("ranges[0]", "is no field"),
        ("mean(header.frame_id)", "is no array"),
    ],
)
def test_wrong_fields(source: str, message: str) -> None:
    with pytest.raises(FieldError, match=message):
        find_field(SCAN, source)


@pytest.mark.parametrize(("library", "needed"), [("cyclonedds.idl", "cyclonedds"), ("rosbags.typesys", "rosbags")])
def test_a_missing_library_is_named_with_the_command(
    library: str, needed: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    clear_types()
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(NetworkError, match=f"{needed}, which is not installed: pip install"):
        ros_session.make_message("std_msgs/msg/String")
    ros_messages._load_types.cache_clear()


@pytest.fixture
def types(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder of message types."""
    folder = tmp_path / "turtles/msg"
    folder.mkdir(parents=True)
    (folder / "Pose.msg").write_text("float32 x\nturtles/Color color\nColor[] others\n")
    (folder / "Color.msg").write_text("uint8 red\n")
    monkeypatch.setenv("VICODE_ROS_TYPES", str(tmp_path))
    clear_types()
    yield folder
    clear_types()


def clear_types() -> None:
    ros_messages._load_types.cache_clear()
    ros_session.message_class.cache_clear()


def test_a_team_has_its_own_message_types(types: Path) -> None:
    class Turtle(TopicComponent):
        def __init__(self, root: Root) -> None:
            super().__init__(root, "/pose", "turtles/msg/Pose", outputs={"x": "x", "red": "color.red"})
            self.x, self.red = 0.0, 0

    with Root(Turtle) as root:
        publish = ros_session.open_session().writer("/pose", "turtles/msg/Pose")
        message = ros_session.make_message("turtles/msg/Pose")
        message.x, message.color.red = 1.5, 7
        wait(lambda: publish(message) or root.main.red == 7, root)
        assert root.main.x == 1.5


def test_wrong_message_types_are_errors(types: Path) -> None:
    (types / "Color.msg").write_text("uint8 = red\n")
    with pytest.raises(NetworkError, match=r"cannot read the message type .*Color\.msg"):
        ros_session.make_message("turtles/msg/Pose")
    (types / "Color.msg").unlink()
    (types / "Pose.msg").unlink()
    with pytest.raises(NetworkError, match=r"no file PACKAGE/msg/NAME\.msg"):
        ros_session.make_message("turtles/msg/Pose")


def test_simulated_time_needs_a_bag() -> None:
    with pytest.raises(NetworkError, match="--real-time"):
        Root(Scan, clock=SimulatedClock())


def test_a_wrong_domain_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", "233")
    with pytest.raises(NetworkError, match="ROS_DOMAIN_ID=233"):
        Root(Scan)
