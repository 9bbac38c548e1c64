"""YAML nodes after they were read against the schema of the format."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType

from vicode.store.schema_types import FormatValue, ValueSchema
from vicode.store.yaml_tree import YamlNode


class YamlNotation(StrEnum):
    """How a value is written in the file."""

    FULL = "in full"
    SHORTHAND = "the value of one key instead of a mapping"
    NAME_LIST = "a list of names instead of a mapping"
    SINGLE_ITEM = "the key value of a single item instead of a list"


@dataclass(frozen=True, slots=True, kw_only=True)
class TypedNode:
    """A YAML node with its schema and value.

    Attributes:
        value: None if the node is invalid.
        key_node: The key of the node in its parent mapping.
        children: The child nodes by path step (name or index).
        child_keys: For each member of the YAML node, in file order, its key in `children`; None for invalid members.
    """

    schema: ValueSchema
    node: YamlNode
    value: FormatValue | None
    key_node: YamlNode | None = None
    notation: YamlNotation = YamlNotation.FULL
    children: "TypedChildren" = field(default_factory=lambda: _NO_CHILDREN)
    child_keys: tuple[str | int | None, ...] = ()


TypedChildren = Mapping[str | int, TypedNode]
_NO_CHILDREN: TypedChildren = MappingProxyType({})
