"""What `vicode bridge` shows: a table of the robots in a terminal, or one line per event; figures at the end."""

import sys
import time
from collections import deque
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Protocol

from rich.console import Console, Group, RenderableType
from rich.live import Live
from rich.table import Table
from rich.text import Text

from vicode.findings import escape_text

if TYPE_CHECKING:
    from vicode.bridge.robot import Robot
    from vicode.bridge.server import BridgeServer

_COUNTS = {
    "connections": "connections",
    "ticks": "ticks",
    "lines": "lines received",
    "dropped": "values replaced before they were read",
    "late": "values stale when they were read",
    "malformed": "malformed lines and values",
    "unknown": "values without a declaration",
    "events_dropped": "events and kept values dropped",
    "sent": "commands sent",
    "commands_dropped": "commands replaced before they were sent",
    "rests": "times at rest because inputs were too old",
    "errors": "errors",
}
_SHOWN_EVENTS = 6
_REFRESHES_PER_S = 4
_ROBOT_ROWS = 24


class BridgeView(Protocol):
    """Shows a server while it runs."""

    def close(self) -> None:
        """Stop, and print the figures of the run once."""


def open_view(server: "BridgeServer", *, is_plain: bool) -> BridgeView:
    """Show a server on standard output, as a table if that is a terminal."""
    return PlainBridgeView(server) if is_plain or not sys.stdout.isatty() else TableBridgeView(server)


class PlainBridgeView:
    """Prints one line per event."""

    def __init__(self, server: "BridgeServer") -> None:
        self._server, self._start_s = server, time.monotonic()
        self._is_closed = False
        server.on_event = self._print

    def close(self) -> None:
        if not self._is_closed:
            self._is_closed = True
            print("\n".join(["", *describe_totals(self._server, time.monotonic() - self._start_s)]), flush=True)

    def _print(self, robot: str, text: str) -> None:
        print(f"{time.monotonic() - self._start_s:8.2f} s  {robot}: {escape_text(text)}", flush=True)


class TableBridgeView:
    """Draws a table of the robots, and the last events below."""

    def __init__(self, server: "BridgeServer", console: Console | None = None) -> None:
        self._server, self._start_s = server, time.monotonic()
        self._console = console or Console(highlight=False)
        self._events: deque[str] = deque(maxlen=_SHOWN_EVENTS)
        self._rates = TickRates()
        self._is_closed = False
        server.on_event = self._add_event
        self._live = Live(
            get_renderable=self._draw, console=self._console, refresh_per_second=_REFRESHES_PER_S, transient=True
        )
        self._live.start()

    def close(self) -> None:
        if not self._is_closed:
            self._is_closed = True
            self._live.stop()
            self._console.print("\n".join(describe_totals(self._server, time.monotonic() - self._start_s)))

    def _add_event(self, robot: str, text: str) -> None:
        self._events.append(f"{time.monotonic() - self._start_s:8.2f} s  {robot}: {escape_text(text)}")

    def _draw(self) -> RenderableType:
        return render_bridge(self._server, self._events, self._rates.measure)


class TickRates:
    """Ticks per second of each robot, from one drawing to the next."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._seen: dict[str, tuple[float, int, float]] = {}

    def measure(self, robot: "Robot") -> float:
        now_s, ticks = self._clock(), robot.data.counts.ticks
        at_s, before, rate = self._seen.get(robot.name, (now_s, ticks, 0.0))
        if now_s - at_s >= 1 or robot.name not in self._seen:
            rate = (ticks - before) / (now_s - at_s) if now_s > at_s else 0.0
            self._seen[robot.name] = (now_s, ticks, rate)
        return rate


def render_bridge(server: "BridgeServer", events: "deque[str]", rate: "Callable[[Robot], float]") -> RenderableType:
    """Render the robots of a server and the last events."""
    robots = [*server.robots]
    number = f"{len(robots)} robot{'s' * (len(robots) != 1)}"
    title = Text(f"{server.address}  {number}  {server.ticks.skipped} ticks skipped", style="bold")
    table = Table(box=None, pad_edge=False, header_style="dim")
    for name in ("robot", "active"):
        table.add_column(name, no_wrap=name == "robot")
    for name in ("ticks/s", "age ms", "most", "command ms", "lines", "replaced", "dropped", "errors"):
        table.add_column(name, justify="right", no_wrap=True)
    for robot in robots[:_ROBOT_ROWS]:
        table.add_row(*_describe_robot(robot, rate(robot)))
    more = [Text(f"and {len(robots) - _ROBOT_ROWS} more", style="dim")] if len(robots) > _ROBOT_ROWS else []
    return Group(title, table, *more, *(Text(each, style="dim", no_wrap=True, overflow="ellipsis") for each in events))


def _describe_robot(robot: "Robot", rate: float) -> tuple[RenderableType, ...]:
    counts, ages = robot.data.counts, robot.ages
    states = robot.behavior.active_states() if robot.behavior is not None else []
    active = Text(" > ").join(Text.assemble(name, (f" {state}", "yellow")) for name, state in states)
    if awaited := robot.awaited:
        active = Text(f"waits for {'a value' if awaited == ['any'] else ', '.join(awaited)}", style="dim")
    elif robot.data.rest_reasons:
        active.append(" (at rest)", "red")
    command_age_ns = robot.data.command_age_ns
    errors = counts.errors + counts.malformed
    return (
        Text(robot.name, style="bold"),
        active,
        f"{rate:.1f}",
        f"{ages.newest / 1e6:.1f}" if ages.newest is not None else "-",
        f"{ages.greatest / 1e6:.1f}" if ages.number else "-",
        f"{command_age_ns / 1e6:.1f}" if command_age_ns is not None else "-",
        str(counts.lines),
        str(counts.dropped),
        Text(str(counts.events_dropped), style="red" if counts.events_dropped else ""),
        Text(str(errors), style="red" if errors else ""),
    )


def describe_totals(server: "BridgeServer", seconds: float) -> Iterator[str]:
    """The figures of a run, one per line; counts of 0 are left out."""
    total, ticks = server.total(), server.ticks
    yield f"served for {seconds:.1f} s; {ticks.skipped} of {ticks.run + ticks.skipped} ticks skipped"
    for name, words in _COUNTS.items():
        if value := getattr(total, name):
            yield f"{value:10} {words}"
    all_ages = {"data": server.collect_ages(), "obeyed commands": server.collect_command_ages()}
    for what, ages in all_ages.items():
        if ages.number:
            figures = (ages.quantile(0.5), ages.quantile(0.99), ages.greatest)
            middle, most, greatest = (f"{age_ns / 1e6:.1f} ms" for age_ns in figures)
            yield f"age of the {what}: median {middle}, 99 % up to {most}, at most {greatest}"
    if total.sent and not all_ages["obeyed commands"].number:
        yield "age of the obeyed commands: unknown, because no robot has acknowledged any"
