"""Laws of errors and clocks (docs/semantics.md): random exceptions, clocks and streams do not stop the components."""

from __future__ import annotations

import io
import sys
from typing import TextIO

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.bica import Component, ComponentError, ErrorRecord, Observer, Root, SimulatedClock, State

SECOND_NS = 1_000_000_000
HOUR_NS = 3600 * SECOND_NS


class UnprintableError(Exception):
    def __str__(self) -> str:
        raise RuntimeError("no text")


class UntraceableError(Exception):
    __traceback__ = None  # type: ignore[assignment]


def make_foreign_error() -> Exception:
    """An error of another root, which a component runs."""
    with pytest.raises(ComponentError) as caught:
        Root(Failing, on_error="stop").step()
    return caught.value


class BrokenStream(io.StringIO):
    def write(self, _text: str) -> int:
        raise OSError(28, "No space left on device")


class SetClock:
    def __init__(self) -> None:
        self.time_ns = 0

    def now_ns(self) -> int:
        return self.time_ns


class Failing(Component):
    def work(self) -> None:
        raise UnprintableError


class Faults:
    """The world: raises an exception at the points that are set for the iteration, and counts it."""

    def __init__(self, error: Exception) -> None:
        self.points: frozenset[str] = frozenset()
        self.raised = 0
        self._error = error

    def reach(self, point: str) -> None:
        if point in self.points:
            self.raised += 1
            raise self._error


class Eyes(Component):
    frequency_hz = 10.0
    world: Faults

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.times_ns: list[int] = []

    def restart(self) -> None:
        self.world.reach("eyes.restart")

    def work(self) -> None:
        self.times_ns.append(self.root.now_ns)
        self.world.reach("eyes.work")


class Legs(Component):
    world: Faults

    def modulate(self, *, speed: float = 0.0) -> None:
        self.world.reach("legs.modulate")

    def work(self) -> None:
        self.world.reach("legs.work")


class Walker(Component):
    """Changes between its states in each iteration."""

    world: Faults

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.legs = root.component(Legs)
        self.acted_in = 0
        eyes = (root.component(Eyes),)
        self._set_states(
            State("A", self._in_a, requires=eyes, leave=lambda: self.world.reach("leave")),
            State("B", self._in_b, requires=eyes, enter=lambda: self.world.reach("enter")),
        )

    def restart(self) -> None:
        self.world.reach("restart")

    def _in_a(self, decide: bool = True) -> None:
        self._run_state("B", decide=decide)

    def _in_b(self, decide: bool = True) -> None:
        self._run_state("A", decide=decide)

    def _run_state(self, other: str, *, decide: bool) -> None:
        if decide:
            self.world.reach("guard")
            self._change_to(other)
            return
        self.acted_in = self.root.iteration
        self._call(self.legs, speed=1.0)


POINTS = ("restart", "guard", "leave", "enter", "eyes.restart", "eyes.work", "legs.modulate", "legs.work")
JUMPS_NS = (-HOUR_NS, -1, 0, 0, 1, 20_000_000, 100_000_000, HOUR_NS)
STREAMS = ("usable", "missing", "closed", "broken")
ERRORS = (UnprintableError, UntraceableError, MemoryError, KeyError, make_foreign_error)


def make_stream(kind: str) -> TextIO | None:
    stream = BrokenStream() if kind == "broken" else io.StringIO()
    if kind == "closed":
        stream.close()
    return None if kind == "missing" else stream


def fail_to_log(_record: ErrorRecord) -> None:
    raise ConnectionError("the log server is not reachable")


