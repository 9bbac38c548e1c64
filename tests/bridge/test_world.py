"""A world: typed values of sensors, their age, events in order, commands on change."""

import math
import re
import subprocess
import sys
from typing import Any

import pytest

from tests.bridge.sample_robots import AgingWorld, SampleWorld, WatchedWorld
from vicode.bridge import Command, Event, Sensor, World, cached_per_tick
from vicode.bridge.frames import FrameError
from vicode.bridge.parameters import ParameterTypes
from vicode.bridge.readings import MAX_KEPT

MS = 1_000_000


@pytest.fixture
def world() -> AgingWorld:
    return AgingWorld()


def receive(world: World, target: str, raw: bytes | list[Any], at_ms: float = 0) -> None:
    assert world.bridge.receive(target, raw, round(at_ms * MS))


def tick(world: World, now_ms: float = 0) -> None:
    world.bridge.begin_tick(round(now_ms * MS), round(now_ms * MS))


def end_tick(world: World) -> dict[str, tuple[Any, ...]]:
    world.bridge.end_tick()
    return world.bridge.commands.take()


def test_values_have_the_declared_types(world: AgingWorld) -> None:
    for target, raw in (("AHEAD", b" 2.5"), ("INS", [1, 2, 90]), ("LASER", b"1,2, 3"), ("MODE", b" fast \r")):
        receive(world, target, raw)
    tick(world)
    assert world.range_ahead == 2.5
    assert (world.pose.yaw, world.laser, world.mode) == (90.0, (1.0, 2.0, 3.0), "fast")


def test_before_the_first_line_sensors_read_as_initial(world: AgingWorld) -> None:
    tick(world)
    assert (world.range_ahead, world.pose.x, world.laser, world.mode) == (9.0, 0.0, (0.0, 0.0, 0.0), "")
    assert (world.range_ahead_is_stale, world.range_ahead_age) == (True, math.inf)
    assert world.bridge.readings.age_ns is None


def test_only_the_newest_value_counts(world: AgingWorld) -> None:
    for number in range(10):
        receive(world, "AHEAD", str(number).encode(), number)
    tick(world, 20)
    assert (world.range_ahead, world.range_ahead_age) == (9.0, 0.011)
    assert world.bridge.readings.age_ns == 11 * MS
    assert world.bridge.counts.dropped == 9


def test_a_value_older_than_max_age_is_stale(world: AgingWorld) -> None:
    receive(world, "AHEAD", b"2")
    tick(world, 500)
    assert (world.range_ahead, world.range_ahead_is_stale) == (2.0, False)
    tick(world, 501)
    assert (world.range_ahead, world.range_ahead_is_stale, world.range_ahead_age) == (9.0, True, 0.501)
    assert world.bridge.readings.age_ns is None
    assert world.bridge.counts.late == 0
    receive(world, "AHEAD", b"3")
    assert (world.range_ahead, world.bridge.counts.late) == (9.0, 1)


def test_a_malformed_value_is_reported_and_the_one_before_stays(world: AgingWorld) -> None:
    receive(world, "INS", b"1,2,3", 0)
    tick(world, 10)
    assert world.pose.x == 1
    receive(world, "INS", b"4,zzz,6", 10)
    tick(world, 20)
    assert (world.pose.x, world.pose_age) == (1, 0.02)
    assert world.bridge.take_problems() == ["INS: y is 'zzz', expected a number"]
    assert (world.bridge.take_problems(), world.bridge.counts.malformed) == ([], 1)


