"""What keeps user code within bounds."""

import time

import pytest

from vicode.simulation.limits import MOST_LINES, Prints, TimeLimitError, time_limit


def test_prints_are_kept_line_by_line() -> None:
    prints = Prints()
    print("one\ntwo", file=prints)
    print("th", end="", file=prints)
    print("ree", end="", file=prints)
    assert prints.take() == (["one", "two", "three"], 0)
    assert prints.take() == ([], 0)


def test_more_prints_are_counted() -> None:
    prints = Prints()
    for number in range(MOST_LINES + 7):
        print(number, file=prints)
    print("x" * 1_000_000, file=prints)
    lines, left_out = prints.take()
    assert (len(lines), left_out) == (MOST_LINES, 8)


def test_a_long_line_is_cut() -> None:
    prints = Prints()
    print("x" * 1_000_000, end="", file=prints)
    assert len(prints.take()[0][0]) == 2000


def test_time_is_up_in_the_middle_of_a_loop() -> None:
    with pytest.raises(TimeLimitError), time_limit(0.05):
        _loop()


def _loop() -> None:
    while True:
        time.sleep(0.001)


def test_enough_time_is_enough() -> None:
    with time_limit(30):
        pass
