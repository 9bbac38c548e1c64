"""Typed parameters of sensors and events: what a line carries becomes a value, or an error that names the parameter."""

import math
from collections import namedtuple
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from vicode.bridge.frames import FrameError, split_parameters

Raw = bytes | list[Any]
"""Parameters as they were received: the text of a JXI line, or a list of JSON values."""

_WORDS = {"true": True, "1": True, "false": False, "0": False}
_NUMBER_TYPES = {float, int, bytes}
_NAMES = {float: "a number", int: "an integer", bool: "true or false", str: "a text"}


@dataclass(slots=True, kw_only=True)
class ParameterTypes:
    """The parameters of a target: how many, of which type.

    Args:
        value_type: float, int, bool or str; None until the project tells it, which counts as float.
        least, most: Numbers of parameters.
        fields: Names of the parameters; the value is then a named tuple.
        is_list: Whether the value is a tuple; otherwise, it is that of the only parameter.
        bounds: Least and greatest number; a value outside is an error.
        elements: The possible texts.
    """

    value_type: type[Any] | None
    least: int = 1
    most: int = 1
    fields: tuple[str, ...] = ()
    is_list: bool = False
    bounds: tuple[float, float] | None = None
    elements: tuple[str, ...] = ()
    _record: Any = field(default=None, init=False)

    def __post_init__(self) -> None:
        if self.fields:
            make_class: Any = namedtuple
            record = make_class("Reading", self.fields)
            self._record = record._make

    def default(self) -> Any:
        """The value before the first line."""
        value_type = self.value_type or float
        value = self.elements[0] if self.elements else value_type()
        return self.shape([value] * self.least)

    def convert(self, raw: Raw) -> Any:
        """Return the value of the parameters.

        Raises:
            FrameError: They are not what is declared.
        """
        return self.shape(self.parse(raw))

    def parse(self, raw: Raw) -> list[Any]:
        """Return the parameters, each converted.

        Raises:
            FrameError: They are not what is declared.
        """
        values = self._convert_floats(raw) if self.value_type in (None, float) else None
        if values is None:
            values = self._convert_each(split_parameters(raw) if isinstance(raw, bytes) else raw)
        self._check(values)
        return values

    def _convert_floats(self, raw: Raw) -> list[Any] | None:
        """The usual case, and the fast one; None if something is no number."""
        given: Sequence[Any] = raw.split(b",") if isinstance(raw, bytes) else raw
        if not set(map(type, given)) <= _NUMBER_TYPES or (isinstance(raw, bytes) and b"_" in raw):
            return None
        try:
            # float() also reads bytes with spaces around.
            return list(map(float, given))
        except (ValueError, OverflowError):
            return None

    def _convert_each(self, given: Sequence[Any]) -> list[Any]:
        value_type, values = self.value_type or float, []
        for number, each in enumerate(given, 1):
            value = _convert(each, value_type)
            if value is None:
                raise FrameError(f"{self._name(number)} is {_show(each)}, expected {_NAMES[value_type]}")
            values.append(value)
        return values

    def _check(self, values: list[Any]) -> None:
        if not self.least <= len(values) <= self.most:
            number = str(self.least) if self.least == self.most else f"{self.least} to {self.most}"
            raise FrameError(f"found {len(values)} parameters, expected {number}")
        if self.elements:
            wrong = next((each for each in values if each not in self.elements), None)
            if wrong is not None:
                raise FrameError(f"found {_show(wrong)}, expected {' or '.join(self.elements)}")
        elif self.value_type in (None, float, int):
            self._check_numbers(values)

    def _check_numbers(self, values: list[float]) -> None:
        low, high = self.bounds or (-math.inf, math.inf)
        if not values or (all(map(math.isfinite, values)) and low <= min(values) and max(values) <= high):
            return
        index = next(index for index, each in enumerate(values) if not (math.isfinite(each) and low <= each <= high))
        expected = f"{low:g} to {high:g}" if self.bounds else "a finite number"
        raise FrameError(f"{self._name(index + 1)} is {values[index]:g}, expected {expected}")

    def shape(self, values: Sequence[Any]) -> Any:
        """Return parameters as the value that the world reads: a named tuple, a tuple, or the only one."""
        if self._record is not None:
            return self._record(values)
        return tuple(values) if self.is_list else values[0] if values else None

    def _name(self, number: int) -> str:
        return self.fields[number - 1] if number <= len(self.fields) else f"parameter {number}"


def _convert(value: Any, value_type: type[Any]) -> Any:
    """The value as this type, None if it has another one."""
    if value_type is str:
        return value if isinstance(value, str) else None
    if value_type is bool:
        if isinstance(value, bool):
            return value
        return _WORDS.get(str(value).lower())
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        return None
    if isinstance(value, str) and ("_" in value or not value.isascii()):
        # float() reads 1_000, and digits of all scripts.
        return None
    try:
        number = float(value)
        if value_type is float:
            return number
        return int(number) if number.is_integer() else None
    except (ValueError, OverflowError):
        return None


def _show(value: Any) -> str:
    text = ascii(value)
    return text if len(text) <= 40 else f"{text[:40]} …"
