"""A component that works in another process, perhaps on another robot, and holds its outputs here."""

from __future__ import annotations

import itertools
import time
from typing import TYPE_CHECKING, Any

from .component import Component
from .errors import print_error
from .net_session import MAX_WAITING, check_name, open_session
from .net_values import convert, decode, encode

if TYPE_CHECKING:
    from .base_root import BaseRoot

CALL_LIFETIME_S, LONGEST_CALL_S = 0.5, 10.0
"""So long the other side steps a component after a call; longer if the caller steps it less often."""
_CALL_PERIOD_S = 0.1
_OWN_NAMES = ("data_age", "is_alive")


class RemoteComponent(Component):
    """Holds the outputs of a component of another robot, and sends it parameters.

    The other robot steps it while it is stepped here. Each step reads the newest message, or with `reliable` the next
    one. Without messages, the outputs keep their values.

    Args:
        root: The root.
        remote: ROBOT/COMPONENT.
        reliable: Whether each message counts and not only the newest: changes of parameters and outputs arrive in
            order, one per step. At most 256 wait.
        max_age: Seconds after which data is too old.

    Attributes:
        data_age: Seconds since the outputs were received; infinite before.
        is_alive: Whether the other program runs and the outputs are not older than `max_age`.
    """

    def __init__(self, root: BaseRoot, remote: str, *, reliable: bool = False, max_age: float = 1.0) -> None:
        super().__init__(root)
        robot, _slash, component = remote.partition("/")
        self.data_age = float("inf")
        self.is_alive = False
        self._remote, self._max_age = remote, max_age
        check_name(robot)
        check_name(component, "component")
        self._session = open_session()
        self._alive = self._session.watch_alive(f"vicode/{robot}/alive/*")
        self._outputs = self._session.receive(f"vicode/{robot}/output/{component}", MAX_WAITING if reliable else 1)
        self._sender = self._session.sender(f"vicode/{robot}/call/{component}/{'each' if reliable else 'newest'}")
        self._is_reliable = reliable
        self._received_s = -float("inf")
        self._number: int | None = None
        self._activation, self._activations = "", itertools.count(1)
        self._sent: dict[str, Any] = {}
        self._sent_s = self._worked_s = -float("inf")
        self._is_remote_done = False
        self._reported: set[str] = set()
        self._parameters: tuple[str, ...] = ()
        self._likes: dict[str, Any] = {}
        """Values of the types of the outputs, by name."""
        self._has_names = False

    @property
    def is_done(self) -> bool:
        """Whether the component of the other robot is done, since it was last activated here."""
        return self._is_remote_done and self.root.iteration - self._stepped_in <= 1

    def restart(self) -> None:
        """Begin a new activation: the other side restarts the component."""
        self._activation = f"{self._session.id}-{next(self._activations)}"
        self._is_remote_done = False
        self._sent_s = -float("inf")

    def work(self) -> None:
        """Send the parameters, and read a message."""
        now_s = time.monotonic()
        if not self._has_names:
            self._find_names()
        self._send(now_s)
        message = self._outputs.take()
        if message is not None:
            self._read(message[1], now_s)
        self.data_age = now_s - self._received_s
        self.is_alive = bool(self._alive.read()) and self.data_age <= self._max_age

    def close(self) -> None:
        self._outputs.close()
        self._session.close()

    def _send(self, now_s: float) -> None:
        """Send the parameters if they have changed, and otherwise often enough that the other side keeps working."""
        values = self.__dict__
        parameters = {name: values[name] for name in self._parameters}
        interval_s, self._worked_s = now_s - self._worked_s, now_s
        if parameters == self._sent and now_s - self._sent_s < _CALL_PERIOD_S:
            return
        self._sent, self._sent_s = parameters, now_s
        lifetime_s = CALL_LIFETIME_S if interval_s > LONGEST_CALL_S else max(CALL_LIFETIME_S, 3 * interval_s)
        call = {"activation": self._activation, "for": lifetime_s, "parameters": parameters}
        self._sender.put(encode(call))

    def _read(self, payload: bytes, now_s: float) -> None:
        """Take over all values of a message that have the declared types."""
        try:
            message = decode(payload)
            values, state, number = message["values"], message["state"], message["number"]
            if not (isinstance(values, dict) and isinstance(state, str) and isinstance(number, int)):
                raise TypeError  # noqa: TRY301
        except (ValueError, KeyError, TypeError):
            self._report("sends what is no message")
            return
        for name, like in self._likes.items():
            try:
                self.__dict__[name] = convert(values[name], like)
            except KeyError:
                self._report(f"does not send '{name}'")
            except ValueError as error:
                self._report(f"sends a wrong '{name}': {error}")
        self.state = state[:200]
        self._is_remote_done = message.get("done") is True and message.get("activation") == self._activation
        self._received_s = now_s
        if self._is_reliable and self._number is not None and number > self._number + 1:
            self._report("sent messages that were lost")
        self._number = number

    def _find_names(self) -> None:
        """Find parameters and outputs, which the constructors of derived classes set."""
        self._has_names = True
        self._parameters = tuple(getattr(type(self).modulate, "__kwdefaults__", None) or ())
        others = (*_OWN_NAMES, *self._parameters)
        self._likes = {
            name: value
            for name, value in self.__dict__.items()
            if not name.startswith("_") and name not in others and not callable(value)
        }

    def _report(self, message: str) -> None:
        if message not in self._reported and len(self._reported) < MAX_WAITING:
            self._reported.add(message)
            print_error(f"{self._remote} {message} (reported once)", kind="warning")
