"""Faults of a robot, with a clock of the test."""

from vicode.simulated_robot.faults import FAULTS, NO_FAULT, Fault, FaultySender

SENSORS = {"LASER": (1.0, 2.0), "INS": (0.0, 0.0, 90.0)}


def send(fault: Fault, *, seconds: int = 10) -> list[tuple[float, float, set[str]]]:
    """When messages are sent, when they were measured, and their targets; the robot measures 20 times per second."""
    sender = FaultySender(fault)
    sent = []
    for number in range(seconds * 20):
        now_s = number / 20
        sender.put(now_s, SENSORS)
        sent += [(now_s, measured_s, set(sensors)) for measured_s, sensors in sender.take(now_s)]
    return sent


def test_without_a_fault_all_is_sent_at_once() -> None:
    assert send(NO_FAULT) == [(number / 20, number / 20, {"LASER", "INS"}) for number in range(200)]


def test_a_slow_sender_leaves_out_what_is_in_between() -> None:
    times = [now_s for now_s, _measured_s, _targets in send(Fault(name="", doc="", period_s=0.4))]
    assert times[:3] == [0, 0.4, 0.8]
    assert len(times) == 25


def test_a_lost_sensor_is_missing_for_a_while() -> None:
    sent = send(Fault(name="", doc="", lost="LASER", lost_s=(5.0, 8.0)))
    assert [now_s for now_s, _measured_s, targets in sent if "LASER" not in targets] == [
        number / 20 for number in range(100, 160)
    ]


def test_late_messages_keep_their_order_and_their_times() -> None:
    sent = send(Fault(name="", doc="", jitter_s=0.2))
    delays = [now_s - measured_s for now_s, measured_s, _targets in sent]
    assert [measured_s for _now_s, measured_s, _targets in sent] == [number / 20 for number in range(len(sent))]
    assert min(delays) >= 0
    assert 0.1 < max(delays) < 0.26


def test_faults_have_names() -> None:
    assert [each.name for each in FAULTS] == ["none", "slow reader", "slow sender", "lost sensor", "jitter"]
