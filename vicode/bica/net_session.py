"""The connection to other robots over zenoh, the only module that imports it; processes of one machine find each other.

Names and addresses are keys: `vicode/ROBOT/alive/SESSION`, `…/watch/HOST/ADDRESS`, `…/output/COMPONENT`,
`…/call/COMPONENT/MODE` and `…/team/TEAM`.
"""

from __future__ import annotations

import json
import os
import re
import socket
import time
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING, Any
from urllib.parse import quote, unquote

from .errors import NetworkError

if TYPE_CHECKING:
    from types import ModuleType

    import zenoh

CONFIG, PORT = "VICODE_NET_CONFIG", "VICODE_NET_PORT"
MAX_MESSAGE_BYTES = 65_536
MAX_WAITING = 256
"""So many messages wait for an iteration at most; then the oldest are dropped."""
_FIRST_PORT, _PORTS = 7451, 32
_MAX_ALIVE_KEYS = 4096
_FIND_TIMEOUT_S = 3.0
_MAX_ERROR = 300
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}", re.ASCII)

_sessions: dict[str, NetSession] = {}


def check_name(name: str, kind: str = "robot") -> str:
    """Return a name that can be part of a key.

    Raises:
        NetworkError: It cannot.
    """
    if not _NAME.fullmatch(name):
        raise NetworkError(f"'{name}' is no name of a {kind}; use letters, digits, _, - and .")
    return name


class Receiver:
    """Receives messages in a queue of limited length, from which the oldest are dropped; never runs code itself."""

    def __init__(self, subscriber: zenoh.Subscriber[zenoh.handlers.Handler[zenoh.Sample]]) -> None:
        self._subscriber = subscriber
        self._try_receive = subscriber.try_recv

    def take_all(self) -> Iterator[tuple[str, bytes]]:
        """Yield the waiting messages, but no more than the queue holds: those that arrive during the loop are left."""
        for _ in range(MAX_WAITING):
            received = self.take()
            if received is None:
                return
            yield received

    def take(self) -> tuple[str, bytes] | None:
        """Return the key and the content of the next message; too long ones are empty."""
        sample = self._try_receive()
        if sample is None:
            return None
        payload = sample.payload
        return str(sample.key_expr), payload.to_bytes() if len(payload) <= MAX_MESSAGE_BYTES else b""

    def close(self) -> None:
        with suppress(Exception):
            self._subscriber.undeclare()  # type: ignore[no-untyped-call]


class AliveKeys:
    """The keys that live processes declare.

    A callback would need a thread, which keeps a program from ending whose root is not closed.
    """

    def __init__(self, subscriber: zenoh.Subscriber[zenoh.handlers.Handler[zenoh.Sample]], put: object) -> None:
        self._try_receive, self._put = subscriber.try_recv, put
        self._subscriber = subscriber
        self._keys: set[str] = set()

    def read(self) -> set[str]:
        # Changes that arrive during the call are read next time.
        for _ in range(_MAX_ALIVE_KEYS):
            sample = self._try_receive()
            if sample is None:
                break
            if sample.kind != self._put:
                self._keys.discard(str(sample.key_expr))
            elif len(self._keys) < _MAX_ALIVE_KEYS:
                self._keys.add(str(sample.key_expr))
        return self._keys


class NetSession:
    """A session that the roots of a process share; `close` ends it after as many calls as `open_session`."""

    def __init__(self, session: zenoh.Session) -> None:
        self.users = 0
        self._zenoh = _import_zenoh()
        self._session = session

    @property
    def id(self) -> str:
        return str(self._session.zid())

    def sender(self, key: str) -> zenoh.Publisher:
        """Return a publisher that does not wait: messages are dropped if the connection is stuck."""
        drop = self._zenoh.CongestionControl.DROP
        return self._session.declare_publisher(key, congestion_control=drop, express=True)

    def receive(self, key: str, size: int = MAX_WAITING) -> Receiver:
        return Receiver(self._session.declare_subscriber(key, self._zenoh.handlers.RingChannel(size)))

    def declare_alive(self, key: str) -> zenoh.LivelinessToken:
        """Declare a key that exists as long as the process is connected, or until it is undeclared."""
        return self._session.liveliness().declare_token(key)

    def watch_alive(self, key: str) -> AliveKeys:
        ring = self._zenoh.handlers.RingChannel(_MAX_ALIVE_KEYS)
        subscriber = self._session.liveliness().declare_subscriber(key, ring, history=True)
        return AliveKeys(subscriber, self._zenoh.SampleKind.PUT)

    def find_alive(self, key: str) -> set[str]:
        replies = self._session.liveliness().get(key, timeout=_FIND_TIMEOUT_S)
        return {str(reply.ok.key_expr) for reply in replies if reply.ok is not None}

    def close(self) -> None:
        self.users -= 1
        if self.users == 0:
            for config in [config for config, session in _sessions.items() if session is self]:
                del _sessions[config]
            with suppress(Exception):
                self._session.close()  # type: ignore[no-untyped-call]


