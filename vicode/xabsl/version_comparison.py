"""Runs two versions of a behavior on the same inputs and finds the first cycle in which they differ."""

import random
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import Any

from vicode.xabsl.compiler import CompileResult, declared_symbols
from vicode.xabsl.engine.replay import ReplayError, ReplayRobot
from vicode.xabsl.engine.symbols import RobotSymbol
from vicode.xabsl.source_loader import ProgramSource
from vicode.xabsl.tokens import NUMBER

Row = dict[str, str]
_CONTROLS = ("time", "agent", "reset")
_NUMBERS = (0.0, 1.0, -1.0, 0.5, 2.0, -3.0, 300.0)
_TIMES_MS = (1, 10, 20, 20, 20, 50, 100, 1000)
_MAX_NUMBER = 1e4
_FIELDS = ("state", "parameters", "values", "changed_from", "done", "state_time_ns", "component_time_ns")
"""What is compared of an active option or basic behavior, the most telling first."""


@dataclass(frozen=True, slots=True)
class BehaviorVersion:
    """A compiled behavior with its sources."""

    source: ProgramSource
    compiled: CompileResult

    @property
    def agents(self) -> list[str]:
        return list(self.compiled.table.agents)

    @property
    def state_count(self) -> int:
        return sum(len(option.states) for option in self.compiled.table.options.values())

    @property
    def inputs(self) -> dict[str, RobotSymbol]:
        symbols = declared_symbols(self.compiled.table).symbols
        return {symbol.name: symbol for symbol in symbols if symbol.role == "input"}

    def robot(self) -> ReplayRobot:
        """An engine of its own.

        Raises:
            LoadError: The program is incomplete.
        """
        assert self.compiled.program is not None
        return ReplayRobot(self.compiled.program, declared_symbols(self.compiled.table))


@dataclass(frozen=True, slots=True, kw_only=True)
class VersionDifference:
    """The first difference of two versions.

    Attributes:
        component: The option or basic behavior that differs; "" for the agent or the messages of the engine.
        field: What differs: "active", "state", "parameters.speed", "values.turn" …
        values: Both values, "" for none.
        records: The records of this cycle.
        inputs: The values of all inputs in this cycle that were ever set.
        changed: The inputs that were set in this cycle.
    """

    cycle: int
    time_ms: int
    component: str
    field: str
    values: tuple[str, str]
    records: tuple[Mapping[str, Any], Mapping[str, Any]]
    inputs: Mapping[str, str]
    changed: frozenset[str]


def compare_versions(
    old: BehaviorVersion, new: BehaviorVersion, rows: Iterable[Row], visited: set[tuple[str, str]]
) -> VersionDifference | None:
    """Run both versions; an input that only one of them has is set only there.

    Args:
        old: A version.
        new: The version to compare with it.
        rows: The inputs, one row per cycle.
        visited: The options and states that were active are added to it.

    Raises:
        LoadError: A program is incomplete.
        ReplayError: A column is an input of neither version, or a value is invalid.
    """
    robots = old.robot(), new.robot()
    known = old.inputs.keys(), new.inputs.keys()
    inputs: Row = {}
    for cycle, row in enumerate(rows, start=1):
        changed = {name: value for name, value in row.items() if value and name not in _CONTROLS}
        unknown = next((name for name in row if name not in _CONTROLS and not any(name in each for each in known)), "")
        if unknown:
            raise ReplayError(f"no input symbol {unknown} in either version")
        inputs |= changed
        records = []
        for robot, names in zip(robots, known, strict=True):
            robot.apply_row({name: value for name, value in row.items() if name in _CONTROLS or name in names})
            robot.engine.execute()
            records.append(robot.trace_record(cycle))
        visited |= {(step["component"], step["state"]) for step in records[0]["tree"] if step["state"]}
        found = next(_differences(*records), None)
        if found is not None:
            return VersionDifference(
                cycle=cycle,
                time_ms=robots[0].now,
                component=found[0],
                field=found[1],
                values=found[2],
                records=(records[0], records[1]),
                inputs=dict(inputs),
                changed=frozenset(changed),
            )
    return None


def _differences(old: dict[str, Any], new: dict[str, Any]) -> Iterator[tuple[str, str, tuple[str, str]]]:
    if old["agent"] != new["agent"]:
        yield "", "agent", (str(old["agent"]), str(new["agent"]))
    for one, other in zip_longest(old["tree"], new["tree"]):
        names = tuple(f"{step['by'] or ''} {step['component']}".strip() if step else "" for step in (one, other))
        if names[0] != names[1]:
            component = (one or other)["component"]
            yield component, "active", (names[0].rpartition(" ")[2], names[1].rpartition(" ")[2])
        else:
            yield from ((one["component"], field, values) for field, values in _step_differences(one, other))
    messages = tuple("; ".join(error["message"] for error in each["errors"]) for each in (old, new))
    if messages[0] != messages[1]:
        yield "", "errors", (messages[0], messages[1])


def _step_differences(one: dict[str, Any], other: dict[str, Any]) -> Iterator[tuple[str, tuple[str, str]]]:
    for field in _FIELDS:
        left, right = one.get(field), other.get(field)
        if left == right:
            continue
        if isinstance(left, dict) and isinstance(right, dict):
            for name in dict.fromkeys((*left, *right)):
                if left.get(name) != right.get(name):
                    yield f"{field}.{name}", (_text(left.get(name)), _text(right.get(name)))
        else:
            yield field, (_text(left), _text(right))


def _text(value: object) -> str:
    return "" if value is None else str(value).lower() if isinstance(value, bool) else str(value)


def random_rows(versions: Sequence[BehaviorVersion], agent: str, *, cycles: int, seed: int) -> Iterator[Row]:
    """Random inputs of all versions, at and around the numbers in their files; the same seed gives the same rows."""
    chance, time_ms = random.Random(f"{seed} {agent}"), 0
    inputs = {name: symbol for version in versions for name, symbol in version.inputs.items()}
    numbers = sorted({*_NUMBERS, *(number for version in versions for number in _written_numbers(version.source))})
    counts = {
        name: len(elements)
        for version in versions
        for symbols in [declared_symbols(version.compiled.table)]
        for name, elements in (*symbols.enums, *symbols.internal_enums)
    }
    for cycle in range(cycles):
        names = [name for name in inputs if cycle == 0 or chance.random() < 0.3]
        row = {name: _draw(chance, inputs[name], numbers, counts) for name in names}
        yield {"time": str(time_ms), **({"agent": agent} if cycle == 0 else {}), **row}
        time_ms += chance.choice(_TIMES_MS)


def _draw(chance: random.Random, symbol: RobotSymbol, numbers: Sequence[float], counts: Mapping[str, int]) -> str:
    if symbol.kind == "b":
        return chance.choice("01")
    if symbol.kind == "e":
        return str(chance.randrange(max(1, counts.get(symbol.enum, 1))))
    if chance.random() < 0.3:
        return repr(chance.uniform(-_MAX_NUMBER, _MAX_NUMBER))
    return repr(chance.choice((1, -1)) * chance.choice(numbers) + chance.choice((0.0, 0.0, 0.01, -0.01, 1.0, -1.0)))


def _written_numbers(source: ProgramSource) -> Iterator[float]:
    for parsed in source.files.values():
        for kind, text in zip(parsed.tokens.kinds, parsed.tokens.texts, strict=True):
            if kind == NUMBER:
                yield float(text)
