"""Evaluates the guards of a state with the values of a recorded iteration, as the probes of a simulation do."""

import math
from collections.abc import Mapping
from typing import Any

from vicode.model.constant_folding import evaluate_constants
from vicode.model.decision_keys import transition_key
from vicode.model.design import COMMON, Design, Guard
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    Expr,
    Scope,
    Value,
    build_scope,
    evaluate,
    parse_expression,
    read_name,
    walk,
)
from vicode.model.project import Project
from vicode.model.traversal import iter_decisions
from vicode.runs.recording import Recording
from vicode.simulation import IterationResult

_MAX_LOOKBACK = 100
_NUMBERS = {"nan": float("nan"), "inf": float("inf"), "-inf": float("-inf")}

Steps = Mapping[str, Mapping[str, Any]]
"""The latest step of each component."""


def latest_steps(recording: Recording, number: int, components: frozenset[str]) -> dict[str, Mapping[str, Any]]:
    """The latest step of components up to an iteration: what was not stepped keeps its values."""
    found: dict[str, Mapping[str, Any]] = {}
    for each in range(number, max(0, number - _MAX_LOOKBACK), -1):
        iteration = recording.iteration(each)
        for step in reversed(iteration.tree if iteration else []):
            found.setdefault(str(step["component"]), step)
        if components <= found.keys():
            break
    return found


def guard_values(
    project: Project,
    design: Design,
    iteration: IterationResult,
    steps: Steps,
    tuned: Mapping[str, Any] | None = None,
) -> "GuardValues":
    """What the guards of a design read in an iteration.

    Args:
        project: The project of the design.
        design: The design whose state is active; names that it does not declare are unknown.
        iteration: The iteration.
        steps: The latest steps with values; those of the iteration itself at least.
        tuned: Values of constants that differ from the project.
    """
    values = _collect_values(design, iteration, steps)
    constants = {**evaluate_constants(project), **{name: _plain(value) for name, value in (tuned or {}).items()}}
    return GuardValues(design, build_scope(project, design), {**constants, **values}, iteration)


def read_recorded(iteration: IterationResult, component: str, project: Project) -> dict[str, Any]:
    """The recorded values of one component in an iteration, and the constants; empty if it has none."""
    recorded = iteration.values().get(component) or {}
    found = {name: _plain(value) for name, value in recorded.items()}
    return {**evaluate_constants(project), **{name: value for name, value in found.items() if value is not None}}


def evaluate_guards(
    project: Project, design: Design, iteration: IterationResult, steps: Steps, tuned: Mapping[str, Any] | None = None
) -> dict[str, dict[str, Any]]:
    """The guards of the active state by decision, with `holds`, `parts` and `reads` (None: unknown).

    The arguments are those of `guard_values`.
    """
    values = guard_values(project, design, iteration, steps, tuned)
    tested = (COMMON, iteration.state)
    return {
        transition_key(located.path): values.evaluate_guard(located.decision.guard)
        for located in iter_decisions(design)
        if located.source in tested
    }


class GuardValues:
    """The values that guards read in one iteration."""

    def __init__(self, design: Design, scope: Scope, values: Mapping[str, Any], iteration: IterationResult) -> None:
        self.scope = scope
        self._is_xabsl = design.arithmetic == "xabsl"
        self._ns_per_unit = 1e6 if design.time_unit == "ms" else 1e9
        self._values = {name: value for name, value in values.items() if value is not None}
        self._passed_ns = iteration.step.get("state_time_ns")

    def evaluate(self, tree: Expr) -> Value | None:
        """The value of an expression, None if it reads what is not known."""
        return evaluate(tree, self._values, xabsl_arithmetic=self._is_xabsl)

    def read_by(self, tree: Expr) -> dict[str, Any]:
        """The names that an expression reads, with their values (None: unknown)."""
        return {name: self._values.get(name) for node in walk(tree) if (name := read_name(node))}

    def time_left_s(self, after: str) -> float | None:
        """How long the active state must last until a time has passed; at most 0 if it has, None if unknown."""
        return self._time_left_s(self._evaluate(after, FLOAT, {}))

    def evaluate_guard(self, guard: Guard) -> dict[str, Any]:
        parts: list[bool | None] = []
        reads: dict[str, Any] = {}
        if guard.after:
            left = self._time_left_s(self._evaluate(guard.after, FLOAT, reads))
            parts.append(None if left is None else left <= 0)
        if guard.when:
            value = self._evaluate(guard.when, BOOL, reads)
            parts.append(None if value is None else bool(value))
        if guard.code is not None:
            parts.append(None)
        holds = False if False in parts else None if None in parts else True
        return {"holds": holds, "parts": parts, "reads": reads}

    def _time_left_s(self, time: Value | None) -> float | None:
        if not isinstance(time, int | float) or not isinstance(self._passed_ns, int) or not math.isfinite(time):
            return None
        return (round(time * self._ns_per_unit) - self._passed_ns) / 1e9

    def _evaluate(self, text: str, type_: str, reads: dict[str, Any]) -> Value | None:
        parsed = parse_expression(text, self.scope, type_)
        if parsed.tree is None or parsed.diagnostics:
            return None
        reads |= self.read_by(parsed.tree)
        return self.evaluate(parsed.tree)


def format_value(value: Any) -> str:
    """A short text of a value of a running component."""
    if value is None:
        return "unknown"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return f"{value:.4g}"
    return str(value)[:60]


def _collect_values(design: Design, iteration: IterationResult, steps: Steps) -> dict[str, Any]:
    step = iteration.step
    values: dict[str, Any] = {name: _plain(value) for name, value in (step.get("values") or {}).items()}
    now = {str(each["component"]): each for each in iteration.tree}
    values.update((name, step[name]) for name in ("action_done", "conflict") if isinstance(step.get(name), bool))
    values["team_size"] = step.get("team_size", 1)
    if isinstance(step.get("state_time_ns"), int):
        values["state_time"] = step["state_time_ns"] / (1e6 if design.time_unit == "ms" else 1e9)
    for use in design.uses:
        known = iteration.inputs.get(use.component) or steps.get(use.component, {}).get("values") or {}
        for name, value in known.items():
            values[f"{use.alias}.{name}"] = _plain(value)
        if use.component in now:
            values[f"done({use.alias})"] = now[use.component].get("done") is True
        elif iteration.still_done is not None:
            values[f"done({use.alias})"] = use.component in iteration.still_done
    return values


def _plain(value: Any) -> Any:
    """A recorded value: "nan" is a number, and "Side.left" the element `left`; None for what no expression reads."""
    if isinstance(value, str):
        return _NUMBERS.get(value, value.rpartition(".")[2])
    return value if isinstance(value, bool | int | float) else None
