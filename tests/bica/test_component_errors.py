"""Exceptions in components: their reported location, and that the component continues."""

from __future__ import annotations

import inspect

import pytest

from vicode.bica import Component, ComponentError, ErrorRecord, Root, SimulatedClock, State


def fail() -> None:
    raise LookupError("no such thing")


class Clumsy(Component):
    """Fails where `fails_in` says."""

    design_file = "designs/clumsy.yaml"
    fails_in = ""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.works = 0
        self._set_states(
            State("Calm", self._in_calm, leave=self._leave_calm),
            State("Busy", self._in_busy, enter=self._enter_busy),
        )

    def _in_calm(self, decide: bool = True) -> None:
        self.works += 1
        if self._when_time():
            self._change_to("Busy")

    def _leave_calm(self) -> None:
        """Leave in a body that is marked."""
        # <vicode Calm.leave 00000000>
        if self.fails_in == "leave":
            fail()
        # </vicode>

    def _in_busy(self, decide: bool = True) -> None:
        self.works += 1
        self._do_things()

    def _enter_busy(self) -> None:
        if self.fails_in == "enter":
            fail()

    def _when_time(self) -> bool:
        if self.fails_in == "guard":
            fail()
        return True

    def _do_things(self) -> None:
        """Do what takes several lines."""
        things = [1, 2]
        if self.fails_in == "action":
            things.clear()
        things.pop()


class Parent(Component):
    """Requires the clumsy one."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.works = 0
        self._set_states(State("Only", self._in_only, requires=(root.component(Clumsy),)))

    def _in_only(self, decide: bool = True) -> None:
        self.works += 1


@pytest.fixture
def records() -> list[ErrorRecord]:
    return []


def make_clumsy(records: list[ErrorRecord], fails_in: str) -> tuple[Root, Clumsy]:
    root = Root(Clumsy, clock=SimulatedClock(), on_error=records.append)
    clumsy = root.component(Clumsy)
    clumsy.fails_in = fails_in
    root.step()
    return root, clumsy


@pytest.mark.parametrize(
    ("fails_in", "method", "state", "line"),
    [
        ("guard", "_when_time", "Calm", 2),
        ("leave", "_leave_calm", "Calm", 2),
        ("enter", "_enter_busy", "Busy", 2),
        ("action", "_do_things", "Busy", 5),
    ],
)
def test_the_location_is_reported(
    records: list[ErrorRecord], fails_in: str, method: str, state: str, line: int
) -> None:
    make_clumsy(records, fails_in)
    [record] = records
    assert (record.component, record.design_file, record.state) == ("Clumsy", "designs/clumsy.yaml", state)
    assert (record.body, record.method, record.line) == (fails_in, method, line)
    assert record.file_line == inspect.getsourcelines(getattr(Clumsy, method))[1] + line + (2 if record.region else 0)
    assert record.region == ("Calm.leave" if fails_in == "leave" else "")
    assert record.file == __file__
    assert "no such thing" in record.message or "pop from empty list" in record.message
    assert (record.iteration, record.time_ns) == (1, 0)


def test_the_component_continues_in_its_next_iteration(records: list[ErrorRecord]) -> None:
    root, clumsy = make_clumsy(records, "guard")
    root.step()
    assert len(records) == clumsy.works == 2
    clumsy.fails_in = ""
    root.step()
    assert clumsy.state == "Busy"


def test_a_parent_works_though_its_child_fails(records: list[ErrorRecord]) -> None:
    root = Root(Parent, clock=SimulatedClock(), on_error=records.append)
    root.component(Clumsy).fails_in = "guard"
    root.step()
    assert root.component(Parent).works == 1
    assert [record.component for record in records] == ["Clumsy"]


def test_stop_raises_through_all_parents() -> None:
    root = Root(Parent, clock=SimulatedClock(), on_error="stop")
    root.component(Clumsy).fails_in = "guard"
    with pytest.raises(ComponentError) as caught:
        root.step()
    assert caught.value.record.method == "_when_time"


def test_a_place_is_printed_once_and_counted(capsys: pytest.CaptureFixture[str]) -> None:
    root = Root(Clumsy, clock=SimulatedClock())
    root.component(Clumsy).fails_in = "guard"
    for _ in range(3):
        root.step()
    assert list(root.errors.values()) == [3]
    printed = capsys.readouterr().err
    assert printed.startswith(
        "error: Clumsy (designs/clumsy.yaml), state Calm, guard _when_time, line 2: LookupError: no such thing ["
    )
    assert printed.count("\n") == 1


def test_a_failing_modulate_is_an_error_of_the_caller(records: list[ErrorRecord]) -> None:
    class Caller(Component):
        def __init__(self, root: Root) -> None:
            super().__init__(root)
            self.clumsy = root.component(Clumsy)

        def work(self) -> None:
            self._call(self.clumsy, speed=1)

    Root(Caller, clock=SimulatedClock(), on_error=records.append).step()
    [record] = records
    assert (record.component, record.body, record.line) == ("Caller", "work", 1)


class Slope:
    """A world that fails where the class of a component calls it."""

    def wheels(self, speed: float) -> None:
        fail()


class Wheels(Component):
    """As generated for a component of the world."""

    world: Slope

    def work(self) -> None:
        self.world.wheels(1.0)


def test_an_error_of_the_world_has_its_line_there() -> None:
    records: list[ErrorRecord] = []
    Root(Wheels, clock=SimulatedClock(), world=Slope(), on_error=records.append).step()
    (record,) = records
    assert (record.component, record.method, record.line) == ("Wheels", "wheels", 1)
    assert record.file_line == inspect.getsourcelines(Slope.wheels)[1] + 1


class Leaver(Component):
    """Raises what its world holds, wherever it can."""

    def work(self) -> None:
        raise self.world.error(3)

    def close(self) -> None:
        raise self.world.error(3)


class LeaverWorld:
    def __init__(self, error: type[BaseException]) -> None:
        self.error = error

    def hold(self) -> None:
        raise self.error(3)


def test_exit_is_an_error_like_others(capsys: pytest.CaptureFixture[str]) -> None:
    root = Root(Leaver, clock=SimulatedClock(), world=LeaverWorld(SystemExit))
    root.step()
    root.step()
    root.close()
    assert [(method, count) for (_component, method, _line), count in root.errors.items()] == [
        ("work", 2),
        ("close", 1),
    ]
    assert capsys.readouterr().err.count("SystemExit: 3") == 3


def test_an_interrupt_ends_the_step() -> None:
    root = Root(Leaver, clock=SimulatedClock(), world=LeaverWorld(KeyboardInterrupt))
    with pytest.raises(KeyboardInterrupt):
        root.step()
