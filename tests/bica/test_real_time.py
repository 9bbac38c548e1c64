"""Ticks: deadlines in real time, and the time between iterations that fits the frequencies."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.bica import Component, PacedClock, Root, SimulatedClock
from vicode.bica.tick import choose_tick_ns, describe_wrong_frequencies

PROJECT = Path(__file__).parents[2]
MS = 1_000_000
TICK_NS = 20 * MS


class FakeTime:
    """The clock of the system: sleeping and working take time; it does not start at 0."""

    def __init__(self) -> None:
        self.time_ns = 5_000 * MS
        self.slept_s = 0.0

    def now_ns(self) -> int:
        return self.time_ns

    def sleep(self, seconds: float) -> None:
        # No system sleeps exactly.
        self.time_ns += round(seconds * 1e9) + 60_000
        self.slept_s += seconds


class Pace:
    def __init__(self, *, end_ns: float = math.inf) -> None:
        self.time = FakeTime()
        self.clock = PacedClock(self.time, self.time.sleep)
        self.end_ns = end_ns

    def work(self, spent_ms: float, *, is_cancelled: bool = False) -> int:
        """Spend some time and wait; return the time of the next iteration in ms."""
        self.time.time_ns += round(spent_ms * MS)
        self.clock.wait(TICK_NS, end_ns=self.end_ns, is_cancelled=lambda: is_cancelled)
        return self.clock.now_ns() // MS


def test_waiting_does_not_drift() -> None:
    pace = Pace()
    assert [pace.work(3) for _ in range(200)] == list(range(20, 4020, 20))
    assert pace.clock.overruns == 0
    assert pace.time.now_ns() - 5_000 * MS == pytest.approx(4_000 * MS, abs=MS)


def test_missed_ticks_are_skipped_and_counted() -> None:
    pace = Pace()
    assert [pace.work(spent_ms) for spent_ms in (5, 19, 30, 45, 5)] == [20, 40, 80, 140, 160]
    assert pace.clock.overruns == 2


def test_a_tick_that_ends_exactly_in_time_is_no_overrun() -> None:
    pace = Pace()
    assert pace.work(20) == 20
    assert (pace.clock.overruns, pace.time.slept_s) == (0, 0)


def test_waiting_ends_with_the_run() -> None:
    pace = Pace(end_ns=8 * MS)
    assert pace.work(3) == 20
    assert pace.time.slept_s == pytest.approx(0.005)


def test_a_signal_ends_the_waiting() -> None:
    pace = Pace()
    pace.work(3, is_cancelled=True)
    assert pace.time.slept_s == 0


@given(spent_ms=st.lists(st.integers(0, 100), max_size=40))
def test_iterations_are_due_at_multiples_of_the_tick(spent_ms: list[int]) -> None:
    pace = Pace()
    for each in spent_ms:
        before_ns = pace.time.now_ns()
        due_ns = pace.work(each) * MS
        late_ns = pace.time.now_ns() - 5_000 * MS - due_ns
        assert due_ns % TICK_NS == 0
        assert 0 <= late_ns <= MS
        assert pace.time.now_ns() - before_ns <= (each + 21) * MS


@pytest.mark.parametrize(
    ("frequencies_hz", "tick_ms"),
    [
        ((), 20),
        ((10, 50), 20),
        ((0.5, 25), 20),
        ((15, 20, 30), 1000 / 60),
        ((12.5,), 20),
        ((40,), 12.5),
        ((1000, 50), 1),
        ((7, 30, 50), 5),
        ((math.inf, -3.0, 1e-9), 20),
    ],
)
def test_the_tick_fits_the_frequencies(frequencies_hz: tuple[float, ...], tick_ms: float) -> None:
    assert choose_tick_ns(frequencies_hz) == math.ceil(tick_ms * MS)


def make_worker(hertz: float) -> type[Component]:
    class Worker(Component):
        frequency_hz = hertz

        def __init__(self, root: Root) -> None:
            super().__init__(root)
            self.works = 0

        def work(self) -> None:
            self.works += 1

    return Worker


@pytest.mark.parametrize("hertz", [7, 15, 20, 30, 33, 35, 60, 70, 100 / 3])
def test_components_work_at_their_frequency(hertz: float) -> None:
    tick_ns, clock = choose_tick_ns([hertz]), SimulatedClock()
    root = Root(make_worker(hertz), clock=clock)
    assert list(describe_wrong_frequencies(root.components, tick_ns)) == []
    while clock.now_ns() < 10_000 * MS:
        root.step()
        clock.advance(tick_ns)
    assert root.main.works == math.ceil(10 * hertz)  # type: ignore[attr-defined]


def test_frequencies_that_do_not_fit_are_named() -> None:
    root = Root(make_worker(15), clock=SimulatedClock())
    [warning] = describe_wrong_frequencies(root.components, TICK_NS)
    assert warning.startswith("Worker works at 12.5 Hz instead of 15 Hz: ")


def test_real_time_counts_overruns_and_the_frequency(tmp_path: Path) -> None:
    text = "import time\nfrom vicode.bica import Component\nclass Slow(Component):\n    frequency_hz = 50.0\n"
    (tmp_path / "slow.py").write_text(f"{text}    def work(self):\n        time.sleep(0.03)\n", encoding="utf-8")
    command = [sys.executable, "-m", "vicode.bica", "slow:Slow", "--path", str(tmp_path), "--stream"]
    done = subprocess.run(
        [*command, "--real-time", "--seconds", "0.2"], cwd=PROJECT, capture_output=True, check=True, timeout=60
    )
    summary = json.loads(done.stdout.splitlines()[-1])["summary"]
    assert summary["iterations"] <= 5
    assert summary["overruns"] == summary["iterations"]
    assert summary["cycle_times"]["Slow"]["target_hz"] == 50
    assert summary["tick_ms"] == 20