@pytest.mark.parametrize(
    ("types", "raw", "message"),
    [
        (ParameterTypes(value_type=float, least=2, most=2, is_list=True), b"1", "found 1 parameters, expected 2"),
        (ParameterTypes(value_type=float, least=1, most=3, is_list=True), b"", "found 0 parameters, expected 1 to 3"),
        (ParameterTypes(value_type=float), b"nan", "parameter 1 is nan, expected a finite number"),
        (ParameterTypes(value_type=float), b"1e999", "parameter 1 is inf, expected a finite number"),
        (ParameterTypes(value_type=float, bounds=(0, 20)), b"20.5", "parameter 1 is 20.5, expected 0 to 20"),
        (ParameterTypes(value_type=float, bounds=(0, 20)), ["a"], "parameter 1 is 'a', expected a number"),
        (ParameterTypes(value_type=float), b"1_0", "parameter 1 is '1_0', expected a number"),
        (ParameterTypes(value_type=float), ["\u0663"], "expected a number"),
        (ParameterTypes(value_type=float), [True], "parameter 1 is True, expected a number"),
        (ParameterTypes(value_type=float), b"\xff", "expected UTF-8"),
        (ParameterTypes(value_type=int), b"1.5", "parameter 1 is '1.5', expected an integer"),
        (ParameterTypes(value_type=int), ["1e999"], "parameter 1 is '1e999', expected an integer"),
        (ParameterTypes(value_type=int, fields=("a",)), ["x" * 99], "a is 'x*"),
        (ParameterTypes(value_type=bool), b"maybe", "parameter 1 is 'maybe', expected true or false"),
        (ParameterTypes(value_type=str), [1], "parameter 1 is 1, expected a text"),
        (ParameterTypes(value_type=str, elements=("left", "right")), b"up", "found 'up', expected left or right"),
    ],
)
def test_what_is_wrong_with_parameters(types: ParameterTypes, raw: Any, message: str) -> None:
    with pytest.raises(FrameError, match=message):
        types.convert(raw)


@pytest.mark.parametrize(
    ("types", "raw", "value"),
    [
        (ParameterTypes(value_type=int), b"5.0", 5),
        (ParameterTypes(value_type=int), [7], 7),
        (ParameterTypes(value_type=bool), b"TRUE", True),
        (ParameterTypes(value_type=bool), [0], False),
        (ParameterTypes(value_type=bool), [False], False),
        (ParameterTypes(value_type=float), ["2.5"], 2.5),
        (ParameterTypes(value_type=str, elements=("left", "right")), ["right"], "right"),
        (ParameterTypes(value_type=float, least=0, most=2, is_list=True), [], ()),
    ],
)
def test_parameters_in_both_languages(types: ParameterTypes, raw: Any, value: Any) -> None:
    assert types.convert(raw) == value
    assert type(types.convert(raw)) is type(value)


def test_each_event_is_visible_in_one_tick_in_order(world: AgingWorld) -> None:
    for target, raw in (("WHISTLE", b""), ("BUTTON", b"1"), ("BUTTON", b"2"), ("WHISTLE", b""), ("BUTTON", b"x")):
        receive(world, target, raw)
    seen = []
    for _tick in range(4):
        tick(world)
        seen.append((world.whistle, world.button))
    assert seen == [(True, 1), (True, 2), (False, -1), (False, -1)]
    assert world.bridge.take_problems() == ["BUTTON: parameter 1 is 'x', expected an integer"]


def test_of_too_many_events_the_oldest_are_dropped(world: AgingWorld) -> None:
    for number in range(100):
        receive(world, "BUTTON", [number])
    tick(world)
    assert (world.button, world.bridge.counts.events_dropped) == (36, 36)


def test_a_command_is_sent_when_it_changes_and_when_it_is_called_again(world: AgingWorld) -> None:
    sent = []
    for call in ((1.0, 0), (1.0, 0), (2.0, 5.5), None, (2.0, 5.5)):
        if call is not None:
            world.drive(*call)
        sent.append(end_tick(world))
    assert sent == [{"DRIVE": (1, 0)}, {}, {"DRIVE": (2, 5.5)}, {}, {"DRIVE": (2, 5.5)}]


def test_a_command_with_a_rate_is_repeated(world: AgingWorld) -> None:
    sent = 0
    for number in range(20):
        tick(world, number * 50)
        world.lamp(brightness=1)
        sent += "LAMP" in end_tick(world)
    assert sent == 10


def test_wrong_calls_of_a_command(world: AgingWorld) -> None:
    with pytest.raises(TypeError, match="drive has no parameter sped; it has speed, turn"):
        world.drive(sped=1)
    with pytest.raises(TypeError, match="drive takes 2 parameters, 3 were given"):
        world.drive(1, 2, 3)
    with pytest.raises(ValueError, match="speed is nan"):
        world.drive(speed=math.nan)
    with pytest.raises(TypeError, match="2 parameters, but stop has 1"):
        Command("X", "a", "b", stop=(1,))


def test_commands_that_wait_are_replaced_by_newer_ones(world: AgingWorld) -> None:
    for speed in (1, 2, 3):
        world.drive(speed=speed)
        world.lamp(speed)
        world.bridge.commands.end_tick(speed * 1_000 * MS)
    assert world.bridge.commands.take() == {"DRIVE": (3, 0), "LAMP": (3,)}
    assert world.bridge.counts.commands_dropped == 4
    assert world.bridge.commands.stop() == {"DRIVE": (0, 0)}


