"""Cost of components in other processes: age under overload, round trips and bare zenoh, time per iteration.

Run it with `python -m benchmarks.net`; needs `vicode-fsm[net]`. Both processes are on this machine.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

from vicode.bica import Component, Root
from vicode.bica.net_session import open_session
from vicode.bica.remote import RemoteComponent

PORT = "26101"


class Source(Component):
    """Ten outputs, among them the time and the parameter."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.time_s = 0.0
        self.echo = 0.0
        self.x0 = self.x1 = self.x2 = self.x3 = self.x4 = self.x5 = self.x6 = self.x7 = 0.5

    def modulate(self, *, ping: float = 0.0) -> None:
        self.echo = ping

    def work(self) -> None:
        self.time_s = time.monotonic()


class RemoteSource(RemoteComponent):
    """As it is generated for `Source: {remote: source/Source}`."""

    def __init__(self, root: Root, *, reliable: bool = False) -> None:
        super().__init__(root, "source/Source", reliable=reliable)
        self.time_s = 0.0
        self.echo = 0.0
        self.ping = 0.0
        self.x0 = self.x1 = self.x2 = self.x3 = self.x4 = self.x5 = self.x6 = self.x7 = 0.0

    def modulate(self, *, ping: float = 0.0) -> None:
        self.ping = ping


class ReliableSource(RemoteSource):
    """Reads each message."""

    def __init__(self, root: Root) -> None:
        super().__init__(root, reliable=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=4.0)
    parser.add_argument("--serve", metavar="HZ", type=float, help=argparse.SUPPRESS)
    parser.add_argument("--echo", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    os.environ["VICODE_NET_PORT"] = PORT
    if options.echo:
        echo()
    elif options.serve is not None:
        serve(options.serve)
    else:
        measure_all(options.rounds, options.seconds)


def measure_all(rounds: int, seconds: float) -> None:
    results: dict[str, list[float]] = {}

    def add(name: str, value: float) -> None:
        results.setdefault(name, []).append(value)

    for _round in range(rounds):
        for name, kind in (("newest only", RemoteSource), ("reliable", ReliableSource)):
            ages = measure_ages(kind, seconds)
            add(f"age at 10 x overload, {name}: median, ms", statistics.median(ages) * 1e3)
            add(f"age at 10 x overload, {name}: largest, ms", max(ages) * 1e3)
        add("round trip of zenoh, µs", measure_zenoh() * 1e6)
        add("round trip modulate -> output, µs", measure_round_trip() * 1e6)
        for name, value in measure_cost().items():
            add(f"iteration of the caller, {name}, µs", value * 1e6)
        for name, value in measure_source().items():
            add(f"iteration of the source, {name}, µs", value * 1e6)
    for name, values in results.items():
        print(f"{name:52} {statistics.median(values):9.2f}   ({min(values):.2f} to {max(values):.2f})")


def measure_ages(kind: type[RemoteSource], seconds: float) -> list[float]:
    """Ages of the time that a caller at 100 Hz reads from a source at 1000 Hz, in the second half of the time."""
    ages = []
    with other_process("--serve", "1000"), connected(kind) as root:
        remote, end = root.main, time.monotonic() + seconds
        while time.monotonic() < end:
            time.sleep(0.01)
            root.step()
            if time.monotonic() > end - seconds / 2:
                ages.append(time.monotonic() - remote.time_s)
    return ages


def measure_round_trip(count: int = 500) -> float:
    """Median time from the step that sends a parameter to the one that reads it in an output."""
    with other_process("--serve", "0"), connected(RemoteSource) as root:
        return median_time(count, lambda number: exchange(root, float(number)))


def exchange(root: Root, ping: float) -> None:
    remote: Any = root.main
    remote.modulate(ping=ping)
    root.step()
    while remote.echo != ping:
        root.step()


def measure_zenoh(count: int = 500) -> float:
    """Median time of a message of the same length and its answer, both sides polling."""
    session = open_session()
    try:
        with other_process("--echo"):
            sender, receiver = session.sender("vicode/bench/ping"), session.receive("vicode/bench/pong", 1)
            while receiver.take() is None:
                sender.put(b"0")
                time.sleep(0.01)

            def ping(number: int) -> None:
                payload = f"{number:0100}".encode()
                sender.put(payload)
                while (received := receiver.take()) is None or received[1] != payload:
                    pass

            return median_time(count, ping)
    finally:
        session.close()


def measure_cost(count: int = 2000) -> dict[str, float]:
    """Median time of an iteration with a local component, and with a remote one with and without a new message.

    The source is in this process: only the iterations of the caller are timed.
    """
    new, idle = [], []
    with Root(Source) as source:
        times = {"local component": median_time(count, lambda _number: source.step())}
        source.connect("source")
        with Root(RemoteSource) as caller:
            for _number in range(count):
                source.step()
                new.append(median_time(1, lambda _number: caller.step()))
                idle.append(median_time(1, lambda _number: caller.step()))
    times["remote, new message"] = statistics.median(new)
    times["remote, no message"] = statistics.median(idle)
    return times


def measure_source(count: int = 2000) -> dict[str, float]:
    """Median time of an iteration of a robot whose components no process or one process reads."""
    with Root(Source) as root:
        times = {"not connected": median_time(count, lambda _number: root.step())}
        root.connect("source")
        times["connected"] = median_time(count, lambda _number: root.step())
        with Root(RemoteSource):
            times["read by one"] = median_time(count, lambda _number: root.step())
    return times


def median_time(count: int, function: Callable[[int], None]) -> float:
    times = []
    for number in range(1, count + 1):
        begin = time.perf_counter()
        function(number)
        times.append(time.perf_counter() - begin)
    return statistics.median(times)


@contextlib.contextmanager
def connected(kind: type[RemoteSource]) -> Iterator[Any]:
    """A root of one remote component, after the first message."""
    with Root(kind) as root:
        while not root.main.is_alive:
            root.step()
            time.sleep(0.001)
        yield root


@contextlib.contextmanager
def other_process(*arguments: str) -> Iterator[None]:
    command = [sys.executable, "-m", "benchmarks.net", *arguments]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        assert process.stdout is not None
        process.stdout.readline()
        try:
            yield
        finally:
            process.kill()


def serve(hertz: float) -> None:
    """Step a source at a frequency, or with 0 as often as possible."""
    with Root(Source) as root:
        root.connect("source")
        print("ready", flush=True)
        due = time.monotonic()
        while True:
            root.step()
            due += 1 / hertz if hertz else 0.0
            if due > time.monotonic():
                time.sleep(due - time.monotonic())


def echo() -> None:
    session = open_session()
    sender, receiver = session.sender("vicode/bench/pong"), session.receive("vicode/bench/ping", 1)
    print("ready", flush=True)
    while True:
        received = receiver.take()
        if received is not None:
            sender.put(received[1])


if __name__ == "__main__":
    main()
