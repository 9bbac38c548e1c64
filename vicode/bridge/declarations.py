"""What a world declares: sensors and events that a robot sends, and commands that it obeys."""

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, Literal, Self, get_args, overload

from vicode.bridge.parameters import ParameterTypes

if TYPE_CHECKING:
    from vicode.bridge.world import World

_NS_PER_S = 1_000_000_000

Fold = Literal["newest", "sum", "minimum", "maximum", "all"]
"""How the values that arrive between two ticks become one."""
ARITHMETIC_FOLDS: tuple[Fold, ...] = ("sum", "minimum", "maximum")


class Sensor:
    """A value that the robot sends again and again; `fold` says what a tick reads of the values since the tick before.

    `laser = Sensor("LASER", float, length=181)` also gives the world `laser_age`, in seconds, and `laser_is_stale`.

    Args:
        target: The name in lines.
        value_type: float, int, bool or str; by default that of the project's output of the same name, or else float.
        length: The number of parameters, or the least and the greatest number: the value is a tuple.
        fields: Names of the parameters: the value is a named tuple.
        range: The least and the greatest number; a line with another one is malformed.
        unit: For documentation.
        max_age: In seconds; an older value is stale: the sensor reads as `initial` then, and commands go to rest.
        watchdog: Whether a stale value lets commands go to rest.
        required: Whether the behavior starts only when a value has arrived.
        initial: The value before the first line, by default zeros.
        fold: "newest"; "sum", "minimum" and "maximum" of each parameter; "all" values as a tuple.
    """

    def __init__(  # noqa: PLR0913 - the keys of a declaration
        self,
        target: str,
        value_type: type[Any] | None = None,
        /,
        *,
        length: int | tuple[int, int] | None = None,
        fields: Sequence[str] = (),
        range: tuple[float, float] | None = None,  # noqa: A002 - the name in project.yaml
        unit: str = "",
        max_age: float | None = None,
        watchdog: bool = True,
        required: bool = False,
        initial: Any = None,
        fold: Fold = "newest",
    ) -> None:
        least, most = length if isinstance(length, tuple) else (length or len(fields) or 1,) * 2
        self.target, self.unit, self.name = target, unit, ""
        self.parameters = ParameterTypes(
            value_type=value_type,
            least=least,
            most=most,
            fields=tuple(fields),
            is_list=length is not None,
            bounds=range,
        )
        self.max_age_ns = math.inf if max_age is None else round(max_age * _NS_PER_S)
        self.watchdog, self.required, self.fold = watchdog, required, fold
        self._initial = initial
        if fold not in get_args(Fold):
            raise TypeError(f"{target}: fold is {fold!r}, expected one of: {', '.join(get_args(Fold))}")
        if problem := self.fold_problem:
            raise TypeError(f"{target}: {problem}")

    @property
    def fold_problem(self) -> str:
        """Why the values cannot be folded as declared; "" if they can."""
        if self.fold not in ARITHMETIC_FOLDS:
            return ""
        if self.parameters.value_type not in (None, float, int):
            return f"fold {self.fold} needs numbers, the value is of type {self.parameters.value_type.__name__}"
        if self.parameters.least != self.parameters.most:
            return f"fold {self.fold} needs a fixed number of parameters"
        return ""

    def __set_name__(self, owner: type[Any], name: str) -> None:
        self.name = name
        for suffix, read in (("age", _read_age), ("is_stale", _read_is_stale)):
            if f"{name}_{suffix}" not in vars(owner):
                setattr(owner, f"{name}_{suffix}", property(partial(read, self)))

    @property
    def initial(self) -> Any:
        if self._initial is not None:
            return self._initial
        return () if self.fold == "all" else self.parameters.default()

    @overload
    def __get__(self, world: None, owner: type[Any]) -> Self: ...
    @overload
    def __get__(self, world: "World", owner: type[Any]) -> Any: ...
    def __get__(self, world: "World | None", owner: type[Any]) -> Any:
        return self if world is None else world.bridge.readings.read(self)


