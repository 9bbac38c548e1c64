"""The kinds of shape a value in a file may have; the format is one table of them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum

Data = str | float | bool | tuple["Data", ...]
"""A value as the format means it, short forms written out: pairs of a mapping are tuples (name, value)."""


class Kind(StrEnum):
    """What a single text stands for."""

    TEXT = "text"
    NAME = "name"
    EXPRESSION = "expression"
    NUMBER = "number greater than 0"
    COUNT = "whole number from 0 up"
    FLAG = "true or false"
    TRUE = "true"
    VERSION = "version"


@dataclass(frozen=True, slots=True, kw_only=True)
class Leaf:
    """A single text; one of `choices` where there are some."""

    kind: Kind
    choices: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Pair:
    """Two finite numbers."""

    what: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Listing:
    """A list of items.

    `lone` is a key of its items: a value that is no list stands for a list of one item with only this key.
    """

    what: str
    item: "Callable[[], Shape]"
    lone: str = ""
    width: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """A mapping from names that the user chooses to values.

    `names`: a list of names stands for a mapping with empty values. `short`: a text stands for a mapping with only
    this key. `keys`: the only names there are.
    """

    what: str
    value: "Shape"
    names: bool = False
    short: str = ""
    keys: tuple[str, ...] = ()
    width: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Key:
    """A key of a record.

    `implied` is the value that a missing key means; `keeps_empty`: an empty value differs from a missing key.
    `stands_for`: this key is the lone form of that one.
    """

    name: str
    shape: "Shape"
    meaning: str
    required: bool = False
    implied: Data = ()
    keeps_empty: bool = False
    stands_for: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """A mapping with known keys.

    `short`: a value that is no mapping (for a table: no mapping with this key) stands for only this key.
    `one_of`: exactly one of these must be given; `missing` says so. `needs`: a key and the one it goes with.
    `meant`: words of other tools and the key they mean here. `width`: written in braces up to this line length.
    """

    name: str
    what: str
    keys: tuple[Key, ...]
    short: str = ""
    one_of: tuple[str, ...] = ()
    missing: tuple[str, str] = ("", "")
    needs: tuple[tuple[str, str], ...] = ()
    meant: Mapping[str, str] = field(default_factory=dict)
    width: int = 0
    is_item: bool = False

    def key(self, name: str) -> Key | None:
        """The key of this name."""
        return next((key for key in self.keys if key.name == name), None)


Shape = Leaf | Pair | Listing | Table | Record


def gather(record: Record, values: Mapping[str, Data | None]) -> tuple[Data, ...]:
    """A record's value: pairs in the order of its table, without what a missing key means anyway."""
    pairs: list[Data] = []
    for key in record.keys:
        value = values.get(key.name)
        is_said = value is not None and (value != key.implied or value == ()) and not key.stands_for
        if is_said and value is not None and (key.keeps_empty or value not in ("", (), False)):
            pairs.append((key.name, value))
    return tuple(pairs)
