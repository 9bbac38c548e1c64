"""The records of an observer: who stepped whom, why, and what became of it."""

from __future__ import annotations

import json
from types import SimpleNamespace
from typing import Any

from tests.bica.sample_player import Player
from vicode.bica import Component, ErrorRecord, IterationRecord, Observer, Root, SimulatedClock, State
from vicode.bica.observer import only_changes


class Run:
    """A sample player that is observed."""

    def __init__(self, *, values: bool = False, measure: bool = False) -> None:
        self.world = SimpleNamespace(ball_seen=False, ball_distance=1000.0, fallen=False, log=[])
        self.clock = SimulatedClock()
        self.observer = Observer(values=values)
        self.root = Root(Player, clock=self.clock, world=self.world, observer=self.observer, on_error="stop")
        self.root.measure = measure

    def step(self, ms: int = 0) -> IterationRecord:
        self.clock.advance(ms * 1_000_000)
        self.root.step()
        return self.observer.records[-1]


def links(record: IterationRecord) -> list[tuple[str, str | None, str, bool]]:
    return [(step["component"], step["by"], step["link"], step["worked"]) for step in record["tree"]]


def test_the_tree_tells_who_activated_whom() -> None:
    run = Run()
    record = run.step()
    assert (record["iteration"], record["time_ns"]) == (1, 0)
    assert links(record) == [
        ("Player", None, "root", True),
        ("Perception", "Player", "requires", True),
        ("Search", "Player", "modulates", True),
    ]
    assert record["tree"][2]["parameters"] == {"speed": 0.5, "side": "Side.left"}


def test_steps_without_work_are_told_apart() -> None:
    run = Run()
    run.step()
    assert links(run.step(50)) == [
        ("Player", None, "root", False),
        ("Perception", "Player", "requires", True),
        ("Search", "Player", "modulates", True),
    ]
    assert [worked for *_, worked in links(run.step(10))] == [False, True, False]


def test_a_change_is_told_with_its_transition() -> None:
    run = Run()
    run.step()
    run.world.fallen = True
    player = run.step(100)["tree"][0]
    assert (player["changed_from"], player["state"], player["transition"]) == ("LookForBall", "GetUp", "falls")
    run.world.fallen = False
    player = run.step(100)["tree"][0]
    assert (player["changed_from"], player["state"], player["transition"]) == ("GetUp", "LookForBall", None)
    player = run.step(100)["tree"][0]
    assert player["changed_from"] is None
    assert player["state_time_ns"] == 100_000_000


def test_a_restart_is_no_change() -> None:
    run = Run()
    run.world.fallen = True
    run.step()
    run.world.fallen = False
    run.root.iteration += 3
    player = run.step(100)["tree"][0]
    assert (player["changed_from"], player["state"], player["worked"]) == (None, "LookForBall", True)


def test_done_is_told() -> None:
    run = Run()
    run.world.ball_seen, run.world.ball_distance = True, 10.0
    assert [run.step(100)["tree"][0]["done"] for _ in range(3)] == [False, True, True]


def test_values_are_the_designs_own() -> None:
    tree = Run(values=True).step()["tree"]
    assert tree[0]["values"] == {"side": "Side.left", "kicks": 0, "tries": 1}
    assert tree[1]["values"] == {"ball_seen": False, "ball_distance": 1000.0, "fallen": False}


class Sensor(Component):
    near = 1.5

    @property
    def far(self) -> float:
        return 20.0

    @property
    def broken(self) -> float:
        raise OSError

    def ask(self) -> float:
        return 0.0


class Slots(Sensor):
    __slots__ = ("middle",)

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.middle = 3
        self.own = True


class Asker(Component):
    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.slots = root.component(Slots)
        self._set_states(State("On", lambda _decide=True: None, requires=(self.slots,)))


def test_no_value_of_a_step_is_hidden_wherever_it_is_defined() -> None:
    observer = Observer(values=True)
    Root(Asker, clock=SimulatedClock(), observer=observer).step()
    [record] = observer.records
    expected = {"near": 1.5, "far": 20.0, "middle": 3, "own": True}
    assert record["inputs"] == {"Slots": expected}
    assert [step["values"] for step in record["tree"]] == [{}, expected]


