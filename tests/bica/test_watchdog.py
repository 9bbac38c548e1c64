"""The robot is held while an iteration takes too long."""

import threading

import pytest

from tests.bica.live_robot import Field, Lamp
from vicode.bica import Root, SimulatedClock
from vicode.bica.watchdog import Watchdog

LIMIT_S = 10.0


class Time:
    now_s = 100.0

    def __call__(self) -> float:
        return self.now_s


def test_a_late_iteration_is_held_once(capsys: pytest.CaptureFixture[str]) -> None:
    time = Time()
    root = Root(Lamp, clock=SimulatedClock(), world=Field())
    watchdog = Watchdog(root, 0.5, time)
    holds = []
    watchdog.check()
    for passed_s in (0.5, 0.7, 0.1, 0.6):
        watchdog.begin()
        time.now_s += passed_s
        for _check in range(3):
            watchdog.check()
        watchdog.end()
        watchdog.check()
        holds.append(root.world.holds)
    assert holds == [0, 1, 1, 2]
    assert "iteration 0 takes longer than 0.5 s; the robot was held" in capsys.readouterr().err


def test_a_pause_is_no_late_iteration() -> None:
    time = Time()
    root = Root(Lamp, clock=SimulatedClock(), world=Field())
    watchdog = Watchdog(root, 0.5, time)
    watchdog.begin()
    with root._stopped_time():
        time.now_s += 60
        watchdog.check()
    time.now_s += 0.1
    watchdog.check()
    assert root.world.holds == 1


def test_a_thread_holds_the_robot_while_the_iteration_goes_on() -> None:
    is_held = threading.Event()

    class Car:
        def hold(self) -> None:
            is_held.set()

    with Watchdog(Root(Lamp, clock=SimulatedClock(), world=Car()), 0.02) as watchdog:
        watchdog.begin()
        assert is_held.wait(LIMIT_S)


@pytest.mark.parametrize(("world", "limit_s"), [(object(), 0.5), (Field(), 0.0)])
def test_no_thread_is_started_without_need(world: object, limit_s: float) -> None:
    before = threading.active_count()
    with Watchdog(Root(Lamp, clock=SimulatedClock(), world=world), limit_s):
        assert threading.active_count() == before
