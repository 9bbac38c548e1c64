"""The server that viewers of running roots connect to: JSON lines over TCP or a Unix socket, in a separate thread.

A viewer that reads slowly gets the newest iteration and skips those between; roots never wait for a viewer.
"""

from __future__ import annotations

import hmac
import json
import os
import secrets
import selectors
import socket
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from .errors import print_error
from .live_feed import Feed, LiveFeed
from .live_viewer import DEFAULT_RATE_HZ, FLOOD_S, Allowance, FloodError, Viewer

if TYPE_CHECKING:
    from collections.abc import Callable

    from .base_root import BaseRoot

PROTOCOL_VERSION = 1
MAX_VIEWERS = 32
MIN_RATE_HZ, MAX_RATE_HZ = 0.01, 200.0
_REST_PERIOD_S = 0.5
"""How often a viewer gets the robots that it does not look at."""
_MAX_UNSENT_BYTES = 1_000_000
"""A viewer that asks for more answers without reading them is disconnected."""
_HANDSHAKE_LIMIT_S = 5.0
_CONNECTIONS_PER_S, _CONNECTIONS_AT_ONCE = 30.0, 64.0
_MAX_CONTAINERS = 256
"""Python collects garbage, which holds up the robot, after some hundreds of new lists and objects."""
_UNIX = "unix:"


F = TypeVar("F", bound=Feed)


