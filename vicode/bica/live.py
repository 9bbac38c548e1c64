"""Opens the live view of roots: by `Root.watch`, or by the environment variable VICODE_WATCH."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from .component import Component
from .errors import print_error
from .live_server import LiveServer

if TYPE_CHECKING:
    from .base_root import BaseRoot

ADDRESS, TOKEN, CONTROL, NAME = "VICODE_WATCH", "VICODE_WATCH_TOKEN", "VICODE_WATCH_CONTROL", "VICODE_ROBOT"
WITHOUT_HOLD = "without-hold"

_servers: list[LiveServer] = []


class NoHoldError(OSError):
    """Viewers could pause the robot, but not stop it."""


def watch_root(
    root: BaseRoot,
    address: str | int = 0,
    *,
    token: str = "",
    control: bool = False,
    without_hold: bool = False,
    name: str = "",
) -> LiveServer:
    """Let viewers connect to a root; roots of one process with the same address share a server.

    Raises:
        NoHoldError: Viewers could control the root, but its world has no `hold`.
        OSError: The address is in use or invalid, or shared with another token or permission to control, or the root
            is watched already.
    """
    if control and not without_hold and not callable(getattr(root.world, "hold", None)):
        owner = (
            "the robot has no world" if root.world is None else f"the world {type(root.world).__name__} has no hold()"
        )
        moving = _find_moving_components(root)
        if root.world is None and root.holders and moving:
            owner += f", and {moving[0]} is no topic"
        if root.world is not None or moving or not root.holders:
            raise NoHoldError(f"{owner}: a paused robot would keep moving; define hold() in its world")
    if any(each.shows(root) for each in _servers):
        raise OSError("the root is watched already")
    server = next((each for each in _servers if each.serves(address)), None)
    if server is None:
        server = LiveServer(address, token=token, control=control)
        _servers[:] = [*(each for each in _servers if not each.is_closed), server]
        access = f" --token {server.token}" if server.token else ""
        print_error(f"vicode attach {server.address}{access}", kind="watch")
    elif server.control != control or token not in ("", server.token):
        raise OSError(f"{server.address} is open with another token or permission to control")
    root._closing.callback(
        server.remove, server.add(root, name or (root.network.name if root.network is not None else ""))
    )
    if root.network is not None:
        root.network.announce(server.address)
    return server


def _find_moving_components(root: BaseRoot) -> list[str]:
    """The components that may move the robot while it is held: hand-written ones with code."""
    held = [getattr(holder, "__self__", None) for holder in root.holders]
    others = [type(each) for each in root.components if not each._states and each not in held]
    return [each.__name__ for each in others if (each.work, each.modulate) != (Component.work, Component.modulate)]


def find_address(root: BaseRoot) -> str:
    """Return where a root is watched, "" if it is not."""
    return next((each.address for each in _servers if each.shows(root)), "")


def watch_from_environment(root: BaseRoot) -> None:
    """Watch a root as the environment says; a robot also starts if that is impossible."""
    control = os.environ.get(CONTROL, "")
    try:
        watch_root(
            root,
            os.environ[ADDRESS],
            token=os.environ.get(TOKEN, ""),
            control=control not in ("", "0"),
            without_hold=control == WITHOUT_HOLD,
            name=os.environ.get(NAME, ""),
        )
    except NoHoldError as error:
        print_error(f"cannot be controlled, so it is not watched: {error}, or set {CONTROL}={WITHOUT_HOLD}")
    except (OSError, ValueError, OverflowError) as error:
        print_error(f"cannot be watched at {os.environ[ADDRESS]}: {error}")
