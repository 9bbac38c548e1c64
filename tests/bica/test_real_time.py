"""A run in real time sleeps until the next tick."""

from types import SimpleNamespace
from typing import cast

import pytest

from vicode.bica import Root, SimulatedClock, run

TICK_NS = 20_000_000


class FixedClock:
    def __init__(self, now_ns: int) -> None:
        self._now_ns = now_ns

    def now_ns(self) -> int:
        return self._now_ns


@pytest.mark.parametrize(("spent_ns", "sleeps"), [(5_000_000, [0.015]), (0, [0.02]), (TICK_NS, []), (30_000_000, [])])
def test_it_sleeps_for_the_rest_of_the_tick(
    monkeypatch: pytest.MonkeyPatch, spent_ns: int, sleeps: list[float]
) -> None:
    durations: list[float] = []
    monkeypatch.setattr(run.time, "sleep", durations.append)
    start_ns = 1_000_000_000
    root = SimpleNamespace(clock=FixedClock(start_ns + spent_ns), now_ns=start_ns)
    run._wait(cast("Root", root), TICK_NS)
    assert durations == pytest.approx(sleeps)


def test_simulated_time_advances_without_sleeping(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run.time, "sleep", lambda _seconds: pytest.fail("slept"))
    clock = SimulatedClock()
    run._wait(cast("Root", SimpleNamespace(clock=clock, now_ns=0)), TICK_NS)
    assert clock.now_ns() == TICK_NS
