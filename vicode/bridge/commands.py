"""Commands of a behavior, from the call to the line: which are due, and which a newer one replaces."""

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from vicode.bridge.declarations import Command
from vicode.bridge.frames import shorten

if TYPE_CHECKING:
    from vicode.bridge.world import Counts

Parameters = tuple[Any, ...]


class CommandQueue:
    """The commands of one robot; of each target, only the newest one waits to be sent."""

    __slots__ = ("_called", "_called_before", "_commands", "_counts", "_due_ns", "_last", "_waiting", "is_urgent")

    def __init__(self, commands: Iterable[Command], counts: "Counts") -> None:
        self._commands = tuple(commands)
        self._counts = counts
        self._called: dict[str, tuple[Command, Parameters]] = {}
        self._called_before: frozenset[str] = frozenset()
        self._last: dict[str, Parameters] = {}
        self._due_ns: dict[str, int] = {}
        self._waiting: dict[str, Parameters] = {}
        self.is_urgent = False
        """Whether commands wait that go to rest: they are sent at once."""

    def call(self, command: Command, parameters: Parameters) -> None:
        """A behavior calls a command; the last call of a tick counts."""
        self._called[command.target] = (command, parameters)

    def end_tick(self, now_ns: int, *, is_at_rest: bool = False) -> None:
        """Select what the calls of this tick change; at rest, commands that stop replace those that were called."""
        if is_at_rest:
            self._rest()
        for target, (command, parameters) in self._called.items():
            if command.period_ns:
                is_due = now_ns >= self._due_ns.get(target, now_ns)
            else:
                is_due = parameters != self._last.get(target) or target not in self._called_before
            if is_due:
                self._due_ns[target] = now_ns + command.period_ns
                self._last[target] = parameters
                self._counts.commands_dropped += self._waiting.pop(target, None) is not None
                self._waiting[target] = parameters
        self._called_before = frozenset(self._called)
        self._called.clear()

    @property
    def has_waiting(self) -> bool:
        return bool(self._waiting)

    def take(self) -> dict[str, Parameters]:
        """The commands to send now, by target in the order of their calls."""
        taken = {target: tuple(map(_shorten, parameters)) for target, parameters in self._waiting.items()}
        self._waiting.clear()
        self.is_urgent = False
        self._counts.sent += len(taken)
        return taken

    def repeat(self) -> None:
        """Send everything again that is called from now on: the robot may have restarted."""
        self._last.clear()
        self._due_ns.clear()
        self._waiting.clear()

    def stop(self) -> Mapping[str, Parameters]:
        """The commands that stop the robot; commands that wait are discarded."""
        self.repeat()
        return {each.target: each.stop for each in self._commands if each.stop is not None}

    def _rest(self) -> None:
        """Replace calls, and what the robot obeys still, by the commands that stop it; some have nothing to stop."""
        for command in self._commands:
            target, stop = command.target, command.stop
            if stop is not None and (target in self._called or target in self._last):
                self.is_urgent = self.is_urgent or self._last.get(target) != stop
                self._called[target] = (command, stop)


def _shorten(value: Any) -> Any:
    return shorten(value) if isinstance(value, float) else value
