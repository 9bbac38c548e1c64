"""A pause holds the robot and is no time, on every clock."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import pairwise
from typing import Any

import pytest

from tests.bica.live_robot import Eyes, Field, Lamp, Viewer, advance, close_connections, control, is_iteration, root
from vicode.bica import IterationRecord, Observer, PacedClock, Root, SimulatedClock, WorldClock
from vicode.bica.live import NoHoldError

__all__ = ["close_connections", "control", "root"]

TICK_NS = 20_000_000
PAUSE_NS = 3_000_000_000
LIMIT_S = 10.0


class SteppedTime:
    """The time of the system: only waiting and the test let it pass."""

    def __init__(self) -> None:
        self.time_ns = 7_000_000_000

    def now_ns(self) -> int:
        return self.time_ns

    def sleep(self, seconds: float) -> None:
        self.time_ns += round(seconds * 1e9)


class Server(Field):
    """A world with a cycle of 20 ms in that time; an iteration that is late gets the newest."""

    def __init__(self, system: SteppedTime) -> None:
        super().__init__()
        self.system = system
        self.cycle = 0

    def now_ns(self) -> int:
        return self.cycle * TICK_NS

    def next_cycle(self) -> int:
        before = self.cycle
        self.cycle = max(before + 1, self.system.time_ns // TICK_NS)
        self.system.time_ns = self.cycle * TICK_NS
        return self.cycle - before


def real_clock(root: Root, system: SteppedTime) -> None:
    system.time_ns += TICK_NS


def paced_clock(root: Root, _system: SteppedTime) -> None:
    assert isinstance(root.clock, PacedClock)
    root.clock.wait(TICK_NS)


def world_clock(root: Root, _system: SteppedTime) -> None:
    assert isinstance(root.clock, WorldClock)
    root.clock.wait()


def simulated_clock(root: Root, _system: SteppedTime) -> None:
    assert isinstance(root.clock, SimulatedClock)
    root.clock.advance(TICK_NS)


def make_clock(kind: str, system: SteppedTime, world: Server) -> Any:
    match kind:
        case "paced":
            return PacedClock(system, system.sleep)
        case "world":
            return WorldClock(world)
        case "simulated":
            return SimulatedClock()
    return system


WAITS = {"real": real_clock, "paced": paced_clock, "world": world_clock, "simulated": simulated_clock}


class PausedRobot:
    """A robot that runs in a thread, and what was recorded of it."""

    def __init__(self, kind: str) -> None:
        self.system = SteppedTime()
        self.world = Server(self.system)
        self.records: list[IterationRecord] = []
        self.root = Root(
            Lamp,
            clock=make_clock(kind, self.system, self.world),
            world=self.world,
            observer=Observer(self.records.append),
        )
        self._wait: Callable[[Root, SteppedTime], None] = WAITS[kind]

    @contextmanager
    def running(self) -> Iterator[Viewer]:
        is_over = threading.Event()

        def run() -> None:
            while not is_over.wait(0.0005):
                self._wait(self.root, self.system)
                self.root.step()

        with self.root:
            server = self.root.watch(control=True)
            thread = threading.Thread(target=run, daemon=True)
            thread.start()
            try:
                yield Viewer(server)
            finally:
                is_over.set()
                thread.join(LIMIT_S)
            assert not thread.is_alive()


@pytest.mark.parametrize("kind", WAITS)
@pytest.mark.parametrize("by_breakpoint", [False, True])
def test_time_stands_still_in_a_pause(kind: str, by_breakpoint: bool) -> None:
    robot = PausedRobot(kind)
    with robot.running() as viewer:
        viewer.get(is_iteration)
        if by_breakpoint:
            viewer.send({"id": 1, "robot": "Lamp", "do": "break", "places": [["Lamp", "Lit"]]})
            viewer.get(lambda line: line.get("answer") == 1)
            robot.root.component(Eyes).distance = 0.0
        else:
            viewer.send({"id": 1, "robot": "Lamp", "do": "pause"})
        paused = viewer.get(lambda line: line.get("paused"))["iteration"]
        for _time in range(2):
            robot.system.time_ns += PAUSE_NS
            viewer.send({"id": 2, "robot": "Lamp", "do": "step"})
            viewer.get(lambda line: line.get("answer") == 2)
            paused = viewer.get(lambda line, last=paused: line.get("paused") and line["iteration"] > last)["iteration"]
        robot.system.time_ns += PAUSE_NS + 7_000_000
        viewer.send({"id": 3, "robot": "Lamp", "do": "break", "places": []}, {"robot": "Lamp", "do": "resume"})
        viewer.get(lambda line: is_iteration(line) and line["iteration"] > paused + 5)
    times_ns = [record["time_ns"] for record in robot.records]
    gaps = {after - before for before, after in pairwise(times_ns)}
    assert gaps == {TICK_NS}
    assert robot.world.holds >= 3
    if isinstance(robot.root.clock, PacedClock):
        assert robot.root.clock.overruns == 0
    if isinstance(robot.root.clock, WorldClock):
        assert robot.root.clock.missed == 0


def test_the_robot_is_held_when_it_pauses_and_when_a_viewer_leaves(root: Root, control: Viewer) -> None:
    control.ask(do="set", component="Eyes", name="distance", value=4)
    assert root.world.holds == 0
    control.socket.close()
    while not root.world.holds:
        advance(root)
    root.close()
    assert root.world.holds == 2
    root.close()
    assert root.world.holds == 2


def test_a_robot_is_held_before_its_components_are_closed() -> None:
    calls = []

    class Motor(Lamp):
        def close(self) -> None:
            calls.append("motor closed")

    class Car:
        def hold(self) -> None:
            calls.append("held")
            raise OSError("no battery")

        def close(self) -> None:
            calls.append("closed")

    with Root(Motor, clock=SimulatedClock(), world=Car()) as root:
        root.step()
    assert calls == ["held", "motor closed", "closed"]


def test_an_error_in_hold_is_printed_once(capsys: pytest.CaptureFixture[str]) -> None:
    class Car:
        def hold(self) -> None:
            raise OSError("no battery")

    root = Root(Lamp, clock=SimulatedClock(), world=Car())
    root.hold()
    root.hold()
    message = "hold() of the world failed: OSError: no battery; the robot may move (reported once)"
    assert capsys.readouterr().err.count(message) == 1


@pytest.mark.parametrize(("world", "words"), [(None, "the robot has no world"), (object(), "object has no hold()")])
def test_a_robot_without_hold_is_only_controlled_if_asked_twice(world: object, words: str) -> None:
    with Root(Lamp, clock=SimulatedClock(), world=world) as root:
        with pytest.raises(NoHoldError) as caught:
            root.watch(control=True)
        assert words in str(caught.value)
        root.watch(control=True, without_hold=True)


def test_the_environment_names_the_way_to_insist(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("VICODE_WATCH", "127.0.0.1:0")
    monkeypatch.setenv("VICODE_WATCH_CONTROL", "1")
    with Root(Lamp, clock=SimulatedClock()):
        assert "or set VICODE_WATCH_CONTROL=without-hold" in capsys.readouterr().err
    monkeypatch.setenv("VICODE_WATCH_CONTROL", "without-hold")
    with Root(Lamp, clock=SimulatedClock()):
        assert "vicode attach" in capsys.readouterr().err