class Event:
    """Something that happens at one moment. Events are kept in order; each is visible for one tick.

    Without a type, an event reads as true in its tick and as false otherwise. With one, it reads as its parameter (with
    `fields`, as a named tuple) in its tick, and as `initial` otherwise.

    With `fold="all"`, a tick sees all events since the tick before: their number, or with a type, the tuple of their
    parameters.
    """

    def __init__(
        self,
        target: str,
        value_type: type[Any] | None = None,
        /,
        *,
        fields: Sequence[str] = (),
        initial: Any = None,
        fold: Literal["", "all"] = "",
    ) -> None:
        if fold not in ("", "all"):
            raise TypeError(f'{target}: fold is {fold!r}; an event has fold="all" or none')
        self.target, self.name, self.reads_all = target, "", fold == "all"
        self.has_value = value_type is not None or bool(fields)
        number = len(fields) or 1
        self.parameters = ParameterTypes(value_type=value_type, least=number, most=number, fields=tuple(fields))
        if self.reads_all:
            self.initial: Any = () if self.has_value else 0
        else:
            self.initial = (self.parameters.default() if initial is None else initial) if self.has_value else False

    def __set_name__(self, owner: type[Any], name: str) -> None:
        self.name = name

    @overload
    def __get__(self, world: None, owner: type[Any]) -> Self: ...
    @overload
    def __get__(self, world: "World", owner: type[Any]) -> Any: ...
    def __get__(self, world: "World | None", owner: type[Any]) -> Any:
        return self if world is None else world.bridge.events.read(self)


class Command:
    """A command of the robot; the world has it as a method with these parameters, which are 0 if omitted.

    It is sent when its parameters change, and when it is called again after a tick without a call.

    Args:
        target: The name in lines.
        parameters: Names of the parameters, in the order of the line.
        stop: Values that stop the robot, by default zeros; None if there is nothing to stop.
        rate: In Hz: sent at this rate while it is called, changed or not.
    """

    def __init__(
        self, target: str, /, *parameters: str, stop: Sequence[Any] | None = (), rate: float | None = None
    ) -> None:
        if stop and len(stop) != len(parameters):
            raise TypeError(f"{target} has {len(parameters)} parameters, but stop has {len(stop)}")
        self.target, self.parameters, self.name = target, parameters, ""
        self.stop = None if stop is None else tuple(stop) or (0,) * len(parameters)
        self.period_ns = 0 if rate is None else round(_NS_PER_S / rate)

    def __set_name__(self, owner: type[Any], name: str) -> None:
        self.name = name

    @overload
    def __get__(self, world: None, owner: type[Any]) -> Self: ...
    @overload
    def __get__(self, world: "World", owner: type[Any]) -> Callable[..., None]: ...
    def __get__(self, world: "World | None", owner: type[Any]) -> Any:
        return self if world is None else partial(self._call, world)

    def _call(self, world: "World", *positional: Any, **named: Any) -> None:
        world.bridge.commands.call(self, self._bind(positional, named))

    def _bind(self, positional: tuple[Any, ...], named: dict[str, Any]) -> tuple[Any, ...]:
        if len(positional) > len(self.parameters):
            raise TypeError(f"{self.name} takes {len(self.parameters)} parameters, {len(positional)} were given")
        values = dict(zip(self.parameters, positional, strict=False)) | named
        if len(values) > len(self.parameters) or not values.keys() <= set(self.parameters):
            unknown = ", ".join(sorted(values.keys() - set(self.parameters)))
            raise TypeError(f"{self.name} has no parameter {unknown}; it has {', '.join(self.parameters) or 'none'}")
        for name, value in values.items():
            if isinstance(value, float) and not math.isfinite(value):
                raise ValueError(f"{self.name}: {name} is {value}, which no robot can do")
        return tuple(values.get(name, 0) for name in self.parameters)


def cached_per_tick(compute: Callable[[Any], Any]) -> property:
    """A property of a world that is computed when it is read, at most once per tick, as sensors do not change in it."""

    def read(world: "World") -> Any:
        cache = world.bridge.cache
        if compute not in cache:
            cache[compute] = compute(world)
        return cache[compute]

    return property(read, doc=compute.__doc__)


def _read_age(sensor: Sensor, world: "World") -> float:
    return world.bridge.readings.age_s(sensor)


def _read_is_stale(sensor: Sensor, world: "World") -> bool:
    return world.bridge.readings.is_stale(sensor)
