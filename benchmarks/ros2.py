"""Age and loss of messages of ROS 2 and the cost of an iteration, with 100 topics at 50 Hz, against cyclonedds alone.

Run it with `python -m benchmarks.ros2`; needs `vicode-fsm[ros2]`. Both processes are on this machine.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from vicode.bica import Component, Root, ros_session
from vicode.bica.ros_topic import TopicComponent

POINT = "geometry_msgs/msg/Point"
PERIOD_S = 0.02
DOMAIN = "187"
Sample = tuple[float, float]
"""The time when a message was written, and its number."""


def make_reader(number: int) -> type[TopicComponent]:
    """A component as it is generated for `Point: {topic: /pointN, outputs: {time_s: x, number: y}}`."""

    def construct(self: Any, root: Root) -> None:
        outputs = {"time_s": "x", "number": "y"}
        TopicComponent.__init__(self, root, f"/point{number}", POINT, outputs=outputs)
        self.time_s = self.number = -1.0

    return type(f"Point{number}", (TopicComponent,), {"__init__": construct})


def make_writer(number: int) -> type[TopicComponent]:
    """A component as it is generated for `Target: {topic: /targetN, parameters: {time_s: x}}`."""

    def construct(self: Any, root: Root) -> None:
        TopicComponent.__init__(self, root, f"/target{number}", POINT, parameters={"time_s": "x"})
        self.time_s = 1.0

    def modulate(self: Any, *, time_s: float = 1.0) -> None:
        self.time_s = time_s

    return type(f"Target{number}", (TopicComponent,), {"__init__": construct, "modulate": modulate})


def make_hub(kinds: list[type[TopicComponent]]) -> type[Component]:
    """A component that steps others."""

    class Hub(Component):
        def __init__(self, root: Root) -> None:
            super().__init__(root)
            self.topics: list[Any] = [root.component(kind) for kind in kinds]

        def work(self) -> None:
            for topic in self.topics:
                topic.step()

    return Hub


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--topics", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--publish", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    os.environ["ROS_DOMAIN_ID"] = DOMAIN
    if options.publish:
        publish(options.topics)
        return
    results: dict[str, list[float]] = {}
    for _round in range(options.rounds):
        for name, values in measure(options.topics, options.seconds):
            results.setdefault(name, []).append(values)
    for name, found in results.items():
        print(f"{name:56} {statistics.median(found):9.2f}   ({min(found):.2f} to {max(found):.2f})")


def measure(topics: int, seconds: float) -> Iterator[tuple[str, float]]:
    """Names and values of one round."""
    with publisher(topics):
        with Root(make_hub([make_reader(number) for number in range(topics)])) as root:
            hub: Any = root.main
            yield from measure_reading("vicode", seconds, root.step, lambda: [(t.time_s, t.number) for t in hub.topics])
        readers = [ros_session.open_session().reader(f"/point{number}", POINT) for number in range(topics)]
        plain: list[Any] = [reader._reader for reader in readers]  # type: ignore[attr-defined]
        newest: list[Sample] = [(-1.0, -1.0)] * topics

        def take() -> None:
            for index, reader in enumerate(plain):
                for message in reader.take(1):
                    newest[index] = (message.x, message.y)

        yield from measure_reading("cyclonedds alone", seconds, take, lambda: list(newest))
    with Root(make_hub([make_writer(number) for number in range(topics)])) as root:
        yield f"vicode: publishing {topics} messages, ms", median_ms(root.step)
    writers = [ros_session.open_session().writer(f"/plain{number}", POINT) for number in range(topics)]
    message = ros_session.make_message(POINT)
    yield (
        f"cyclonedds alone: publishing {topics} messages, ms",
        median_ms(lambda: [write(message) for write in writers]),
    )


def measure_reading(
    name: str, seconds: float, step: Callable[[], object], read: Callable[[], list[Sample]]
) -> Iterator[tuple[str, float]]:
    """Read all topics at the rate of the publisher; ages of what is read, messages that were not, times of a step."""
    while any(number < 0 for _time, number in read()):
        step()
        time.sleep(PERIOD_S)
    first, seen, ages, times = read(), [set[float]() for _topic in read()], list[float](), list[float]()
    end_s = next_s = time.monotonic()
    end_s += seconds
    while next_s < end_s:
        begin_s = time.perf_counter()
        step()
        times.append(time.perf_counter() - begin_s)
        now_s = time.monotonic()
        for (written_s, number), numbers in zip(read(), seen, strict=True):
            if number not in numbers:
                ages.append(now_s - written_s)
                numbers.add(number)
        next_s += PERIOD_S
        time.sleep(max(0.0, next_s - time.monotonic()))
    sent = sum(last[1] - begin[1] for begin, last in zip(first, read(), strict=True))
    received = sum(len(numbers - {begin[1]}) for begin, numbers in zip(first, seen, strict=True))
    yield f"{name}: age of a new message, median, ms", statistics.median(ages) * 1e3
    yield f"{name}: age of a new message, 99 %, ms", statistics.quantiles(ages, n=100)[-1] * 1e3
    yield f"{name}: messages not read, %", 100 * (1 - received / sent)
    yield f"{name}: reading {len(first)} topics, median, ms", statistics.median(times) * 1e3


def median_ms(function: Callable[[], object], count: int = 200) -> float:
    times = []
    for _number in range(count):
        begin_s = time.perf_counter()
        function()
        times.append(time.perf_counter() - begin_s)
    return statistics.median(times) * 1e3


@contextmanager
def publisher(topics: int) -> Iterator[None]:
    command = [sys.executable, "-m", "benchmarks.ros2", "--publish", "--topics", str(topics)]
    with subprocess.Popen(command) as process:
        try:
            yield
        finally:
            process.kill()


def publish(topics: int) -> None:
    """Write all topics at 50 Hz until the process is killed."""
    writers = [ros_session.open_session().writer(f"/point{number}", POINT) for number in range(topics)]
    message, next_s = ros_session.make_message(POINT), time.monotonic()
    while True:
        message.y += 1.0
        for write in writers:
            message.x = time.monotonic()
            write(message)
        next_s += PERIOD_S
        time.sleep(max(0.0, next_s - time.monotonic()))


if __name__ == "__main__":
    main()