def test_records_are_json_even_with_infinities() -> None:
    run = Run(values=True)
    run.world.ball_distance = float("-inf")
    record = run.step()
    assert json.loads(json.dumps(record, allow_nan=False)) == record
    assert record["tree"][1]["values"]["ball_distance"] == "-inf"


def test_watching_changes_nothing() -> None:
    def run_through(run: Run) -> list[str]:
        for tick in range(200):
            run.world.ball_seen, run.world.fallen = tick % 7 > 2, tick % 31 == 30
            run.world.ball_distance = 3000 - 10 * tick
            run.clock.advance(30_000_000)
            run.root.step()
            run.world.log.append(run.root.main.state)
        return run.world.log

    watched, measured = Run(), Run(measure=True)
    plain = Run()
    plain.root = Root(Player, clock=plain.clock, world=plain.world)
    assert run_through(plain) == run_through(watched) == run_through(measured)
    assert watched.observer.records == measured.observer.records


def test_cycle_times_count_the_works() -> None:
    run = Run(measure=True)
    for _ in range(11):
        run.step(50)
    times = run.root.cycle_times
    assert {name: time.count for name, time in times.items()} == {"Perception": 11, "Search": 11, "Player": 6}
    assert times["Player"].real_frequency_hz == 10.0
    assert 0 < times["Player"].min_ns <= times["Player"].mean_ns <= times["Player"].max_ns
    assert run.root.measure
    assert Run().root.cycle_times == {}


def test_an_observed_mistake_of_a_caller_is_the_same_mistake() -> None:
    class Legs(Component):
        pass

    class Caller(Component):
        def __init__(self, root: Root) -> None:
            super().__init__(root)
            self.legs = root.component(Legs)

        def work(self) -> None:
            self._call(self.legs, speed=1)

    records: list[ErrorRecord] = []
    for observer in (None, Observer()):
        Root(Caller, clock=SimulatedClock(), on_error=records.append, observer=observer).step()
    assert records[0] == records[1]
    assert (records[1].component, records[1].method) == ("Caller", "work")


def test_an_observed_component_calls_again_with_the_same_mistake() -> None:
    class Legs(Component):
        def modulate(self, *, speed: int = 0) -> None:
            del speed

    class Caller(Component):
        frequency_hz = 1.0

        def __init__(self, root: Root) -> None:
            super().__init__(root)
            self.legs = root.component(Legs)

        def work(self) -> None:
            self._call(self.legs, spede=1)

    places = []
    for observer in (None, Observer()):
        clock = SimulatedClock()
        root = Root(Caller, clock=clock, on_error=lambda _record: None, observer=observer)
        for _ in range(3):
            root.step()
            clock.advance(1_000_000)
        places.append(root.errors)
    assert places[0] == places[1]
    assert len(places[1]) == 1


def test_integers_that_python_does_not_print_are_recorded() -> None:
    class Counter(Component):
        def __init__(self, root: Root) -> None:
            super().__init__(root)
            self.total = 10**5000

    observer = Observer(values=True)
    Root(Counter, clock=SimulatedClock(), observer=observer).step()
    assert f'"total": "{hex(10**5000)}"' in json.dumps(observer.records)


def test_only_iterations_with_changes_are_passed_on() -> None:
    def record(number: int, *steps: tuple[str, str, str | None], errors: int = 0) -> Any:
        tree = [{"component": name, "state": state, "changed_from": left} for name, state, left in steps]
        return {"iteration": number, "tree": tree, "errors": [{}] * errors}

    passed: list[Any] = []
    sink = only_changes(passed.append)
    sink(record(1, ("Car", "Drive", None), ("Wheels", "Left", None)))
    sink(record(2, ("Car", "Drive", None), ("Wheels", "Left", None)))
    sink(record(3, ("Car", "Drive", None), ("Wheels", "Right", "Left")))
    sink(record(4, ("Car", "Drive", None), ("Wheels", "Right", None)))
    sink(record(5, ("Car", "Drive", None), ("Wheels", "Right", "Right")))
    sink(record(6, ("Car", "Drive", None)))
    sink(record(7, ("Car", "Drive", None), errors=1))
    sink(record(8, ("Car", "Drive", None)))
    assert [each["iteration"] for each in passed] == [1, 3, 5, 6, 7]
