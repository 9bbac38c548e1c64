"""Traces of all languages in one form, and their first difference.

Values are written as texts by their declared types, so that 1 and 1.0 of an int are equal, and nan equals nan. Where a
language differs by its nature, an entry of `EXPECTED_DIFFERENCES` removes that part from both traces; anything else
that differs is an error of somebody. Only the first difference is reported, as the later ones follow from it.
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest
from typing import Any

from vicode.model.expressions import build_scope
from vicode.model.project import INTERNAL, Project

Fields = Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceStep:
    """One step of a component; `fields` are texts by name, such as "state", "parameters.speed" and "values.count"."""

    component: str
    fields: Fields


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceIteration:
    """One iteration of a robot.

    Attributes:
        shared: The shared variables before the iteration, by "component.name".
        errors: The components that raised an exception.
        had_large_ints: Whether an int was beyond ±2^53 until now; only the reference interpreter tells.
    """

    number: int
    time_ns: int
    steps: tuple[TraceStep, ...]
    shared: Fields
    errors: tuple[str, ...] = ()
    robot: int = 0
    had_large_ints: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceDifference:
    """The first difference: `index` of the iteration, component, field, and both values; "" for none."""

    index: int
    component: str
    field: str
    values: tuple[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class LanguageLimit:
    """A part of traces in which a language differs by its nature."""

    language: str
    part: str
    reason: str


LAST_BIT = LanguageLimit(
    language="javascript",
    part="last bit",
    reason="the last bit of exp, log and trigonometric functions differs from that of libm",
)

EXPECTED_DIFFERENCES = (
    LanguageLimit(
        language="xabsl", part="requires", reason="symbols are read when they are needed; components are only called"
    ),
    LanguageLimit(language="xabsl", part="errors", reason="no expression of XABSL raises an error"),
    LanguageLimit(language="xabsl", part="worked", reason="options have no frequency and always work"),
    LanguageLimit(language="xabsl", part="transition", reason="decisions of XABSL have no ids"),
    LanguageLimit(
        language="xabsl",
        part="-0.0",
        reason="the engine has no unary minus, so that -x is 0 - x; no expression of XABSL tells 0.0 from -0.0",
    ),
    LanguageLimit(language="xabsl", part="done", reason="the engine computes it only for guards"),
    LanguageLimit(
        language="xabsl",
        part="values",
        reason="the engine has one memory: a component's values are those at the end of the iteration",
    ),
    LanguageLimit(
        language="xabsl",
        part="large ints",
        reason="numbers are doubles: beyond ±2^53 an int is the nearest double, and is not limited",
    ),
    LAST_BIT,
    LanguageLimit(language="simulator", part="transition", reason="the editor uses the places of transitions as ids"),
)
"""What is not compared, and why."""


class TraceNormalizer:
    """Converts records of traces: values are written by their declared types."""

    def __init__(self, project: Project) -> None:
        scope = build_scope(project, None)
        self._designs = {
            design.component: {each.name for each in (*design.outputs, *design.variables)} for design in project.designs
        }
        self._shared = {each.component for each in project.components if each.implementation == INTERNAL}
        self.types: dict[tuple[str, str], str] = {}
        for interface in project.interfaces().values():
            for each in (*interface.parameters, *interface.readable):
                self.types[interface.component, each.name] = scope.type_of(each)
        for design in project.designs:
            for each in (*design.parameters, *design.outputs, *design.variables):
                self.types[design.component, each.name] = scope.type_of(each)

    def iteration(self, record: Mapping[str, Any], robot: int = 0) -> TraceIteration:
        """Convert a line of a trace."""
        inputs = record.get("inputs") or {}
        return TraceIteration(
            number=record["iteration"],
            time_ns=record["time_ns"],
            steps=tuple(self._step(step) for step in record["tree"]),
            shared={
                f"{name}.{key}": self._text(name, key, value)
                for name, values in inputs.items()
                if name in self._shared
                for key, value in values.items()
            },
            errors=tuple(each["component"] for each in record.get("errors") or ()),
            robot=robot,
        )

    def _step(self, step: Mapping[str, Any]) -> TraceStep:
        component = step["component"]
        fields = {
            "by": step["by"] or "",
            "link": step["link"],
            "worked": _bool_text(step["worked"]),
        }
        if component in self._designs:
            fields |= {
                "state": step["state"],
                "state_time": _ms_text(step["state_time_ns"]),
                "component_time": _ms_text(step["component_time_ns"]),
                "changed_from": step["changed_from"] or "",
                "transition": step["transition"] or "",
                "done": _bool_text(step["done"]),
            }
        own = self._designs.get(component, set())
        values = {name: value for name, value in (step.get("values") or {}).items() if name in own}
        for section, plain in (("parameters", step["parameters"]), ("values", values)):
            fields |= {f"{section}.{name}": self._text(component, name, value) for name, value in plain.items()}
        return TraceStep(component=component, fields=fields)

    def _text(self, component: str, name: str, value: Any) -> str:
        match self.types.get((component, name), ""):
            case "bool":
                return _bool_text(bool(value))
            case "int":
                number = float(value)
                return str(int(number)) if math.isfinite(number) and number == int(number) else repr(number)
            case "float":
                return repr(float(value))
            case _:
                return str(value)


def reduce_for(language: str, iterations: Iterable[TraceIteration]) -> list[TraceIteration]:
    """Remove what a language does not tell (EXPECTED_DIFFERENCES), so that its trace can be compared."""
    parts = {limit.part for limit in EXPECTED_DIFFERENCES if limit.language == language}
    return [_reduced(iteration, parts) for iteration in iterations]


def _reduced(iteration: TraceIteration, parts: set[str]) -> TraceIteration:
    has_zero = "-0.0" in parts
    steps = [step for step in iteration.steps if not ("requires" in parts and step.fields["link"] == "requires")]

    def without_sign(fields: Fields) -> Fields:
        return {name: "0.0" if value == "-0.0" else value for name, value in fields.items()} if has_zero else fields

    last = {step.component: index for index, step in enumerate(steps)}
    kept = []
    for index, step in enumerate(steps):
        fields = {
            name: value
            for name, value in without_sign(step.fields).items()
            if name not in parts
            and not ("values" in parts and name.startswith("values.") and last[step.component] != index)
        }
        kept.append(replace(step, fields=fields))
    errors = () if "errors" in parts else iteration.errors
    return replace(iteration, steps=tuple(kept), shared=without_sign(iteration.shared), errors=errors)


def large_ints_limit(language: str, expected: Sequence[TraceIteration], found: TraceDifference) -> LanguageLimit | None:
    """Return the limit of a language that explains a difference: an int was beyond ±2^53 before."""
    had_large_ints = any(iteration.had_large_ints for iteration in expected[: found.index + 1])
    limits = (each for each in EXPECTED_DIFFERENCES if (each.language, each.part) == (language, "large ints"))
    return next(limits, None) if had_large_ints else None


def first_difference(expected: Sequence[TraceIteration], got: Sequence[TraceIteration]) -> TraceDifference | None:
    """Compare two traces; a trace that ends early differs there."""
    for index, (left, right) in enumerate(zip(expected, got, strict=False)):
        found = _compare(index, left, right)
        if found is not None:
            return found
    if len(expected) != len(got):
        counts = (f"{len(expected)} iterations", f"{len(got)} iterations")
        return TraceDifference(index=min(len(expected), len(got)), component="", field="length", values=counts)
    return None


def _compare(index: int, left: TraceIteration, right: TraceIteration) -> TraceDifference | None:
    for component, field, one, other in _facts(left, right):
        if one != other:
            return TraceDifference(index=index, component=component, field=field, values=(one, other))
    return None


def _facts(left: TraceIteration, right: TraceIteration) -> Iterator[tuple[str, str, str, str]]:
    """Component, field and both values of everything that is compared, in order."""
    yield "", "time", str(left.time_ns), str(right.time_ns)
    yield "", "errors", ", ".join(left.errors), ", ".join(right.errors)
    for name in sorted({*left.shared, *right.shared}):
        yield "", name, left.shared.get(name, ""), right.shared.get(name, "")
    for one, other in zip_longest(left.steps, right.steps):
        names = one.component if one else "", other.component if other else ""
        yield names[0] or names[1], "component", *names
        if one and other:
            for field in dict.fromkeys((*one.fields, *other.fields)):
                yield one.component, field, one.fields.get(field, ""), other.fields.get(field, "")


def _bool_text(value: object) -> str:
    return "true" if value else "false"


def _ms_text(ns: int) -> str:
    return f"{ns / 1e6:.6f}".rstrip("0").rstrip(".")
