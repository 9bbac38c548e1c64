"""Root: a root with the live view, records and the network, which are only imported when they are used."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from .base_root import BaseRoot

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .live_server import LiveServer
    from .network import Network
    from .recorder import Recorder


class Root(BaseRoot):
    """Creates each component once, and steps the root component in each iteration; a context manager that closes them.

    Args:
        component_class: The class of the root component.
        clock: Read once at the start of each iteration; default: real time.
        world: The `world` of hand-written components, which they sense and act on.
        on_error: `continue` prints each error location once, `stop` raises `ComponentError`; a function is called
            with the `ErrorRecord`, and may raise `ComponentError(record)` to stop.
        observer: Records the activation tree of each iteration, such as an `Observer`.
        parameters: Passed once to `modulate` of the root component.

    Attributes:
        main: The root component.
        clock: The clock.
        world: The world, or None.
        now_ns: The time of the iteration in nanoseconds.
        iteration: The number of the iteration, from 1; 0 before the first step.
        team: The states that the robots of a team coordinate.
        errors: How often each error occurred, by component, method and line.
        network: The connection to other robots, after `connect`, or else None.
    """

    def watch(
        self,
        address: str | int = 0,
        *,
        token: str = "",
        control: bool = False,
        without_hold: bool = False,
        name: str = "",
    ) -> LiveServer:
        """Let viewers connect (`vicode attach`); the robot never waits for them.

        Args:
            address: A port on 127.0.0.1, "HOST:PORT", or "unix:PATH"; 0 selects a free port. Roots of one process with
                the same address share a server.
            token: What viewers must know, by default a random text, which is printed; a Unix socket needs none.
            control: Whether viewers may pause the robot and change values and states.
            without_hold: Whether they may also if the world has no `hold`, so that a paused robot keeps moving.
            name: The name of the robot, by default that in the network, or else that of its main component.

        Raises:
            OSError: The address is in use or invalid, the root is watched already, or the world has no `hold`.
        """
        from .live import watch_root  # noqa: PLC0415 - off by default

        return watch_root(self, address, token=token, control=control, without_hold=without_hold, name=name)

    def record(
        self,
        path: str | os.PathLike[str],
        *,
        minutes: float = 5.0,
        values: bool = True,
        design: str = "",
        revision: str = "",
    ) -> Recorder:
        """Keep the last minutes of the run in files next to `path`, until the root is closed; call it before `step`.

        The robot never waits for the disk.

        Args:
            path: The name of the record: `run.jsonl` is written as `run.1.000001.jsonl` and so on.
            minutes: How much is kept, in the time of the root.
            values: Whether to record outputs, variables and parameters, which a replay needs.
            design: The hash of the design, for the header.
            revision: The git revision of the design, for the header.

        Raises:
            OSError: No file can be created there.
        """
        from .recorder import record_root  # noqa: PLC0415 - off by default

        return record_root(self, path, minutes=minutes, values=values, design=design, revision=revision)

    def connect(
        self, name: str, *, team: str = "", fields: Sequence[str] | None = None, on_call: bool = False
    ) -> Network:
        """Connect to other robots, which read and call the components of this one; needs `vicode-fsm[net]`.

        Without the variable VICODE_NET_CONFIG, only programs of this machine are found.

        Args:
            name: The name of the robot.
            team: The team, whose robots coordinate their states and share values.
            fields: Attributes of the world to share, by default those that its `team_fields` names.
            on_call: Whether the main component is only stepped while other robots call it.

        Raises:
            NetworkError: zenoh is not installed, a name is invalid, or there is no network.
        """
        from .network import connect_root  # noqa: PLC0415 - off by default

        return connect_root(self, name, team=team, fields=fields, on_call=on_call)

    def _attach_features(self) -> None:
        """Attach what the environment asks for."""
        if "VICODE_RECORD" in os.environ:
            from .recorder import record_from_environment  # noqa: PLC0415 - off by default

            record_from_environment(self)
        if "VICODE_NET" in os.environ:
            from .network import connect_from_environment  # noqa: PLC0415 - off by default

            connect_from_environment(self)
        if "VICODE_WATCH" in os.environ:
            from .live import watch_from_environment  # noqa: PLC0415 - off by default

            watch_from_environment(self)
