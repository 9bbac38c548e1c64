"""Connects a root to other robots: they read its components and call them, and coordinate with it in a team."""

from __future__ import annotations

import os
import socket
import time
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from .component import Component
from .errors import USER_ERRORS, NetworkError, describe_exception, make_error_record, print_error
from .live import find_address
from .net_session import MAX_WAITING, check_name, has_receivers, open_session, watch_key
from .net_values import convert_parameters, decode, encode
from .observer import read_values
from .remote import CALL_LIFETIME_S, LONGEST_CALL_S, RemoteComponent
from .team_link import TeamLink, TeamRobot

if TYPE_CHECKING:
    from .base_root import BaseRoot

_MAX_TEXT = 100
NAME, TEAM = "VICODE_NET", "VICODE_TEAM"


def connect_root(
    root: BaseRoot, name: str, *, team: str = "", fields: Sequence[str] | None = None, on_call: bool = False
) -> Network:
    """Connect a root under a name until it is closed.

    Raises:
        NetworkError: zenoh is not installed, a name is invalid, there is no network, or the root is connected.
    """
    if root.network is not None:
        raise NetworkError(f"the root is connected as {root.network.name}")
    shared = getattr(root.world, "team_fields", ()) if fields is None else fields
    network = Network(root, name, team, tuple(shared), on_call=on_call)
    root.network = network
    root._closing.callback(network.close)
    root._set_step(root._find_step())
    address = find_address(root)
    if address:
        network.announce(address)
    if hasattr(root.world, "team_fields"):
        root.world.robots = network.robots
    return network


def connect_from_environment(root: BaseRoot) -> None:
    """Connect a root as the environment says; a robot also starts if that is impossible."""
    try:
        connect_root(root, os.environ[NAME], team=os.environ.get(TEAM, ""))
    except NetworkError as error:
        print_error(str(error))


@dataclass(slots=True)
class _Caller:
    """What another robot asks of a component.

    Attributes:
        until_s: When the call ends.
        stepped_in: The last iteration in which the call, and not this robot itself, stepped the component.
        waiting: Calls of which each counts.
    """

    activation: str = ""
    until_s: float = -float("inf")
    stepped_in: int = -1
    waiting: deque[bytes] = field(default_factory=lambda: deque(maxlen=MAX_WAITING))


