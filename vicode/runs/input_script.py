"""Inputs of a run as text: `order=true`, `2.5 s: Eyes.distance = 0.4`; one on each line of a file."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from vicode.model.design import Design
from vicode.runs.inputs import SimulationInput
from vicode.simulation import Inputs

_TIME = re.compile(r"\s*(?P<number>\d+(?:\.\d+)?|\.\d+)\s*(?P<unit>ms|s)?\s*:")
_FACTORS = {"ms": 10**6, "s": 10**9}
_BOOLS = {"true": True, "false": False}
_MOST_LISTED = 12


class InputTextError(ValueError):
    """A text that is not an input of the run; `column` counts from 1."""

    def __init__(self, message: str, column: int = 1) -> None:
        super().__init__(message)
        self.column = column


@dataclass(frozen=True, slots=True, kw_only=True)
class TimedInput:
    """A value of an input from a time on."""

    time_ns: int
    input: SimulationInput
    value: Any


def parse_input(text: str, inputs: Sequence[SimulationInput], design: Design) -> TimedInput:
    """Read `[TIME:] NAME = VALUE`; the time is in seconds unless "ms" follows it.

    NAME is `Component.output`, `alias.output`, the name of a parameter, or any output whose name is unique.

    Raises:
        InputTextError: It cannot be read, there is no such input, or the value does not suit it.
    """
    time_ns, start = 0, 0
    if found := _TIME.match(text):
        time_ns, start = _nanoseconds(found["number"], found["unit"] or "s"), found.end()
    name, equals, value = text[start:].partition("=")
    if not equals:
        raise InputTextError(f"'{text.strip()}' has no '='; write NAME=VALUE or 'TIME: NAME=VALUE'")
    input_ = _find_input(name.strip(), inputs, design, _column(text, start))
    column = _column(text, start + len(name) + 1)
    return TimedInput(time_ns=time_ns, input=input_, value=read_value(value.strip(), input_, column))


def parse_input_lines(text: str, inputs: Sequence[SimulationInput], design: Design) -> tuple[TimedInput, ...]:
    """Read the lines of a file; empty ones and those that start with "#" are left out.

    Raises:
        InputTextError: A line cannot be read; the message starts with its number and column.
    """
    found = []
    for number, line in enumerate(text.splitlines(), start=1):
        if line.strip() and not line.lstrip().startswith("#"):
            try:
                found.append(parse_input(line, inputs, design))
            except InputTextError as error:
                raise InputTextError(f"{number}:{error.column}: {error}", error.column) from error
    return tuple(found)


def read_value(text: str, input_: SimulationInput, column: int = 1) -> Any:
    """Read a value in the type of an input; its range does not limit it.

    Raises:
        InputTextError: It is no such value.
    """
    if input_.type == "bool":
        value: Any = _BOOLS.get(text)
        wanted = "true or false"
    elif input_.options:
        value = next((option for option in input_.options if text in (option, option.rpartition(".")[2])), None)
        wanted = ", ".join(option.rpartition(".")[2] for option in input_.options)
    else:
        value, wanted = input_.accept(_number(text)), "an integer" if input_.type == "int" else "a number"
        if input_.type == "int" and value is not None and value != _number(text):
            value = None
    if value is None:
        raise InputTextError(f"'{text}' is no value of {_name(input_)}: it must be {wanted}", column)
    return value


def format_input(timed: TimedInput) -> str | None:
    """The text that `parse_input` reads; None for a function with values for particular arguments."""
    value = timed.value
    if isinstance(value, dict):
        if value.get("table"):
            return None
        value = value.get("value")
    if isinstance(value, bool):
        value = str(value).lower()
    elif timed.input.options:
        value = str(value).rpartition(".")[2]
    start = f"{_seconds(timed.time_ns)} s: " if timed.time_ns else ""
    name = f"{timed.input.component}.{timed.input.name}" if timed.input.component else timed.input.name
    return f"{start}{name}={value}"


def make_script(timed: Iterable[TimedInput]) -> list[tuple[int, Inputs]]:
    """The inputs in the order of their times; of those with one time and one name, the last one counts."""
    script: list[tuple[int, Inputs]] = []
    for time_ns, group in groupby(sorted(timed, key=lambda each: each.time_ns), key=lambda each: each.time_ns):
        values: dict[str, dict[str, Any]] = {}
        for each in group:
            value = {"value": each.value, "table": []} if each.input.arguments is not None else each.value
            values.setdefault(each.input.component, {})[each.input.name] = value
        script.append((time_ns, values))
    return script


def _nanoseconds(number: str, unit: str) -> int:
    whole, _dot, part = number.partition(".")
    factor = _FACTORS[unit]
    return int(whole or "0") * factor + int(part or "0") * factor // int("1" + "0" * len(part))


def _seconds(time_ns: int) -> str:
    whole, part = divmod(time_ns, 10**9)
    return f"{whole}.{part:09}".rstrip("0").rstrip(".")


def _find_input(name: str, inputs: Sequence[SimulationInput], design: Design, column: int) -> SimulationInput:
    owner, _dot, output = name.rpartition(".")
    components = {use.alias: use.component for use in design.uses}
    exact = [each for each in inputs if each.name == output and each.component in (owner, components.get(owner))]
    found = exact or [each for each in inputs if not owner and each.name == output]
    if len(found) == 1:
        return found[0]
    names = [_name(each) for each in found or inputs]
    listed = ", ".join(names[:_MOST_LISTED]) + (", …" if len(names) > _MOST_LISTED else "")
    if found:
        raise InputTextError(f"'{name}' may be {listed}; write one of them", column)
    raise InputTextError(f"there is no input '{name}'" + (f"; there are {listed}" if listed else ""), column)


def _name(input_: SimulationInput) -> str:
    return f"{input_.component}.{input_.name}" if input_.component else input_.name


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _column(text: str, index: int) -> int:
    """The column of the first character from an index on that is no space."""
    return index + len(text[index:]) - len(text[index:].lstrip()) + 1