@given(
    steps=st.lists(st.tuples(st.frozensets(st.sampled_from(POINTS)), st.sampled_from(JUMPS_NS)), max_size=30),
    make_error=st.sampled_from(ERRORS),
    stream=st.sampled_from(STREAMS),
    on_error=st.sampled_from(("continue", fail_to_log)),
    observer=st.one_of(st.none(), st.builds(Observer, values=st.just(True))),
)
def test_no_exception_clock_or_stream_stops_the_components(steps, make_error, stream, on_error, observer) -> None:  # type: ignore[no-untyped-def]
    clock, faults = SetClock(), Faults(make_error())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "stderr", make_stream(stream))
        root = Root(Walker, clock=clock, world=faults, on_error=on_error, observer=observer)
        root.measure = observer is not None
        walker, eyes, expected = root.component(Walker), root.component(Eyes), Expected()
        for points, jump_ns in steps:
            faults.points = points
            clock.time_ns += jump_ns
            root.step()
            expected.step(points, jump_ns)
            assert root.now_ns == expected.now_ns
            assert walker.state == expected.state
            assert (walker.acted_in == root.iteration) == expected.acts
            assert eyes.times_ns == expected.eyes_ns
    assert root.errors.total() == faults.raised
    if observer is not None:
        assert sum(len(record["errors"]) for record in observer.records) == faults.raised


class Expected:
    """What docs/semantics.md promises of the components above."""

    def __init__(self) -> None:
        self.now_ns = 0
        self.state = "A"
        self.acts = False
        self.eyes_ns: list[int] = []
        self._is_first = self._eyes_start = True

    def step(self, points: frozenset[str], jump_ns: int) -> None:
        self.now_ns += max(jump_ns, 0)
        is_first, self._is_first, self.acts = self._is_first, False, False
        if is_first and "restart" in points:
            return
        self._step_eyes(points)
        if "guard" in points or (self.state == "A" and "leave" in points):
            return
        self.state = "B" if self.state == "A" else "A"
        self.acts = not (self.state == "B" and "enter" in points)

    def _step_eyes(self, points: frozenset[str]) -> None:
        starts, self._eyes_start = self._eyes_start, False
        if starts and "eyes.restart" in points:
            return
        if not self.eyes_ns or self.now_ns - self.eyes_ns[-1] >= SECOND_NS // 10:
            self.eyes_ns.append(self.now_ns)


@pytest.fixture
def eyes_at_noon() -> tuple[SetClock, Root, Eyes]:
    clock = SetClock()
    clock.time_ns = 12 * HOUR_NS
    root = Root(Eyes, clock=clock, world=Faults(KeyError()))
    root.step()
    return clock, root, root.component(Eyes)


def test_a_component_runs_on_when_the_clock_is_set_back(eyes_at_noon: tuple[SetClock, Root, Eyes]) -> None:
    clock, root, eyes = eyes_at_noon
    for jump_ns in (-HOUR_NS, SECOND_NS // 10, -HOUR_NS, SECOND_NS // 10):
        clock.time_ns += jump_ns
        root.step()
    assert [time_ns - 12 * HOUR_NS for time_ns in eyes.times_ns] == [0, SECOND_NS // 10, SECOND_NS // 5]


def test_time_that_jumps_ahead_has_passed(eyes_at_noon: tuple[SetClock, Root, Eyes]) -> None:
    clock, root, eyes = eyes_at_noon
    clock.time_ns += HOUR_NS
    root.step()
    root.step()
    assert eyes.times_ns == [12 * HOUR_NS, 13 * HOUR_NS]


def test_the_text_of_an_exception_may_be_missing(capsys: pytest.CaptureFixture[str]) -> None:
    Root(Failing, clock=SimulatedClock()).step()
    assert "Failing, work, line 1: UnprintableError: its text cannot be read, RuntimeError [" in capsys.readouterr().err


def test_a_failing_on_error_is_printed_once(capsys: pytest.CaptureFixture[str]) -> None:
    root = Root(Failing, clock=SimulatedClock(), on_error=fail_to_log)
    root.step()
    root.step()
    printed = capsys.readouterr().err
    assert printed == "error: on_error raised ConnectionError: the log server is not reachable (reported once)\n"


def test_on_error_may_stop_the_root() -> None:
    def stop(record: ErrorRecord) -> None:
        raise ComponentError(record)

    with pytest.raises(ComponentError):
        Root(Failing, clock=SimulatedClock(), on_error=stop).step()