class Network:
    """A root under a name in the network.

    Args:
        root: The root.
        name: The name of the robot.
        team: The team, "" for none.
        fields: The attributes of the world that the team shares.
        on_call: Whether only calls of other robots step the main component.
    """

    def __init__(self, root: BaseRoot, name: str, team: str, fields: Sequence[str], *, on_call: bool) -> None:
        self.name = check_name(name)
        self._root, self._is_on_call = root, on_call
        if team:
            check_name(team, "team")
        self._session = session = open_session()
        self._calls = session.receive(f"vicode/{name}/call/*/*")
        self._callers: dict[Component, _Caller] = {}
        self._senders: dict[Component, Any] = {}
        self._number = 0
        self._warned: set[str] = set()
        self._link = TeamLink(root, session, name, team, fields) if team else None
        self._watched: Any = None
        self._alive = session.declare_alive(f"vicode/{name}/alive/{session.id}")

    @property
    def robots(self) -> dict[str, TeamRobot]:
        """The other robots of the team by name, since they sent their first message."""
        return self._link.robots if self._link is not None else {}

    def announce(self, address: str) -> None:
        """Let `vicode attach` find the address of the live view by the name of the robot."""
        self._watched = self._session.declare_alive(watch_key(self.name, _public_address(address)))

    def run_iteration(self, step: Callable[[], None]) -> None:
        """Receive, run an iteration, step the components that other robots call, and send."""
        iteration = self._root.iteration
        self._guard(self._receive)
        if not self._is_on_call:
            step()
        for component, caller in self._callers.items():
            if component._stepped_in != iteration and caller.until_s >= time.monotonic():
                component.step()
                caller.stepped_in = iteration
        self._guard(self._send)

    def close(self) -> None:
        for token in (self._alive, self._watched):
            if token is not None:
                with suppress(Exception):
                    token.undeclare()
        self._calls.close()
        if self._link is not None:
            self._link.close()
        self._session.close()

    def _guard(self, function: Callable[[], None]) -> None:
        """The robot continues without its network."""
        try:
            function()
        except USER_ERRORS as error:
            if error is self._root.stop_error:
                raise
            self._warn(describe_exception(error))

    def _warn(self, message: str) -> None:
        if message not in self._warned and len(self._warned) < MAX_WAITING:
            self._warned.add(message)
            print_error(f"{message} (reported once)", kind="network")

    def _receive(self) -> None:
        newest: dict[str, bytes] = {}
        for key, payload in self._calls.take_all():
            *_, name, mode = key.split("/")
            if mode == "each":
                component = self._find_component(name)
                if component is not None:
                    self._callers.setdefault(component, _Caller()).waiting.append(payload)
            else:
                newest[name] = payload
        for name, payload in newest.items():
            component = self._find_component(name)
            if component is not None:
                self._call(component, self._callers.setdefault(component, _Caller()), payload)
        for component, caller in self._callers.items():
            if caller.waiting:
                self._call(component, caller, caller.waiting.popleft())
        if self._link is not None:
            self._link.hear()

    def _find_component(self, name: str) -> Component | None:
        components = (each for each in self._root.components if type(each).__name__ == name)
        return next((each for each in components if not isinstance(each, RemoteComponent)), None)

    def _call(self, component: Component, caller: _Caller, payload: bytes) -> None:
        """Set the parameters of a component, and let it be stepped for some time."""
        try:
            call = decode(payload)
            activation, lifetime_s = str(call["activation"])[:_MAX_TEXT], float(call["for"])
            parameters = convert_parameters(call["parameters"], type(component).modulate)
        except (ValueError, KeyError, TypeError) as error:
            self._warn(f"a call of {type(component).__name__} was refused: {describe_exception(error)}")
            return
        try:
            component.modulate(**parameters)
        except USER_ERRORS as error:
            self._root.report(make_error_record(component, error))
        if activation != caller.activation:
            caller.activation = activation
            if component._stepped_in == caller.stepped_in:
                # A new activation restarts a component, even if the last one has just ended.
                component._stepped_in = min(caller.stepped_in, self._root.iteration - 2)
        caller.until_s = time.monotonic() + min(max(lifetime_s, CALL_LIFETIME_S), LONGEST_CALL_S)

    def _send(self) -> None:
        self._number += 1
        for component in self._root.components:
            if isinstance(component, RemoteComponent):
                continue
            sender = self._senders.get(component)
            if sender is None:
                key = f"vicode/{self.name}/output/{type(component).__name__}"
                sender = self._senders[component] = self._session.sender(key)
            if self._has_outputs(component) and has_receivers(sender):
                sender.put(encode(self._describe(component)))
        if self._link is not None:
            self._link.tell()

    def _has_outputs(self, component: Component) -> bool:
        """Whether a component was stepped in this iteration, or only provides values."""
        is_passive = type(component).work is Component.work and not component._states
        return is_passive or component._stepped_in == self._root.iteration

    def _describe(self, component: Component) -> dict[str, Any]:
        caller = self._callers.get(component)
        return {
            "number": self._number,
            "activation": caller.activation if caller is not None else "",
            "state": component.state,
            "done": component.is_done,
            "values": read_values(component),
        }


def _public_address(address: str) -> str:
    """Replace the address of all interfaces by that of one that other machines reach."""
    host, _colon, port = address.rpartition(":")
    if host not in ("0.0.0.0", "::"):  # noqa: S104 - compared only
        return address
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe, suppress(OSError):
        # Nothing is sent: it selects the interface.
        probe.connect(("192.0.2.1", 9))
        host = probe.getsockname()[0]
    return f"{host}:{port}"
