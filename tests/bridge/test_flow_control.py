"""Flow control: what a robot that reads slowly has in its buffers, simulated with a clock of the test."""

from collections import deque

import pytest

from vicode.bridge.flow_control import DEFAULT_COMMAND_RATE_HZ, FlowControl
from vicode.bridge.frames import FrameError

MS = 1_000_000


def drive_slow_reader(*, read_ms: int, acknowledges: str, seconds: int = 40) -> tuple[int, int]:
    """A robot that reads a line per `read_ms`, and a behavior with a new command every 5 ms.

    Returns:
        The greatest age of a command when it is read, and the greatest age that the bridge knows, in ms.
    """
    flow = FlowControl(0)
    if acknowledges:
        flow.acknowledge_lines(0, 0)
    buffer: deque[tuple[int, float]] = deque()
    oldest = known = read = 0
    for now_ms in range(0, seconds * 1000, 5):
        now_ns = now_ms * MS
        if now_ms % read_ms == 0 and buffer:
            made_ms, time_s = buffer.popleft()
            oldest, read = max(oldest, now_ms - made_ms), read + 1
            if acknowledges == "lines":
                flow.acknowledge_lines(read, now_ns)
            elif acknowledges == "time":
                flow.acknowledge_time(round(time_s * 1e9), now_ns)
        known = max(known, (flow.age_ns(now_ns) or 0) // MS)
        if flow.may_send(now_ns):
            buffer.append((now_ms, flow.add(1, now_ns, now_ns)))
    return oldest, known


@pytest.mark.parametrize("acknowledges", ["lines", "time"])
@pytest.mark.parametrize("read_ms", [10, 100, 1000])
def test_a_robot_that_acknowledges_obeys_no_command_older_than_two_of_its_reads(
    acknowledges: str, read_ms: int
) -> None:
    oldest, known = drive_slow_reader(read_ms=read_ms, acknowledges=acknowledges)
    assert oldest <= 2 * read_ms
    assert known == oldest


def test_a_robot_that_acknowledges_nothing_gets_few_commands() -> None:
    oldest, known = drive_slow_reader(read_ms=100, acknowledges="")
    assert oldest <= 100
    assert known == 0
    # Slower than the limit of rate: nothing tells the bridge that its commands queue up.
    assert drive_slow_reader(read_ms=1000, acknowledges="")[0] > 20_000


def test_the_rate_of_a_robot_that_acknowledges_nothing() -> None:
    flow = FlowControl(0)
    sent = 0
    for now_ms in range(10_000):
        if flow.may_send(now_ms * MS):
            flow.add(1, now_ms * MS, now_ms * MS)
            sent += 1
    assert sent == 10 * DEFAULT_COMMAND_RATE_HZ


def test_the_rate_counts_lines_of_several_commands() -> None:
    flow = FlowControl(0, rate_hz=4)
    flow.add(3, 0, 0)
    assert [flow.may_send(now_ms * MS) for now_ms in (0, 749, 750)] == [False, False, True]


def test_the_newest_acknowledgment_counts_for_all_before() -> None:
    flow = FlowControl(1_000 * MS)
    times = [flow.add(2, made_ms * MS, made_ms * MS) for made_ms in (1_100, 1_200, 1_300)]
    assert times == [0.1, 0.2, 0.3]
    assert flow.age_ns(1_300 * MS) is None
    assert flow.acknowledge_lines(3, 1_350 * MS) == 250 * MS
    assert (flow.may_send(1_400 * MS), flow.age_ns(1_400 * MS)) == (False, 250 * MS)
    assert flow.age_ns(1_500 * MS) == 300 * MS
    assert flow.acknowledge_time(300 * MS, 1_500 * MS) == 200 * MS
    assert flow.acknowledge_time(200 * MS, 1_600 * MS) is None
    assert (flow.may_send(1_600 * MS), flow.age_ns(1_600 * MS)) == (True, 200 * MS)


def test_what_was_not_sent_cannot_be_acknowledged() -> None:
    flow = FlowControl(0)
    with pytest.raises(FrameError, match="ack is 1, but no commands were sent"):
        flow.acknowledge_time(1_000 * MS, 0)
    flow.add(1, 500 * MS, 500 * MS)
    with pytest.raises(FrameError, match=r"ack is 1, but the newest commands have the time 0\.5"):
        flow.acknowledge_time(1_000 * MS, 0)
    with pytest.raises(FrameError, match="ACK says 2 command lines were read, but 1 were sent"):
        flow.acknowledge_lines(2, 0)
    assert not flow.is_acknowledging


def test_an_acknowledgment_is_overdue_after_a_second() -> None:
    flow = FlowControl(0)
    flow.add(1, 0, 0)
    assert not flow.is_overdue(2_000 * MS)
    flow.acknowledge_lines(0, 0)
    assert [flow.is_overdue(now_ms * MS) for now_ms in (1_000, 1_001)] == [False, True]
    flow.acknowledge_lines(1, 1_001 * MS)
    assert not flow.is_overdue(5_000 * MS)
