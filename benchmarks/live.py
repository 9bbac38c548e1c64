"""Cost of the live view and of recording: the time of an iteration, and the age of what viewers see.

Run it with `python -m benchmarks.live`. Viewers read on loopback in their own processes. Times of the robot are of its
thread, so that viewers and the server cost it only what they take from it.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import random
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from benchmarks.sample_machines import TickClock, load_component, make_machine
from benchmarks.senses import Senses
from vicode.bica import Component, Root

VIEWER = """
import json, socket, sys
host, port, token, delay = sys.argv[1:]
import time
with socket.create_connection((host, int(port))) as connection:
    connection.sendall(json.dumps({"token": token, "rate_hz": 30}).encode() + b"\\n")
    print("ready", flush=True)
    while connection.recv(4096 if float(delay) else 1 << 20):
        time.sleep(float(delay))
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--ticks", type=int, default=20_000)
    options = parser.parse_args()
    ratios: dict[str, list[float]] = {
        "open, no viewer": [],
        "1 viewer": [],
        "10 viewers": [],
        "10 that hardly read": [],
        "recording": [],
        "recording without values": [],
    }
    plain_ns: list[float] = []
    for _round in range(options.rounds):
        base = measure(make_root(), options.ticks)
        plain_ns.append(base)
        ratios["open, no viewer"].append(measure_watched(0, options.ticks) / base)
        ratios["1 viewer"].append(measure_watched(1, options.ticks) / base)
        ratios["10 viewers"].append(measure_watched(10, options.ticks) / base)
        ratios["10 that hardly read"].append(measure_watched(10, options.ticks, delay_s=1.0) / base)
        ratios["recording"].append(measure_recorded(options.ticks, values=True) / base)
        ratios["recording without values"].append(measure_recorded(options.ticks, values=False) / base)
    print(f"6 states, 12 transitions: {statistics.median(plain_ns) / 1000:.2f} µs an iteration")
    for name, values in ratios.items():
        print(f"  {name:24} {statistics.median(values):6.3f} x")
    print_ages()


def make_root() -> Root:
    root = Root(load_component(make_machine(6, 2, acts=True)), clock=TickClock())
    component: Component = root.main
    component.senses = root.component(Senses)  # type: ignore[attr-defined]
    return root


def measure(root: Root, ticks: int) -> float:
    """Median time of an iteration in ns of this thread, over parts of the run."""
    chance = random.Random(1)
    senses = root.component(Senses)
    names = [name for name, value in vars(senses).items() if isinstance(value, float)]
    parts = []
    for _part in range(10):
        begin = time.thread_time_ns()
        for _tick in range(ticks // 10):
            setattr(senses, names[_tick % len(names)], chance.random())
            root.step()
        parts.append((time.thread_time_ns() - begin) / (ticks // 10))
    return statistics.median(parts)


def measure_watched(viewers: int, ticks: int, delay_s: float = 0.0) -> float:
    with make_root() as root, watched(root, viewers, delay_s):
        for _step in range(200):
            root.step()
            time.sleep(0.0005)
        return measure(root, ticks)


def measure_recorded(ticks: int, *, values: bool) -> float:
    with tempfile.TemporaryDirectory() as folder, make_root() as root:
        root.record(Path(folder, "run.jsonl"), values=values)
        return measure(root, ticks)


@contextlib.contextmanager
def watched(root: Root, viewers: int, delay_s: float) -> Iterator[None]:
    server = root.watch()
    host, _colon, port = server.address.rpartition(":")
    processes = [
        subprocess.Popen(
            [sys.executable, "-c", VIEWER, host, port, server.token, str(delay_s)], stdout=subprocess.PIPE, text=True
        )
        for _viewer in range(viewers)
    ]
    for process in processes:
        assert process.stdout is not None
        process.stdout.readline()
    try:
        yield
    finally:
        for process in processes:
            process.kill()
            process.wait()
            assert process.stdout is not None
            process.stdout.close()


def print_ages() -> None:
    """How old an iteration is when a viewer reads it, in iterations, at 50 Hz and at ten times more than it reads."""
    for name, period_s, rate_hz in (("50 Hz, read at 50 Hz", 0.02, 50), ("500 Hz, read at 50 Hz", 0.002, 50)):
        with make_root() as root:
            server = root.watch()
            host, _colon, port = server.address.rpartition(":")
            with socket.create_connection((host, int(port))) as connection:
                connection.sendall(json.dumps({"token": server.token, "rate_hz": rate_hz}).encode() + b"\n")
                connection.setblocking(False)
                ages = list(iter_ages(root, connection, period_s))
            print(f"  {name}: age {statistics.median(ages):g} iterations (most {max(ages)})")


def iter_ages(root: Root, connection: socket.socket, period_s: float) -> Iterator[int]:
    buffer = b""
    end_s = time.monotonic() + 3
    while time.monotonic() < end_s:
        root.step()
        time.sleep(period_s)
        with contextlib.suppress(BlockingIOError):
            buffer += connection.recv(1 << 20)
        *lines, buffer = buffer.split(b"\n")
        numbers = [json.loads(line).get("iteration") for line in lines]
        yield from (root.iteration - number for number in numbers[-1:] if number)


if __name__ == "__main__":
    main()
