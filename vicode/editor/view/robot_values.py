"""View models of the values and step times of a robot's components."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from vicode.runs.guard_values import format_value

_MISSED_RATE = 0.9
_NOT_FINITE = ("nan", "inf", "-inf")
"""How numbers arrive that JSON does not have."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotValueRow:
    """A value of a component; `raw` is the value as received."""

    component: str
    name: str
    text: str
    raw: Any
    is_held: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotComponentRow:
    """A component: its timing, a warning if it is too slow, the age of its values, and the values."""

    component: str
    timing: str
    warning: str
    age: str
    values: tuple[RobotValueRow, ...]
    is_input: bool = False
    """Whether the world provides the values, so that viewers cannot set them."""


def component_row(
    component: str,
    step: Mapping[str, Any],
    *,
    age_s: float,
    frequency_hz: float | None,
    iteration_hz: float,
    held: Mapping[tuple[str, str], Any],
) -> RobotComponentRow:
    """The row of a component.

    Args:
        component: Its name.
        step: Its latest step, with values.
        age_s: Seconds since that step was received; 0 for the newest iteration.
        frequency_hz: Its frequency; None if it works in each iteration.
        iteration_hz: Iterations per second of the robot; 0 if unknown.
        held: The values that the editor holds, by component and name.
    """
    step_ms = step["step_ns"] / 1e6 if isinstance(step.get("step_ns"), int) else None
    parts = [f"{frequency_hz:g} Hz" if frequency_hz else "each iteration"]
    parts += [f"{step_ms:.2f} ms"] if step_ms is not None else []
    values = step.get("values")
    return RobotComponentRow(
        component=component,
        timing=" · ".join(parts),
        warning=_rate_warning(step_ms, frequency_hz, iteration_hz),
        age="" if age_s <= 0 else f"{age_s:.1f} s ago",
        values=_value_rows(component, values if isinstance(values, Mapping) else {}, held),
    )


def input_row(component: str, values: Mapping[str, Any]) -> RobotComponentRow:
    """The row of a component that only provides values, with those of the newest iteration."""
    return RobotComponentRow(
        component=component,
        timing="input",
        warning="",
        age="",
        values=_value_rows(component, values, {}),
        is_input=True,
    )


def _value_rows(
    component: str, values: Mapping[str, Any], held: Mapping[tuple[str, str], Any]
) -> tuple[RobotValueRow, ...]:
    return tuple(
        RobotValueRow(
            component=component, name=str(name), text=format_value(value), raw=value, is_held=(component, name) in held
        )
        for name, value in values.items()
    )


def _rate_warning(step_ms: float | None, frequency_hz: float | None, iteration_hz: float) -> str:
    """Why a component cannot work at its frequency, or ""."""
    if not frequency_hz:
        return ""
    if step_ms is not None and step_ms > 1e3 / frequency_hz:
        return f"Its step takes {step_ms:.1f} ms, longer than its period of {1e3 / frequency_hz:.3g} ms"
    if 0 < iteration_hz < frequency_hz * _MISSED_RATE:
        return (
            f"It works at {iteration_hz:.3g} Hz at most, as often as the robot iterates, instead of {frequency_hz:g} Hz"
        )
    return ""


def parse_value(text: str, old: Any) -> Any:
    """A value in the type of the old one; None if the text is no such value."""
    text = text.strip()
    if old in _NOT_FINITE:
        old = math.nan
    if isinstance(old, bool):
        return {"true": True, "false": False}.get(text.lower())
    if isinstance(old, int | float):
        try:
            return int(text) if isinstance(old, int) else float(text)
        except ValueError:
            return None
    return text or None
