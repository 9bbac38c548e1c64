"""The types of schemas of which the format consists."""

from collections.abc import Callable, Mapping
from dataclasses import KW_ONLY, dataclass, field
from enum import StrEnum
from typing import Any

FormatValue = str | float | bool | tuple["FormatValue", ...]
"""A value in full notation; a mapping is a tuple of pairs (name, value)."""


class ScalarType(StrEnum):
    """The type of a scalar."""

    TEXT = "text"
    NAME = "name"
    EXPRESSION = "expression"
    NUMBER = "number greater than 0"
    COUNT = "integer, 0 or greater"
    BOOLEAN = "true or false"
    TRUE = "true"
    VERSION = "version"


@dataclass(frozen=True, slots=True, kw_only=True)
class ScalarSchema:
    """A scalar; if `choices` is not empty, it must be one of them."""

    scalar_type: ScalarType
    choices: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class PairSchema:
    """Two finite numbers."""

    description: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ListSchema:
    """A list.

    Attributes:
        item_schema: Function that returns the schema of the items, so that lists can be recursive.
        single_item_key: A key of the items. A value that is not a list is the value of this key of a single item.
        flow_width: Maximum line length for flow style, 0 for block style.
    """

    description: str
    item_schema: "Callable[[], ValueSchema]"
    single_item_key: str = ""
    flow_width: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class MapSchema:
    """A mapping with names as keys.

    Attributes:
        allows_name_list: Whether a list of names is a mapping of these names to empty values.
        shorthand_key: A scalar is the value of this key.
        allowed_keys: The valid names; empty if all names are valid.
        flow_width: Maximum line length for flow style, 0 for block style.
        name_field: Field of the model that holds the name; empty if the model holds pairs of names and values.
        entry_model: Class of the entries, unless the values are records.
        value_field: Field of `entry_model` that holds the value.
        wrapper: Class that holds the pairs as its `texts`.
    """

    description: str
    value_schema: "ValueSchema"
    allows_name_list: bool = False
    shorthand_key: str = ""
    allowed_keys: tuple[str, ...] = ()
    flow_width: int = 0
    name_field: str = ""
    entry_model: Callable[..., Any] | None = None
    value_field: str = ""
    wrapper: Callable[..., Any] | None = None


@dataclass(frozen=True, slots=True)
class KeySchema:
    """A key of a record.

    Attributes:
        default: The value of a missing key.
        keeps_empty: Whether an empty value differs from a missing key.
        shorthand_for: The key of which this one is the single-item form.
        field: Field of the model, if its name differs from that of the key; "guard.when" is a field of a nested class.
        constant: The only value of the key; the model has no field for it.
    """

    name: str
    schema: "ValueSchema"
    description: str
    _: KW_ONLY
    required: bool = False
    default: FormatValue = ()
    keeps_empty: bool = False
    shorthand_for: str = ""
    field: str = ""
    constant: FormatValue | None = None

    @property
    def model_field(self) -> str:
        return self.field or self.name


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordSchema:
    """A mapping with a fixed set of keys.

    Attributes:
        shorthand_key: A value that is not a mapping is the value of this key. If the value of this key is a mapping
            itself, this also applies to mappings without this key.
        shorthand_words: Scalars that are the value of another key than `shorthand_key`.
        model: Class of the model, if there are no variants.
        variants: Class of the model by the key that selects it; exactly one of these keys must be given.
        nested: Classes by the fields of the model that hold them.
        missing_message: Message and fix if none of the `variants` is given.
        dependent_keys: Keys, each followed by the keys of which it requires one.
        synonyms: Terms of other tools and the corresponding key.
        flow_width: Maximum line length for flow style, 0 for block style.
    """

    name: str
    description: str
    keys: tuple[KeySchema, ...]
    model: type | None = None
    variants: Mapping[str, type] = field(default_factory=dict)
    nested: Mapping[str, type] = field(default_factory=dict)
    shorthand_key: str = ""
    shorthand_words: Mapping[str, str] = field(default_factory=dict)
    missing_message: tuple[str, str] = ("", "")
    dependent_keys: tuple[tuple[str, ...], ...] = ()
    synonyms: Mapping[str, str] = field(default_factory=dict)
    flow_width: int = 0

    @property
    def one_of(self) -> tuple[str, ...]:
        return tuple(self.variants)

    def find_key(self, name: str) -> KeySchema | None:
        return next((key for key in self.keys if key.name == name), None)

    def find_shorthand(self, text: str) -> KeySchema | None:
        """Return the key whose value a scalar is; None if the record has no short form."""
        return self.find_key(self.shorthand_words.get(text, self.shorthand_key))


ValueSchema = ScalarSchema | PairSchema | ListSchema | MapSchema | RecordSchema


def build_record_value(record: RecordSchema, values: Mapping[str, FormatValue | None]) -> tuple[FormatValue, ...]:
    """Build the value of a record: pairs in the order of the schema, without default values."""
    pairs: list[FormatValue] = []
    for key in record.keys:
        value = values.get(key.name)
        is_given = value is not None and (value != key.default or value == ()) and not key.shorthand_for
        if is_given and value is not None and (key.keeps_empty or value not in ("", (), False)):
            pairs.append((key.name, value))
    return tuple(pairs)