class LiveServer:
    """Serves the feeds of any number of roots.

    Args:
        address: A port, "HOST:PORT", or "unix:PATH"; the default host is 127.0.0.1, port 0 selects a free port.
        token: What viewers must send first; by default a random text. Viewers on a Unix socket need none, as the file
            is only accessible to its user.
        control: Whether viewers may pause and change the roots.
        stays_open: Whether viewers may wait for roots; by default, the server closes with the last root.

    Raises:
        OSError: The address is in use or invalid.
    """

    def __init__(
        self, address: str | int = 0, *, token: str = "", control: bool = False, stays_open: bool = False
    ) -> None:
        self.control, self._stays_open = control, stays_open
        self._asked_address = str(address)
        self._listener, self.address = _listen(str(address))
        self.token = token or ("" if self.address.startswith(_UNIX) else secrets.token_hex(12))
        self._feeds: list[Feed] = []
        self._viewers: list[Viewer] = []
        self._selector = selectors.DefaultSelector()
        self._wake_reader, self._wake_writer = socket.socketpair()
        for end in (self._wake_reader, self._wake_writer, self._listener):
            end.setblocking(False)
        self._selector.register(self._listener, selectors.EVENT_READ, None)
        self._selector.register(self._wake_reader, selectors.EVENT_READ, None)
        self._is_closing = False
        self._is_awake = False
        self._connections = Allowance(_CONNECTIONS_PER_S, _CONNECTIONS_AT_ONCE)
        self._accept_s: float | None = None
        """When connections are accepted again; None if they are."""
        self._thread = threading.Thread(target=self._serve, name="vicode-live", daemon=True)
        self._thread.start()

    def add(self, root: BaseRoot, name: str = "") -> LiveFeed:
        """Let viewers see a root, until it is closed, under a name, by default that of its main component."""
        feed = self.add_feed(name or type(root.main).__name__, lambda unique, wake: LiveFeed(root, unique, wake))
        root._closing.callback(self.remove, feed)
        return feed

    def add_feed(self, name: str, make: Callable[[str, Callable[[], None]], F]) -> F:
        """Let viewers see a feed until it is removed; `make` gets its unique name, and what to call after messages."""
        taken = {feed.name for feed in self._feeds}
        unique, number = name, 2
        while unique in taken:
            unique, number = f"{name} {number}", number + 1
        feed = make(unique, self._wake)
        self._feeds = [*self._feeds, feed]
        self._wake()
        return feed

    def remove(self, feed: Feed) -> None:
        """End the view of a root; the server closes with the last one, unless it stays open."""
        feed.is_watched = False
        self._feeds = [each for each in self._feeds if each is not feed]
        if self._feeds or self._stays_open:
            self._wake()
        else:
            self.close()

    def shows(self, root: BaseRoot) -> bool:
        return not self.is_closed and any(feed.root is root for feed in self._feeds)

    def serves(self, address: str | int) -> bool:
        """Whether the server is open at an address that was asked for; each request for a free port gets its own."""
        return (
            not self.is_closed and str(address) == self._asked_address and self._asked_address.rpartition(":")[2] != "0"
        )

    @property
    def is_closed(self) -> bool:
        return self._is_closing

    def close(self) -> None:
        """Disconnect all viewers and stop the thread."""
        self._is_closing = True
        self._wake(is_forced=True)
        if threading.current_thread() is not self._thread:
            self._thread.join(2.0)

    def _wake(self, *, is_forced: bool = False) -> None:
        """Wake the thread; called by the threads that step roots."""
        if not self._is_awake or is_forced:
            self._is_awake = True
            with suppress(OSError):
                self._wake_writer.send(b"\0")

    def _serve(self) -> None:
        try:
            while not self._is_closing:
                for key, events in self._selector.select(self._next_due_s()):
                    self._handle(key, events)
                self._is_awake = False
                self._resume(time.monotonic())
                self._deliver()
        except Exception as error:
            print_error(f"the live view ended: {type(error).__name__}: {error}")
        finally:
            for feed in self._feeds:
                feed.is_watched = False
            for viewer in [*self._viewers]:
                self._drop(viewer)
            for end in (self._listener, self._wake_reader, self._wake_writer, self._selector):
                end.close()
            if self.address.startswith(_UNIX):
                Path(self.address.removeprefix(_UNIX)).unlink(missing_ok=True)

    def _handle(self, key: selectors.SelectorKey, events: int) -> None:
        if key.fileobj is self._listener:
            self._accept()
        elif key.fileobj is self._wake_reader:
            with suppress(BlockingIOError):
                self._wake_reader.recv(4096)
        elif isinstance(key.data, Viewer) and key.data in self._viewers:
            viewer = key.data
            try:
                if events & selectors.EVENT_READ:
                    viewer.receive()
                    self._read(viewer)
                if events & selectors.EVENT_WRITE:
                    self._write(viewer)
            except (OSError, ValueError, RecursionError):
                self._drop(viewer)

    def _accept(self) -> None:
        self._connections.use(1)
        if wait_s := self._connections.wait_s(time.monotonic()):
            self._accept_s = time.monotonic() + wait_s
            self._selector.unregister(self._listener)
        with suppress(OSError):
            connection, _address = self._listener.accept()
            if len(self._viewers) >= MAX_VIEWERS:
                # Connections without a token must not keep viewers out.
                stranger = next((each for each in self._viewers if not each.is_admitted), None)
                if stranger is None:
                    connection.close()
                    return
                self._drop(stranger)
            connection.setblocking(False)
            if connection.family != getattr(socket, "AF_UNIX", None):
                connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            viewer = Viewer(connection)
            self._viewers.append(viewer)
            self._selector.register(connection, selectors.EVENT_READ, viewer)

    def _read(self, viewer: Viewer) -> None:
        try:
            for line in viewer.take_lines():
                self._read_line(viewer, line)
        except FloodError:
            self._send(viewer, {"error": f"more requests than a robot answers, for {FLOOD_S:g} s"})
            raise
        self._watch(viewer)

    def _resume(self, now_s: float) -> None:
        """Continue to accept connections and to read, where that was limited."""
        if self._accept_s is not None and now_s >= self._accept_s:
            self._accept_s = None
            self._selector.register(self._listener, selectors.EVENT_READ, None)
        for viewer in [*self._viewers]:
            if viewer.resume_s is not None and now_s >= viewer.resume_s:
                try:
                    self._read(viewer)
                except (OSError, ValueError, RecursionError):
                    self._drop(viewer)

    def _read_line(self, viewer: Viewer, line: bytes) -> None:
        if line.count(b"[") + line.count(b"{") > _MAX_CONTAINERS:
            raise ValueError("more lists and objects than a request has")
        request = json.loads(line)
        if not isinstance(request, dict):
            raise ConnectionAbortedError
        if not viewer.is_admitted:
            self._admit(viewer, request)
            return
        if "focus" in request:
            viewer.focus = str(request["focus"])
            return
        feed = next((each for each in self._feeds if each.name == request.get("robot")), None)
        answer = {"answer": request.get("id"), "robot": request.get("robot")}
        if feed is None:
            self._send(viewer, {**answer, "error": f"no robot {request.get('robot')!r}"})
        elif not self.control:
            self._send(viewer, {**answer, "error": "this robot may only be watched; start it with control"})
        else:
            viewer.has_control = True
            if not feed.request(viewer, request):
                self._send(viewer, {**answer, "error": "too many requests at once; the robot did not handle this one"})

    def _admit(self, viewer: Viewer, request: dict[str, Any]) -> None:
        token = request.get("token", "")
        if self.token and not (isinstance(token, str) and hmac.compare_digest(token.encode(), self.token.encode())):
            self._send(viewer, {"error": "wrong token"})
            raise ValueError("wrong token")
        rate_hz = request.get("rate_hz", DEFAULT_RATE_HZ)
        if isinstance(rate_hz, int | float) and MIN_RATE_HZ <= rate_hz <= MAX_RATE_HZ:
            viewer.period_s = 1 / rate_hz
        viewer.is_admitted = True
        self._greet(viewer)

    @property
    def _versions(self) -> list[tuple[Feed, int]]:
        """The feeds, which are described again when their code was exchanged."""
        return [(feed, feed.version) for feed in self._feeds]

    def _greet(self, viewer: Viewer) -> None:
        viewer.greeted = self._versions
        feeds = [feed for feed, _version in viewer.greeted]
        viewer.seen = {feed: seen for feed, seen in viewer.seen.items() if feed in feeds}
        robots = [feed.describe() for feed in feeds]
        self._send(viewer, {"vicode-live": PROTOCOL_VERSION, "control": self.control, "robots": robots})

    def _deliver(self) -> None:
        """Send answers, and the newest iterations to viewers that can take them."""
        now_s = time.monotonic()
        versions = self._versions
        for viewer in [*self._viewers]:
            try:
                if not viewer.is_admitted:
                    if now_s - viewer.connected_s > _HANDSHAKE_LIMIT_S:
                        self._drop(viewer)
                    continue
                if viewer.greeted != versions:
                    self._greet(viewer)
                if not viewer.unsent and now_s >= viewer.due_s:
                    self._send_newest(viewer, now_s)
            except OSError:
                self._drop(viewer)
        focuses = {viewer.focus for viewer in self._viewers if viewer.is_admitted}
        for feed in self._feeds:
            feed.is_watched = bool(focuses)
            feed.is_focused = "" in focuses or feed.name in focuses
            while feed.answers:
                self._send_answer(*feed.answers.popleft())

    def _send_answer(self, viewer: object, answer: dict[str, Any]) -> None:
        if isinstance(viewer, Viewer) and viewer in self._viewers:
            try:
                self._send(viewer, answer)
            except (OSError, ValueError, RecursionError):
                self._drop(viewer)

    def _send_newest(self, viewer: Viewer, now_s: float) -> None:
        lines: list[bytes] = []
        is_rest_due = now_s >= viewer.rest_due_s
        for feed in self._feeds:
            if not is_rest_due and not viewer.looks_at(feed):
                continue
            number, message = feed.newest
            last, last_iteration, last_change = viewer.seen.get(feed, (0, 0, 0))
            if number == last:
                continue
            changes = [change for change in [*feed.changes] if change["number"] > last_change]
            newest_change = changes[-1]["number"] if changes else last_change
            viewer.seen[feed] = (number, message["iteration"], newest_change)
            # Not by the numbers of messages: another one of the same iteration says that the robot is paused.
            missed = max(0, message["iteration"] - last_iteration - 1) if last else 0
            lines.append(_encode({**message, "changes": changes, "missed": missed}))
        if lines:
            viewer.due_s = now_s + viewer.period_s
            if is_rest_due:
                viewer.rest_due_s = now_s + max(_REST_PERIOD_S, viewer.period_s)
            viewer.unsent += b"".join(lines)
            self._write(viewer)

    def _send(self, viewer: Viewer, message: dict[str, Any]) -> None:
        if len(viewer.unsent) > _MAX_UNSENT_BYTES:
            raise ConnectionAbortedError
        viewer.unsent += _encode(message)
        self._write(viewer)

    def _write(self, viewer: Viewer) -> None:
        if viewer.unsent:
            with suppress(BlockingIOError):
                sent = viewer.connection.send(viewer.unsent)
                del viewer.unsent[:sent]
        self._watch(viewer)

    def _watch(self, viewer: Viewer) -> None:
        """Wait for what a viewer sends, unless that is limited, and until it takes what is not sent."""
        wanted = (selectors.EVENT_READ if viewer.resume_s is None else 0) | (
            selectors.EVENT_WRITE if viewer.unsent else 0
        )
        watched = viewer.connection in self._selector.get_map()
        if not wanted:
            if watched:
                self._selector.unregister(viewer.connection)
        elif watched:
            self._selector.modify(viewer.connection, wanted, viewer)
        else:
            self._selector.register(viewer.connection, wanted, viewer)

    def _drop(self, viewer: Viewer) -> None:
        if viewer in self._viewers:
            self._viewers.remove(viewer)
            with suppress(KeyError, ValueError):
                self._selector.unregister(viewer.connection)
            viewer.connection.close()
            if viewer.has_control:
                for feed in self._feeds:
                    feed.forget(viewer)

    def _next_due_s(self) -> float | None:
        """Seconds until a viewer may get the next iteration, or must have sent its token."""
        now_s = time.monotonic()
        dues = [due_s for viewer in self._viewers if (due_s := self._due_s(viewer)) is not None]
        dues += [viewer.resume_s for viewer in self._viewers if viewer.resume_s is not None]
        dues += [self._accept_s] if self._accept_s is not None else []
        return max(0.0, min(dues) - now_s) if dues else None

    def _due_s(self, viewer: Viewer) -> float | None:
        """When to do something for a viewer; None before there is news."""
        if not viewer.is_admitted:
            return viewer.connected_s + _HANDSHAKE_LIMIT_S
        news = [feed for feed in self._feeds if feed.newest[0] != viewer.seen.get(feed, (0, 0, 0))[0]]
        if viewer.unsent or not news:
            return None
        return viewer.due_s if any(map(viewer.looks_at, news)) else max(viewer.due_s, viewer.rest_due_s)