def test_a_world_inherits_and_replaces_declarations() -> None:
    class Better(SampleWorld):
        range_ahead = Sensor("FRONT")
        whistle = None  # type: ignore[assignment]
        flag = Event("FLAG")

        def __init__(self, number: int) -> None:
            self.number = number

    world = Better(3)
    assert (world.number, Better.range_ahead.target) == (3, "FRONT")
    assert world.bridge.targets == ("FRONT", "INS", "LASER", "MODE", "BUTTON", "FLAG")
    assert not world.bridge.receive("WHISTLE", b"", 0)
    assert world.bridge.counts.unknown == 1


def test_worlds_do_not_share_values(world: AgingWorld) -> None:
    receive(world, "AHEAD", b"2")
    other = AgingWorld()
    tick(world)
    tick(other)
    assert (world.range_ahead, other.range_ahead) == (2.0, 9.0)


def test_a_derived_value_is_computed_once_per_tick() -> None:
    class Deriving(SampleWorld):
        computed = 0

        @cached_per_tick
        def nearest(self) -> float:
            """The least distance."""
            self.computed += 1
            return min(self.laser)

    world = Deriving()
    for number in range(2):
        receive(world, "LASER", [5, 4 + number, 6])
        tick(world)
        assert (world.nearest, world.nearest, world.computed) == (4 + number, 4 + number, number + 1)
    assert Deriving.nearest.__doc__ == "The least distance."


def test_worlds_need_the_standard_library_only() -> None:
    program = "import sys, vicode.bridge; print(*(name for name in sys.modules if name.startswith('vicode.')))"
    listed = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout.split()
    assert listed
    assert all(name.startswith("vicode.bridge") for name in listed)


class FoldingWorld(World):
    encoder = Sensor("ENC", int, fields=("left", "right"), fold="sum")
    nearest = Sensor("NEAR", float, fold="minimum")
    fastest = Sensor("FAST", float, fold="maximum", initial=-1.0)
    marks = Sensor("MARK", str, fold="all")
    bumper = Event("BUMP", fold="all")
    key = Event("KEY", int, fold="all")


def test_a_sensor_is_folded_between_ticks_as_declared() -> None:
    world = FoldingWorld()
    tick(world)
    assert (world.encoder, world.nearest, world.fastest, world.marks, world.bumper, world.key) == (
        *((0, 0), 0.0, -1.0),
        *((), 0, ()),
    )
    for number in range(1, 11):
        receive(world, "ENC", f"1,{number}".encode(), number)
        for target in ("NEAR", "FAST"):
            receive(world, target, [abs(number - 5)], number)
        receive(world, "MARK", [f"m{number}"], number)
        receive(world, "BUMP", b"", number)
        receive(world, "KEY", [number], number)
    tick(world, 20)
    assert (world.encoder.left, world.encoder.right, world.nearest, world.fastest) == (10, 55, 0.0, 5.0)
    assert world.marks == tuple(f"m{number}" for number in range(1, 11))
    assert (world.bumper, world.key) == (10, tuple(range(1, 11)))
    assert (world.encoder_age, world.bridge.counts.dropped, world.bridge.counts.events_dropped) == (0.01, 0, 0)
    tick(world, 70)
    assert (world.encoder, world.nearest, world.fastest) == ((0, 0), 0.0, 5.0)
    assert (world.marks, world.bumper, world.key) == ((), 0, ())


def test_no_increment_is_lost_whatever_the_ticks() -> None:
    world = FoldingWorld()
    total = 0
    for number in range(1_000):
        receive(world, "ENC", b"1,0", number)
        if number % 7 == 0 or number == 999:
            tick(world, number)
            total += world.encoder.left
    assert total == 1_000


def test_a_malformed_value_is_no_part_of_a_fold() -> None:
    world = FoldingWorld()
    for raw in (b"1,2", b"1", b"x,1", b"3,4"):
        receive(world, "ENC", raw)
    tick(world)
    assert world.encoder == (4, 6)
    assert world.bridge.take_problems() == [
        "ENC: found 1 parameters, expected 2",
        "ENC: left is 'x', expected an integer",
    ]


