"""What is shown of a run."""

import io

from rich.console import Console

from vicode.cli.live_view import LiveTracePrinter, render_iteration
from vicode.traces.descriptions import StateChangeTracker, TraceRecord, describe_summary, describe_world


def step(component: str, state: str, by: str | None = None, **more: object) -> dict[str, object]:
    return {
        "component": component,
        "by": by,
        "link": "root" if by is None else "requires",
        "worked": True,
        "state": state,
        "state_time_ns": 1_500_000_000,
        "changed_from": None,
        "transition": None,
        "parameters": {},
        "done": False,
        **more,
    }


def record(*steps: dict[str, object], **more: object) -> TraceRecord:
    return {"iteration": 7, "time_ns": 2_000_000_000, "tree": list(steps), **more}


def drawn(value: TraceRecord) -> list[str]:
    console = Console(file=io.StringIO(), width=100)
    with console.capture() as capture:
        console.print(render_iteration(value))
    return [line.rstrip() for line in capture.get().splitlines()]


def test_changes_are_told_once_and_restarts_too() -> None:
    changes = StateChangeTracker()
    assert changes.describe_changes(record(step("A", "X"), step("Eyes", "", "A"))) == ["    2.00 s  A: X"]
    assert changes.describe_changes(record(step("A", "X"))) == []
    changed = step("A", "Y", changed_from="X", transition="sees")
    assert changes.describe_changes(record(changed)) == ["    2.00 s  A: X → Y  (sees)"]
    assert changes.describe_changes(record(step("A", "X"))) == ["    2.00 s  A: Y → X"]


def test_the_tree_shows_who_activated_whom() -> None:
    called = step("Legs", "Walk", "Two", link="modulates", parameters={"speed": 0.5, "side": "Side.left"})
    lines = drawn(record(step("One", "X"), step("Two", "", "One"), called, world={"ball": 3.25}))
    assert lines == [
        "    2.00 s  iteration 7",
        "One  X 1.50 s",
        "└── requires Two",
        "    └── modulates Legs  Walk 1.50 s  speed 0.5  side Side.left",
        "ball 3.25",
    ]


def test_the_live_view_scrolls_changes_and_texts() -> None:
    file = io.StringIO()
    watcher = LiveTracePrinter(Console(file=file, width=80, force_terminal=True, color_system=None))
    watcher.show_iteration(record(step("One", "X")), ["    2.00 s  One: W → X"])
    watcher.show_text("error: something")
    watcher.close()
    text = file.getvalue()
    assert "    2.00 s  One: W → X" in text
    assert "error: something" in text
    assert "iteration 7" in text


def test_worlds_may_say_anything() -> None:
    assert describe_world({"x": 1.5, "y": None, "z": "a"}) == "x 1.5  y -  z a"
    assert describe_world(None) == ""
    assert describe_world([1]) == "[1]"


def test_a_summary_does_without_world_and_times() -> None:
    summary = {"time_ns": 0, "iterations": 1, "stopped": "limit", "state": "", "errors": 2, "world": None}
    assert describe_summary(summary).splitlines() == [
        "",
        "0.00 s in 1 iterations, stopped: limit, last state: -",
        "errors: 2",
    ]


def test_a_summary_compares_target_and_real_frequency() -> None:
    times = {"count": 9, "mean_ms": 1.0, "max_ms": 2.0}
    summary = {
        "time_ns": 0,
        "iterations": 9,
        "stopped": "limit",
        "state": "",
        "errors": 0,
        "tick_ms": 100 / 6,
        "overruns": 2,
        "cycle_times": {
            "Eyes": {**times, "target_hz": 15.0, "real_frequency_hz": 14.25},
            "Player": {**times, "target_hz": None, "real_frequency_hz": 60.0},
        },
    }
    assert describe_summary(summary).splitlines()[2:] == [
        "component    works   mean ms    max ms target Hz   real Hz",
        "Eyes             9     1.000     2.000     15.00     14.25",
        "Player           9     1.000     2.000         -     60.00",
        "overruns: 2 iterations took longer than the tick of 16.67 ms",
        "errors: 0",
    ]
