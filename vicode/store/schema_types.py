"""The kinds of shape a value in a file may have; the format is one table of them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum

FormatValue = str | float | bool | tuple["FormatValue", ...]
"""A value as the format means it, short forms written out: pairs of a mapping are tuples (name, value)."""


class ScalarType(StrEnum):
    """What a single text stands for."""

    TEXT = "text"
    NAME = "name"
    EXPRESSION = "expression"
    NUMBER = "number greater than 0"
    COUNT = "whole number from 0 up"
    BOOLEAN = "true or false"
    TRUE = "true"
    VERSION = "version"


@dataclass(frozen=True, slots=True, kw_only=True)
class ScalarSchema:
    """A single text; one of `choices` where there are some."""

    scalar_type: ScalarType
    choices: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class PairSchema:
    """Two finite numbers."""

    description: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ListSchema:
    """A list of items.

    `single_item_key` is a key of its items: a value that is no list stands for a list of one item with only this key.
    """

    description: str
    item_schema: "Callable[[], ValueSchema]"
    single_item_key: str = ""
    flow_width: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class MapSchema:
    """A mapping from names that the user chooses to values.

    `allows_name_list`: a list of names stands for a mapping with empty values. `shorthand_key`: a text stands for a mapping with only
    this key. `allowed_keys`: the only names there are.
    """

    description: str
    value_schema: "ValueSchema"
    allows_name_list: bool = False
    shorthand_key: str = ""
    allowed_keys: tuple[str, ...] = ()
    flow_width: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class KeySchema:
    """A key of a record.

    `default` is the value that a missing key means; `keeps_empty`: an empty value differs from a missing key.
    `shorthand_for`: this key is the lone form of that one.
    """

    name: str
    schema: "ValueSchema"
    description: str
    required: bool = False
    default: FormatValue = ()
    keeps_empty: bool = False
    shorthand_for: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordSchema:
    """A mapping with known keys.

    `shorthand_key`: a value that is no mapping (for a table: no mapping with this key) stands for only this key.
    `one_of`: exactly one of these must be given; `missing_message` says so. `dependent_keys`: a key and the one it goes with.
    `synonyms`: words of other tools and the key they mean here. `flow_width`: written in braces up to this line length.
    """

    name: str
    description: str
    keys: tuple[KeySchema, ...]
    shorthand_key: str = ""
    one_of: tuple[str, ...] = ()
    missing_message: tuple[str, str] = ("", "")
    dependent_keys: tuple[tuple[str, str], ...] = ()
    synonyms: Mapping[str, str] = field(default_factory=dict)
    flow_width: int = 0
    is_item: bool = False

    def find_key(self, name: str) -> KeySchema | None:
        """The key of this name."""
        return next((key for key in self.keys if key.name == name), None)


ValueSchema = ScalarSchema | PairSchema | ListSchema | MapSchema | RecordSchema


def build_record_value(record: RecordSchema, values: Mapping[str, FormatValue | None]) -> tuple[FormatValue, ...]:
    """A record's value: pairs in the order of its table, without what a missing key means anyway."""
    pairs: list[FormatValue] = []
    for key in record.keys:
        value = values.get(key.name)
        is_said = value is not None and (value != key.default or value == ()) and not key.shorthand_for
        if is_said and value is not None and (key.keeps_empty or value not in ("", (), False)):
            pairs.append((key.name, value))
    return tuple(pairs)