def test_drops_are_reported_once_per_second_with_their_number() -> None:
    world = FoldingWorld()
    for _number in range(MAX_KEPT + 5):
        receive(world, "MARK", ["m"])
        receive(world, "KEY", [1])
    tick(world)
    assert (len(world.marks), len(world.key), world.bridge.counts.events_dropped) == (MAX_KEPT, MAX_KEPT, 10)
    assert world.bridge.take_notices() == [
        f"MARK: a value was dropped; {MAX_KEPT} are kept for a tick (5 times)",
        f"KEY: an event was dropped; {MAX_KEPT} are kept for a tick (5 times)",
    ]
    other = SampleWorld()
    reports = []
    for now_ms in range(0, 2_000, 50):
        for _event in range(10):
            receive(other, "BUTTON", [1], now_ms)
        tick(other, now_ms)
        reports += other.bridge.take_notices()
    # Nine of ten events of a tick wait; from the eighth tick on, there is no room for them.
    assert [re.sub(r":.*; .* \(", " (", each) for each in reports] == ["BUTTON (9 times)", "BUTTON (180 times)"]
    assert reports[0].startswith("BUTTON: an event was dropped: a tick reads one per target, and 64 wait; send fewer")


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"fold": "newest one"}, "X: fold is 'newest one', expected one of: newest, sum, minimum, maximum, all"),
        ({"fold": "sum", "length": (1, 2)}, "X: fold sum needs a fixed number of parameters"),
    ],
)
def test_a_fold_that_is_refused(keys: dict[str, Any], message: str) -> None:
    with pytest.raises(TypeError, match=message):
        Sensor("X", float, **keys)
    with pytest.raises(TypeError, match="X: fold maximum needs numbers, the value is of type str"):
        Sensor("X", str, fold="maximum")
    with pytest.raises(TypeError, match="X: fold is 'sum'; an event has fold=\"all\" or none"):
        Event("X", fold="sum")  # type: ignore[arg-type]


def drive(world: SampleWorld, speed: float | None) -> dict[str, tuple[Any, ...]]:
    """Drive in this tick, and return the commands to send."""
    if speed is not None:
        world.drive(speed)
    world.bridge.end_tick()
    return world.bridge.commands.take()


def test_a_robot_that_falls_silent_is_stopped() -> None:
    world = WatchedWorld()
    sent = []
    for number in range(50):
        if number < 10 or number >= 45:
            receive(world, "AHEAD", b"5", number * 50)
        tick(world, number * 50)
        sent.append((number, world.at_rest, drive(world, 0.5)))
    assert [(number, commands) for number, _rests, commands in sent if commands] == [
        (0, {"DRIVE": (0.5, 0)}),
        (30, {"DRIVE": (0, 0)}),
        (45, {"DRIVE": (0.5, 0)}),
    ]
    assert [number for number, rests, _commands in sent if rests] == list(range(30, 45))
    assert world.bridge.take_notices() == ["commands are at rest: nothing has arrived for 1 s"]
    assert world.bridge.counts.rests == 1


def test_what_a_behavior_stopped_calling_is_stopped_too() -> None:
    world = WatchedWorld()
    receive(world, "AHEAD", b"5")
    tick(world)
    assert drive(world, 0.5) == {"DRIVE": (0.5, 0)}
    tick(world, 50)
    assert drive(world, None) == {}
    tick(world, 2_000)
    # A lamp has nothing to stop, and goes on.
    world.lamp(3)
    assert drive(world, None) == {"LAMP": (3,), "DRIVE": (0, 0)}


def test_a_lost_sensor_stops_a_robot_that_sends_others() -> None:
    world = AgingWorld()
    receive(world, "AHEAD", b"5")
    rests = []
    for now_ms in range(0, 1_000, 50):
        receive(world, "INS", b"1,2,3", now_ms)
        tick(world, now_ms)
        rests.append((now_ms, drive(world, 0.5)))
    assert [each for each in rests if each[1]] == [(0, {"DRIVE": (0.5, 0)}), (550, {"DRIVE": (0, 0)})]
    assert world.bridge.take_notices() == ["commands are at rest: AHEAD is older than 0.5 s"]


def test_the_watchdog_can_be_off() -> None:
    class Trusting(SampleWorld):
        range_ahead = Sensor("AHEAD", float, max_age=0.5, watchdog=False)

    for world, target in ((Trusting(), "AHEAD"), (AgingWorld(), "INS")):
        # Of a sensor that was never sent, nobody knows whether the robot has it.
        receive(world, target, b"1" if target == "AHEAD" else b"1,2,3")
        tick(world, 60_000)
        assert (world.at_rest, world.input_age, world.range_ahead_is_stale) == (False, 60.0, True)
        assert drive(world, 0.5) == {"DRIVE": (0.5, 0)}