def _listen(address: str) -> tuple[socket.socket, str]:
    """Open the listening socket; return it with its address as viewers write it."""
    if address.startswith(_UNIX):
        path = Path(address.removeprefix(_UNIX))
        if not hasattr(socket, "AF_UNIX"):
            raise OSError("this system has no Unix sockets; write PORT or HOST:PORT")
        listener = socket.socket(socket.AF_UNIX)
        if path.is_socket():
            # A program that was killed left it; a running one would answer.
            with suppress(OSError), socket.socket(socket.AF_UNIX) as probe:
                probe.settimeout(0.2)
                probe.connect(str(path))
                raise FileExistsError(f"{path} is in use by another program")
            path.unlink(missing_ok=True)
        mask = os.umask(0o177)
        try:
            listener.bind(str(path))
        finally:
            os.umask(mask)
        listener.listen()
        return listener, address
    host, colon, port = address.rpartition(":")
    if not port.isdigit():
        raise OSError(f"invalid address '{address}'; write PORT, HOST:PORT or unix:PATH")
    listener = socket.create_server((host if colon and host else "127.0.0.1", int(port)))
    name = listener.getsockname()
    return listener, f"{name[0]}:{name[1]}"


def _encode(message: dict[str, Any]) -> bytes:
    return json.dumps(message, separators=(",", ":")).encode() + b"\n"
