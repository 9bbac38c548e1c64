"""Topics of ROS 2 over DDS, the only module that imports cyclonedds; or from a bag, in simulated time.

Without the variables ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET and CYCLONEDDS_URI, only programs of this machine are found.
"""

from __future__ import annotations

import os
import types
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, Protocol

from .errors import NetworkError, print_error
from .ros_messages import INSTALL, FieldType, is_base, is_fixed_array, is_message, message_fields, read_bag

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

BAG = "VICODE_ROS_BAG"
"""The variable that names a bag, which takes the place of the network."""
_MAX_DOMAIN = 232
_LOOPBACK = """<CycloneDDS><Domain>
<General><Interfaces><NetworkInterface address="127.0.0.1"/></Interfaces>
<AllowMulticast>false</AllowMulticast></General>
<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>
<Peers><Peer address="127.0.0.1"/></Peers></Discovery>
</Domain></CycloneDDS>"""
_PRIMITIVES = {"byte": "uint8", "char": "uint8", "octet": "uint8"}


class TopicReader(Protocol):
    """Holds the newest message of a topic."""

    def take(self, now_ns: int, /) -> Any:
        """Return the newest message if it is new, else None; raises an exception for one that cannot be read."""


class Session(Protocol):
    """A connection to topics."""

    def reader(self, topic: str, type_: str, *, is_expected: bool = True) -> TopicReader: ...
    def writer(self, topic: str, type_: str, *, latched: bool = False) -> Callable[[Any], None]: ...


def open_session() -> Session:
    """Return the session of the process: of the bag VICODE_ROS_BAG, or else of the domain ROS_DOMAIN_ID.

    Raises:
        NetworkError: A package is not installed, or there is no network.
    """
    bag = os.environ.get(BAG, "")
    return _BagSession(bag) if bag else _open_domain(_domain_id())


@cache
def message_class(type_: str) -> Any:
    """The class of a message type, a dataclass whose fields have no defaults.

    Raises:
        NetworkError: cyclonedds is not installed.
    """
    idl = _import_idl()
    package, _msg, short = type_.split("/")
    annotations = {name: _idl_type(field) for name, field in message_fields(type_)}
    name = f"{short}_"
    body = {"__annotations__": annotations, "__module__": __name__}
    made = types.new_class(
        name, (idl.IdlStruct,), {"typename": f"{package}.msg.dds_.{name}"}, lambda own: own.update(body)
    )
    return dataclass(made)


def make_message(type_: str) -> Any:
    """A message of zeros, empty texts and empty sequences."""
    return message_class(type_)(**{name: _zero(field) for name, field in message_fields(type_)})


class _DomainSession:
    """The participant of a domain."""

    def __init__(self, domain_id: int) -> None:
        dds, core, domain = _import_dds()
        self._dds, self._core = dds, core
        is_local = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "") != "SUBNET"
        try:
            # The domain ends with its object.
            own = is_local and "CYCLONEDDS_URI" not in os.environ
            self._domain = domain.Domain(domain_id, _LOOPBACK) if own else None
            self._participant = domain.DomainParticipant(domain_id)
        except core.DDSException as error:
            raise NetworkError(f"DDS cannot open domain {domain_id}: {error}") from error

    def reader(self, topic: str, type_: str, *, is_expected: bool = True) -> TopicReader:  # noqa: ARG002
        policy = self._core.Policy
        qos = self._core.Qos(policy.Reliability.BestEffort, policy.Durability.Volatile, policy.History.KeepLast(1))
        return _DomainReader(self._dds.sub.DataReader(self._participant, self._topic(topic, type_), qos=qos), type_)

    def writer(self, topic: str, type_: str, *, latched: bool = False) -> Callable[[Any], None]:
        policy = self._core.Policy
        durability = policy.Durability.TransientLocal if latched else policy.Durability.Volatile
        # Reliable, but it does not wait for slow readers.
        qos = self._core.Qos(policy.Reliability.Reliable(0), durability, policy.History.KeepLast(1))
        writer = self._dds.pub.DataWriter(self._participant, self._topic(topic, type_), qos=qos)
        write: Callable[[Any], None] = writer.write
        return write

    def _topic(self, topic: str, type_: str) -> Any:
        return self._dds.topic.Topic(self._participant, f"rt/{topic.lstrip('/')}", message_class(type_))


