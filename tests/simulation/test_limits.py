"""Limits on user code."""

import time

import pytest

from vicode.simulation.limits import MAX_LINES, CapturedOutput, TimeLimitError, time_limit


def test_output_is_captured_by_line() -> None:
    prints = CapturedOutput()
    print("one\ntwo", file=prints)
    print("th", end="", file=prints)
    print("ree", end="", file=prints)
    assert prints.drain() == (["one", "two", "three"], 0)
    assert prints.drain() == ([], 0)


def test_omitted_lines_are_counted() -> None:
    prints = CapturedOutput()
    for number in range(MAX_LINES + 7):
        print(number, file=prints)
    print("x" * 1_000_000, file=prints)
    lines, left_out = prints.drain()
    assert (len(lines), left_out) == (MAX_LINES, 8)


def test_a_long_line_is_cut() -> None:
    prints = CapturedOutput()
    print("x" * 1_000_000, end="", file=prints)
    assert len(prints.drain()[0][0]) == 2000


def test_the_time_limit_interrupts_a_loop() -> None:
    with pytest.raises(TimeLimitError), time_limit(0.05):
        _loop()


def _loop() -> None:
    while True:
        time.sleep(0.001)


def test_code_within_the_time_limit_is_not_interrupted() -> None:
    with time_limit(30):
        pass
