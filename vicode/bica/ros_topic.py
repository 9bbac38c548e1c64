"""A component whose outputs are read from a topic of ROS 2, or whose parameters are published to one."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from enum import Enum
from typing import TYPE_CHECKING, Any

from . import ros_session
from .clock import SimulatedClock
from .component import Component
from .control import Constant, ControlError
from .errors import NetworkError, describe_exception, print_error
from .ros_messages import FieldError, MessageField, find_field, message_fields

if TYPE_CHECKING:
    from .base_root import BaseRoot
    from .errors import ErrorRecord

_MAX_INT = 2**53
_INT_BITS = {
    "int8": 8,
    "byte": 8,
    "uint8": 8,
    "char": 8,
    "octet": 8,
    "int16": 16,
    "uint16": 16,
    "int32": 32,
    "uint32": 32,
}
_MAX_REPORTS = 32


class TopicComponent(Component):
    """Reads the newest message of a topic in each step, or publishes its parameters in each step.

    Outputs whose value is not finite keep the last one; those of an array without finite items get their initial value.
    When it is no longer stepped, when the robot is held, and at the end, it publishes the default parameters once.

    Args:
        root: The root.
        topic: The name of the topic, such as /scan.
        type_: The message type, such as sensor_msgs/msg/LaserScan.
        outputs: Fields by output, such as `pose.x` or `min(ranges)`.
        parameters: Fields by parameter.
        frame: The `frame_id` of published messages with a header.
        max_age: Seconds after which data is too old.
        tunable: The constants that topics `/ROOT/set/NAME` may set, and their limits.

    Attributes:
        data_age: Seconds since the newest message was received; infinite before.
        is_alive: Whether a message was received and is not older than `max_age`.

    Raises:
        NetworkError: A package is not installed, the type or a field is unknown, a parameter has no default, or there
            is no network.
    """

    def __init__(
        self,
        root: BaseRoot,
        topic: str,
        type_: str,
        *,
        outputs: Mapping[str, str] | None = None,
        parameters: Mapping[str, str] | None = None,
        frame: str = "",
        max_age: float = 1.0,
        tunable: Mapping[str, tuple[float, float] | None] | None = None,
    ) -> None:
        super().__init__(root)
        self.data_age = float("inf")
        self.is_alive = False
        self._topic, self._type, self._frame, self._max_age = topic, type_, frame, max_age
        try:
            self._outputs = {name: find_field(type_, source) for name, source in (outputs or {}).items()}
            self._parameters = {name: find_field(type_, field) for name, field in (parameters or {}).items()}
        except FieldError as error:
            raise NetworkError(f"{topic}: {error}") from error
        self._stop_values = getattr(type(self).modulate, "__kwdefaults__", None) or {}
        if missing := sorted(self._parameters.keys() - self._stop_values.keys()):
            raise NetworkError(f"{topic}: modulate() has no default for '{missing[0]}', which would stop the robot")
        session = ros_session.open_session()
        if isinstance(root.clock, SimulatedClock) and not os.environ.get(ros_session.BAG):
            raise NetworkError(f"{topic}: topics need --real-time: other programs do not wait for simulated time")
        self._reader = session.reader(topic, type_) if outputs else None
        self._write = session.writer(topic, type_) if parameters else None
        self._message = ros_session.make_message(type_) if parameters else None
        self._received_ns: int | None = None
        self._reported: set[str] = set()
        self._likes: dict[str, Any] = {}
        self._has_stopped = True
        _watch_root(root, tunable or {})
        root.holders.append(self.publish_stop)

    def work(self) -> None:
        """Read the newest message, or publish the parameters."""
        if self._reader is not None:
            self._read(self._reader)
        if self._write is not None:
            self._publish({name: self.__dict__[name] for name in self._parameters})
            self._has_stopped = False

    def publish_stop(self) -> None:
        """Publish the default parameters, unless they were published last."""
        if not self._has_stopped:
            self._has_stopped = True
            self._publish(self._stop_values)

    def close(self) -> None:
        self.publish_stop()

    def _read(self, reader: ros_session.TopicReader) -> None:
        now_ns = self.root.now_ns
        if not self._likes:
            self._likes = {name: self.__dict__[name] for name in self._outputs}
        try:
            message = reader.take(now_ns)
            if message is not None:
                values = {name: self._convert(name, field, message) for name, field in self._outputs.items()}
                self.__dict__.update(values)
                self._received_ns = now_ns
        except Exception as error:
            # Other programs may send anything, and the library raises many types of exceptions.
            self._report(f"sends what cannot be read: {describe_exception(error)[:200]}")
        if self._received_ns is not None:
            self.data_age = (now_ns - self._received_ns) / 1e9
        self.is_alive = self.data_age <= self._max_age

    def _convert(self, name: str, field: MessageField, message: Any) -> Any:
        value, like = field.read(message), self._likes[name]
        if value is None:
            return like if field.fold else self.__dict__[name]
        if isinstance(like, Enum):
            elements = list(type(like))
            if isinstance(value, str):
                return type(like)[value]
            if not 0 <= value < len(elements):
                raise ValueError(f"{name}: {type(like).__name__} has no element {value}")
            return elements[value]
        if isinstance(like, int) and not isinstance(like, bool):
            return max(-_MAX_INT, min(_MAX_INT, int(value)))
        return type(like)(value)

    def _publish(self, values: Mapping[str, Any]) -> None:
        message = self._message
        header = getattr(message, "header", None)
        if header is not None and hasattr(header, "stamp"):
            header.stamp.sec, header.stamp.nanosec = divmod(time.time_ns(), 1_000_000_000)
            header.frame_id = self._frame
        for name, field in self._parameters.items():
            place = message
            for part in field.path[:-1]:
                place = getattr(place, part)
            setattr(place, field.path[-1], _to_field(values[name], field, type(place)))
        if self._write is not None:
            try:
                self._write(message)
            except Exception as error:
                self._report(f"cannot be written: {describe_exception(error)[:200]}")

    def _report(self, message: str) -> None:
        if message not in self._reported and len(self._reported) < _MAX_REPORTS:
            self._reported.add(message)
            print_error(f"{self._topic} {message} (reported once)", kind="warning")


def _to_field(value: Any, field: MessageField, owner: type) -> Any:
    """Convert a parameter to the type of a field; integers are limited to what the field holds."""
    if isinstance(value, Enum):
        return value.name if field.kind == "string" else list(type(value)).index(value)
    if field.kind != "int":
        return {"float": float, "bool": bool, "string": str}[field.kind](value)
    package, _msg, _dds, name = owner.__idl_typename__.split(".")  # type: ignore[attr-defined]
    base = dict(message_fields(f"{package}/msg/{name.removesuffix('_')}"))[field.path[-1]][1][0]
    bits = _INT_BITS.get(base, 64)
    is_signed = base.startswith("int")
    low, high = (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) if is_signed else (0, 2**bits - 1)
    return max(low, min(high, int(value)))


def _watch_root(root: BaseRoot, tunable: Mapping[str, tuple[float, float] | None]) -> None:
    """Observe a root once."""
    if not any(isinstance(each, _RootTopics) for each in root.observers):
        root.observe(_RootTopics(tunable))


def _open_constants(root: BaseRoot, tunable: Mapping[str, tuple[float, float] | None]) -> Iterator[_ConstantTopic]:
    for name, limits in tunable.items():
        # A component of the project may use it that is not part of this root.
        with suppress(ControlError):
            try:
                yield _ConstantTopic(root, name, limits)
            except NetworkError as error:
                print_error(str(error), kind="warning")


class _ConstantTopic:
    """Sets a constant to the newest message of a topic between two iterations; wrong values are reported once."""

    def __init__(self, root: BaseRoot, name: str, limits: tuple[float, float] | None) -> None:
        self._constant, self._limits, self._is_reported = Constant(root, name), limits, False
        type_ = {bool: "Bool", int: "Int64", float: "Float64"}.get(type(self._constant.value), "String")
        self._topic = f"/{type(root.main).__name__}/set/{name}"
        self._reader = ros_session.open_session().reader(self._topic, f"std_msgs/msg/{type_}", is_expected=False)

    def read(self, now_ns: int) -> None:
        try:
            message = self._reader.take(now_ns)
            if message is not None:
                self._constant.set(message.data, self._limits)
        except Exception as error:
            # The library raises many types of exceptions for malformed messages.
            if not self._is_reported:
                self._is_reported = True
                print_error(f"{self._topic} is ignored: {describe_exception(error)} (reported once)", kind="warning")


class _RootTopics:
    """Publishes the active states of a root when they change, and the stop commands of components that become inactive.

    The topic `/ROOT/states` is latched: who joins late receives the newest message. Its text names the active
    components with their states, such as "Player.FollowBall Turn.Left".
    """

    def __init__(self, tunable: Mapping[str, tuple[float, float] | None]) -> None:
        self._tunable, self._constants = tunable, list[_ConstantTopic]()
        self._write: Callable[[Any], None] | None = None
        self._text: str | None = None

    def attach(self, component: Component, /) -> None:
        """Nothing is measured."""

    def add_error(self, error: ErrorRecord, /) -> None:
        """Errors are printed by the root."""

    def observe_iteration(self, root: BaseRoot, step: Callable[[], None], /) -> None:
        for constant in self._constants:
            constant.read(root.now_ns)
        step()
        for component in root.components:
            if isinstance(component, TopicComponent) and component._stepped_in != root.iteration:
                component.publish_stop()
        text = " ".join(f"{component}.{state}" for component, state in root.active_states)
        if text != self._text:
            self._text = text
            if self._write is None:
                self._constants = list(_open_constants(root, self._tunable))
                topic = f"/{type(root.main).__name__}/states"
                self._write = ros_session.open_session().writer(topic, "std_msgs/msg/String", latched=True)
            message = ros_session.make_message("std_msgs/msg/String")
            message.data = text
            self._write(message)
