"""Cycle times: the measured duration and frequency of the work of each component."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .component import Component


@dataclass(slots=True)
class CycleTimes:
    """Durations of the steps in which a component worked, including the steps of components that it stepped.

    Attributes:
        count: Number of steps.
        total_ns: Sum of all durations.
        min_ns: Shortest duration.
        max_ns: Longest duration.
        first_work_ns: Time of the iteration of the first step.
        last_work_ns: Time of the iteration of the last step.
    """

    count: int = 0
    total_ns: int = 0
    min_ns: int = 0
    max_ns: int = 0
    first_work_ns: int = 0
    last_work_ns: int = 0

    def add(self, duration_ns: int, now_ns: int) -> None:
        """Count a step that took `duration_ns`, in the iteration at `now_ns`."""
        if self.count == 0:
            self.min_ns = duration_ns
            self.first_work_ns = now_ns
        self.count += 1
        self.total_ns += duration_ns
        self.min_ns = min(self.min_ns, duration_ns)
        self.max_ns = max(self.max_ns, duration_ns)
        self.last_work_ns = now_ns

    @property
    def mean_ns(self) -> float:
        """Mean duration of a step; 0 if there was none."""
        return self.total_ns / self.count if self.count else 0.0

    @property
    def real_frequency_hz(self) -> float:
        """Mean frequency of the work on the clock of the root."""
        spent_ns = self.last_work_ns - self.first_work_ns
        return (self.count - 1) * 1e9 / spent_ns if spent_ns > 0 else 0.0

    def as_plain(self) -> dict[str, float]:
        """Return the figures as JSON data, with times in milliseconds."""
        return {
            "count": self.count,
            "mean_ms": self.mean_ns / 1e6,
            "min_ms": self.min_ns / 1e6,
            "max_ms": self.max_ns / 1e6,
            "real_frequency_hz": self.real_frequency_hz,
        }


def measure_steps(component: Component, cycle_times: dict[str, CycleTimes]) -> None:
    """Replace `component.step` by a function that also updates the entry of the component in `cycle_times`."""
    plain_step = component.step
    times = cycle_times.setdefault(type(component).__name__, CycleTimes())

    def measured_step() -> None:
        works = will_work(component)
        begin_ns = time.perf_counter_ns()
        try:
            plain_step()
        finally:
            if works:
                times.add(time.perf_counter_ns() - begin_ns, component.root.now_ns)

    replace_step(component, measured_step)


def will_work(component: Component) -> bool:
    """Return whether the next step of a component works, because it restarts or its period has elapsed."""
    root = component.root
    missed = root.iteration - component._stepped_in
    if missed == 0 and getattr(component, "_restarted_in", -1) == root.iteration:
        missed = 2  # as in the step of an XabslComponent
    is_restart = missed > 1 and (missed > root.iteration + 1 or not component.resume)
    return is_restart or root.now_ns - component._worked_ns >= component._period_ns


def replace_step(component: Component, step: Callable[[], None]) -> None:
    """Shadow the method `step` in this instance, so that components without observer have no overhead."""
    component.__dict__["step"] = step