def has_receivers(sender: zenoh.Publisher) -> bool:
    """Whether someone reads what is sent; the status is an object, contrary to its declaration (zenoh 1.10)."""
    status: Any = sender.matching_status
    return bool(getattr(status, "matching", status))


def open_session() -> NetSession:
    """Return the session of the process: of the file VICODE_NET_CONFIG, or else one on this machine only.

    Raises:
        NetworkError: zenoh is not installed, the file is invalid, or no port is free.
    """
    config = os.environ.get(CONFIG, "")
    session = _sessions.get(config)
    if session is None:
        session = _sessions[config] = NetSession(_open_configured(config) if config else _open_local())
    session.users += 1
    return session


def find_watched(wait_s: float = 1.0) -> list[tuple[str, str, str]]:
    """Return robot, host and address of each robot that can be watched.

    Raises:
        NetworkError: There is no network.
    """
    session = open_session()
    try:
        # Connections to the other processes are made in the background.
        time.sleep(wait_s)
        parts = [key.split("/") for key in session.find_alive("vicode/*/watch/*/*")]
    finally:
        session.close()
    return sorted((robot, unquote(host), unquote(address)) for _vicode, robot, _watch, host, address in parts)


def watch_key(robot: str, address: str) -> str:
    return f"vicode/{robot}/watch/{quote(socket.gethostname(), safe='')}/{quote(address, safe='')}"


def _import_zenoh() -> ModuleType:
    try:
        import zenoh  # noqa: PLC0415 - optional
    except ImportError as error:
        message = "robots connect over zenoh, which is not installed: pip install 'vicode-fsm[net]'"
        raise NetworkError(f"{message} (on a robot without vicode: pip install eclipse-zenoh)") from error
    return zenoh


def _open_configured(file: str) -> zenoh.Session:
    library = _import_zenoh()
    try:
        session: zenoh.Session = library.open(library.Config.from_file(file))
    except Exception as error:
        raise NetworkError(f"{CONFIG}={file}: {str(error)[:_MAX_ERROR]}") from error
    return session


def _open_local() -> zenoh.Session:
    """Listen on the first free port of a range on the loopback interface, and connect to all ports before it.

    So each pair of processes has one connection and none needs the others: a port that becomes free is taken by the
    next process, which those after it find.
    """
    library = _import_zenoh()
    first = _first_port()
    for port in range(first, first + _PORTS):
        if not _is_free(port):
            continue
        try:
            session: zenoh.Session = library.open(library.Config.from_json5(json.dumps(_local_config(first, port))))
        except library.ZError as error:
            if _is_free(port):
                raise NetworkError(f"zenoh cannot listen on port {port}: {str(error)[:_MAX_ERROR]}") from error
            # Another process took the port at the same time.
        else:
            return session
    raise NetworkError(f"no port from {first} to {first + _PORTS - 1} is free on 127.0.0.1; set {PORT} to others")


def _first_port() -> int:
    text = os.environ.get(PORT, "") or str(_FIRST_PORT)
    if not text.isdecimal() or not 0 < int(text) <= 65_536 - _PORTS:
        raise NetworkError(f"{PORT}={text} is no port from 1 to {65_536 - _PORTS}")
    return int(text)


def _is_free(port: int) -> bool:
    with socket.socket() as probe:
        # As zenoh listens: a port whose last connection has just ended is free.
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return False
    return True


def _local_config(first: int, port: int) -> dict[str, Any]:
    return {
        "mode": "peer",
        "listen": {"endpoints": [f"tcp/127.0.0.1:{port}"]},
        "connect": {
            "endpoints": [f"tcp/127.0.0.1:{before}" for before in range(first, port)],
            "timeout_ms": -1,
            "exit_on_failure": False,
            "retry": {"period_init_ms": 200, "period_max_ms": 1000, "period_increase_factor": 2},
        },
        "open": {"return_conditions": {"connect_scouted": False}},
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": False}},
    }
