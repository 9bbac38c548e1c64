"""Binding: what the world lacks is listed at once, and sensors get the types of the project."""

from vicode.bridge import Command, Event, Sensor, World
from vicode.bridge.binding import DeclaredType, Requirement, apply_types, find_declaration_problems, find_missing
from vicode.bridge.frames import FrameError


class Half(World):
    ball = Sensor("BALL")
    drive = Command("DRIVE", "speed")

    @property
    def failing(self) -> float:
        return 1 / 0

    def angle_to(self, x: float, y: float) -> float:
        return x + y


def required(name: str, *parameters: str, is_called: bool = True) -> Requirement:
    return Requirement(
        name=name, description=f"symbol {name}", place="a:1:1", parameters=parameters if is_called else None
    )


def test_everything_that_is_missing_is_listed() -> None:
    requirements = [
        required("ball", is_called=False),
        required("failing", is_called=False),
        required("goal", is_called=False),
        required("angle_to", "x", "y"),
        required("angle_to", "x"),
        required("drive", "speed"),
        required("drive", "speed", "turn"),
        required("kick"),
        required("ball"),
    ]
    assert find_missing(Half(), requirements) == [
        "a:1:1: symbol goal: the world has no goal",
        "a:1:1: symbol angle_to: angle_to: missing a required argument: 'y'",
        "a:1:1: symbol drive: the command has no parameter turn",
        "a:1:1: symbol kick: the world has no kick",
        "a:1:1: symbol ball: ball is no method of the world",
    ]


def test_targets_of_the_protocol_and_repeated_ones() -> None:
    class Wrong(World):
        tick = Sensor("tick")
        robot_name = Event("ROBOT")
        one, two = Sensor("LASER"), Event("LASER")
        error = Command("ERROR")
        laser = Command("LASER")

    assert find_declaration_problems(Wrong) == [
        "target tick is reserved for the protocol",
        "target ROBOT is reserved for the protocol",
        "target ERROR is reserved for the protocol",
        "target LASER is declared twice",
    ]
    assert find_declaration_problems(Half) == []


def test_sensors_get_the_types_of_the_project() -> None:
    class Typed(World):
        distance = Sensor("DISTANCE")
        side = Sensor("SIDE")
        own = Sensor("OWN", int, range=(0, 1), unit="px")
        laser = Sensor("LASER", length=3)
        whistle = Event("WHISTLE")

    side = DeclaredType(value_type=str, elements=("left", "right"))
    metres = DeclaredType(value_type=float, unit="m", bounds=(0, 9))
    apply_types(Typed, dict.fromkeys(("distance", "own", "laser", "whistle"), metres) | {"side": side})
    world = Typed()
    assert (world.distance, world.side, world.own) == (0.0, "left", 0)
    assert [each.unit for each in (Typed.distance, Typed.own, Typed.laser)] == ["m", "px", ""]
    problems = []
    for sensor, raw in ((Typed.distance, b"10"), (Typed.side, b"up"), (Typed.own, b"2"), (Typed.laser, b"10,20,30")):
        try:
            sensor.parameters.convert(raw)
        except FrameError as error:
            problems.append(str(error))
    assert problems == [
        "parameter 1 is 10, expected 0 to 9",
        "found 'up', expected left or right",
        "parameter 1 is 2, expected 0 to 1",
    ]