class _DomainReader:
    def __init__(self, reader: Any, type_: str) -> None:
        self._reader, self._class = reader, message_class(type_)

    def take(self, _now_ns: int) -> Any:
        return next((each for each in self._reader.take(1) if isinstance(each, self._class)), None)


class _BagSession:
    """Plays the topics of a bag; what is written is dropped."""

    def __init__(self, path: str) -> None:
        self._path = path

    def reader(self, topic: str, type_: str, *, is_expected: bool = True) -> TopicReader:
        messages, _duration = read_bag(self._path, (topic,))
        if is_expected and not messages[topic]:
            print_error(f"the bag {self._path} has no messages on {topic}", kind="warning")
        others = {own for _time, own, _content in messages[topic]} - {type_}
        if others:
            raise NetworkError(f"{topic} has the type {others.pop()} in the bag {self._path}, not {type_}")
        return _BagReader([(time_ns, content) for time_ns, _type, content in messages[topic]], message_class(type_))

    def writer(self, _topic: str, _type: str, *, latched: bool = False) -> Callable[[Any], None]:  # noqa: ARG002
        return lambda _message: None


class _BagReader:
    def __init__(self, messages: Sequence[tuple[int, bytes]], class_: Any) -> None:
        self._messages, self._class, self._next = messages, class_, 0

    def take(self, now_ns: int) -> Any:
        before = self._next
        while self._next < len(self._messages) and self._messages[self._next][0] <= now_ns:
            self._next += 1
        return self._class.deserialize(self._messages[self._next - 1][1]) if self._next > before else None


@cache
def _open_domain(domain_id: int) -> _DomainSession:
    return _DomainSession(domain_id)


def _domain_id() -> int:
    text = os.environ.get("ROS_DOMAIN_ID", "") or "0"
    if not text.isdecimal() or int(text) > _MAX_DOMAIN:
        raise NetworkError(f"ROS_DOMAIN_ID={text} is no number from 0 to {_MAX_DOMAIN}")
    return int(text)


def _import_dds() -> tuple[Any, Any, Any]:
    _import_idl()
    import cyclonedds.pub  # noqa: PLC0415 - optional
    import cyclonedds.sub  # noqa: PLC0415
    import cyclonedds.topic  # noqa: PLC0415
    from cyclonedds import core, domain  # noqa: PLC0415

    return cyclonedds, core, domain


def _import_idl() -> Any:
    try:
        import cyclonedds.idl  # noqa: PLC0415 - optional
        import cyclonedds.idl.types  # noqa: PLC0415
    except ImportError as error:
        raise NetworkError(f"topics of ROS 2 need cyclonedds, which is not installed: {INSTALL}") from error
    return cyclonedds.idl


def _idl_type(field: FieldType) -> Any:
    idl, detail = _import_idl(), field[1]
    if is_message(field):
        return message_class(detail)
    if is_base(field):
        plain = {"bool": bool, "string": str}.get(detail[0])
        return plain or getattr(idl.types, _PRIMITIVES.get(detail[0], detail[0]))
    items, size = _idl_type(detail[0]), detail[1]
    if is_fixed_array(field):
        return idl.types.array[items, size]
    return idl.types.sequence[items, size] if size else idl.types.sequence[items]


def _zero(field: FieldType) -> Any:
    detail = field[1]
    if is_message(field):
        return make_message(detail)
    if is_base(field):
        return {"bool": False, "string": "", "float32": 0.0, "float64": 0.0}.get(detail[0], 0)
    return [_zero(detail[0]) for _ in range(detail[1])] if is_fixed_array(field) else []
