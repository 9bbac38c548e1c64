"""Reads nodes as the shapes of the format say, with every mistake at its place; what can be kept is kept."""

import math
import re
from collections.abc import Mapping as MappingOf
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType

from vicode.findings import DesignPath, did_you_mean
from vicode.store.format import VERSION
from vicode.store.line_index import ReadReport
from vicode.store.schema_types import (
    FormatValue,
    KeySchema,
    ListSchema,
    MapSchema,
    PairSchema,
    RecordSchema,
    ScalarSchema,
    ScalarType,
    ValueSchema,
    build_record_value,
)
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar, YamlSequence

_NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?\Z", re.ASCII)
_NULLS = ("", "~", "null", "Null", "NULL")
_BOOLEANS = {"true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}


class YamlNotation(StrEnum):
    """How a value was written."""

    FULL = "as the format has it"
    SHORTHAND = "one key's value instead of a mapping"
    NAME_LIST = "a list of names instead of a mapping"
    SINGLE_ITEM = "one item's key instead of a list"


@dataclass(frozen=True, slots=True, kw_only=True)
class TypedNode:
    """A node as it was understood.

    `value` is None when nothing could be made of it. `children` are what it holds, by the words of paths. `child_keys` are
    the keys of `children` in the order of the node's own members, None for a member that was not understood.
    """

    schema: ValueSchema
    node: YamlNode
    value: FormatValue | None
    key_node: YamlNode | None = None
    notation: YamlNotation = YamlNotation.FULL
    children: "TypedChildren" = field(default_factory=lambda: _NO_CHILDREN)
    child_keys: tuple[str | int | None, ...] = ()


TypedChildren = MappingOf[str | int, TypedNode]
_NO_CHILDREN: TypedChildren = MappingProxyType({})


class SchemaReader:
    """Reads the nodes of one file."""

    def __init__(self, report: ReadReport) -> None:
        """Mistakes go to `report`."""
        self.report = report

    def read(self, node: YamlNode, shape: ValueSchema, path: DesignPath = (), key: YamlNode | None = None) -> TypedNode:
        """Read a node as a shape; `path` leads to it, `key` is the key it stands under."""
        if isinstance(node, YamlScalar) and node.is_rejected:
            return TypedNode(schema=shape, node=node, value=None, key_node=key)
        match shape:
            case ScalarSchema():
                return TypedNode(schema=shape, node=node, value=self._read_scalar(node, shape, path), key_node=key)
            case PairSchema():
                return TypedNode(schema=shape, node=node, value=self._read_pair(node, shape, path), key_node=key)
            case ListSchema():
                return self._read_list(node, shape, path, key)
            case MapSchema():
                return self._read_map(node, shape, path, key)
            case RecordSchema():
                return self._read_record(node, shape, path, key)

    def _report_invalid(self, node: YamlNode, message: str, path: DesignPath, mend: str = "") -> None:
        self.report.add("Y103", message, _span(node), fix=mend, path=path)

    def _read_scalar(self, node: YamlNode, shape: ScalarSchema, path: DesignPath) -> FormatValue | None:
        if not isinstance(node, YamlScalar):
            mend = "put a text that begins with a bracket in quotes" if node.is_flow else ""
            self._report_invalid(
                node, f"expected {_describe_expected(shape)}, but this is {_describe_node(node)}", path, mend
            )
            return None
        match shape.scalar_type:
            case ScalarType.TEXT:
                return node.text
            case ScalarType.NAME | ScalarType.EXPRESSION:
                return self._read_name_or_expression(node, shape, path)
            case ScalarType.NUMBER:
                return self._read_number(node, path)
            case ScalarType.COUNT:
                return self._read_count(node, path)
            case ScalarType.BOOLEAN | ScalarType.TRUE:
                return self._read_boolean(node, shape, path)
            case ScalarType.VERSION:
                return self._read_version(node, path)

    def _read_name_or_expression(self, node: YamlScalar, shape: ScalarSchema, path: DesignPath) -> FormatValue | None:
        if not node.text.strip():
            what = "name" if shape.scalar_type is ScalarType.NAME else "expression"
            self._report_invalid(node, f"the {what} is missing", path, "write one, or take the key away")
            return None
        if shape.choices and node.text not in shape.choices:
            mend = did_you_mean(node.text, shape.choices, f"write {' or '.join(shape.choices)}")
            self._report_invalid(node, f"'{_shorten(node.text)}' is not known here", path, mend)
            return None
        return node.text

    def _read_number(self, node: YamlScalar, path: DesignPath) -> FormatValue | None:
        number = _parse_number(node)
        if number is None or number <= 0:
            self._report_invalid(node, f"expected a number greater than 0, but this is {_describe_node(node)}", path)
            return None
        return number

    def _read_count(self, node: YamlScalar, path: DesignPath) -> FormatValue | None:
        number = _parse_number(node)
        if number is None or number < 0 or number != int(number):
            self._report_invalid(node, f"expected a whole number from 0 up, but this is {_describe_node(node)}", path)
            return None
        return number

    def _read_boolean(self, node: YamlScalar, shape: ScalarSchema, path: DesignPath) -> FormatValue | None:
        truth = None if node.style else _BOOLEANS.get(node.text)
        if truth is None:
            self._report_invalid(
                node, f"expected true or false, but this is {_describe_node(node)}", path, "write true or false"
            )
        elif shape.scalar_type is ScalarType.TRUE and not truth:
            self._report_invalid(node, f"'{path[-1]}' can only be true", path, f"take '{path[-1]}' away")
            return None
        return truth

    def _read_version(self, node: YamlScalar, path: DesignPath) -> FormatValue | None:
        if node.style or node.text != VERSION:
            message = f"version {_shorten(node.text)!r} of the format is not known"
            mend = f"this vicode reads version {VERSION}: write 'vicode: {VERSION}', or use a newer vicode"
            self.report.add("Y109", message, _span(node), fix=mend, path=path)
            return None
        return VERSION

    def _read_pair(self, node: YamlNode, shape: PairSchema, path: DesignPath) -> FormatValue | None:
        numbers = [_parse_number(item) for item in node.items] if isinstance(node, YamlSequence) else []
        if len(numbers) != 2 or None in numbers:
            self._report_invalid(node, f"expected {shape.description}, two numbers", path, "write it like [80, 120]")
            return None
        return tuple(number for number in numbers if number is not None)

    def _read_list(self, node: YamlNode, shape: ListSchema, path: DesignPath, key: YamlNode | None) -> TypedNode:
        if isinstance(node, YamlSequence):
            parts: dict[str | int, TypedNode] = {}
            members: list[str | int | None] = []
            for item in node.items:
                read = self.read(item, shape.item_schema(), (*path, len(parts)))
                members.append(None if read.value is None else len(parts))
                if read.value is not None:
                    parts[len(parts)] = read
            value = tuple(read.value for read in parts.values() if read.value is not None)
            return TypedNode(
                schema=shape, node=node, value=value, key_node=key, children=parts, child_keys=tuple(members)
            )
        item_shape = shape.item_schema()
        if shape.single_item_key and isinstance(item_shape, RecordSchema) and not self._is_item_alone(node, item_shape):
            return self._read_single_item(node, shape, item_shape, path, key)
        mend = "begin each with '- '" if isinstance(node, YamlMapping) else "write it like [a, b]"
        self._report_invalid(node, f"expected {shape.description}, but this is {_describe_node(node)}", path, mend)
        return TypedNode(schema=shape, node=node, value=None, key_node=key)

    def _is_item_alone(self, node: YamlNode, item: RecordSchema) -> bool:
        keys = (
            {key.text for key, _value in node.pairs if isinstance(key, YamlScalar)}
            if isinstance(node, YamlMapping)
            else set()
        )
        return bool(keys & {key.name for key in item.keys})

    def _read_single_item(
        self, node: YamlNode, shape: ListSchema, item: RecordSchema, path: DesignPath, key: YamlNode | None
    ) -> TypedNode:
        lone = item.find_key(shape.single_item_key)
        assert lone is not None, "the table names a key that the item does not have"
        if isinstance(node, YamlScalar) and not node.text.strip():
            return TypedNode(schema=shape, node=node, value=(), key_node=key, notation=YamlNotation.SINGLE_ITEM)
        inner = self.read(node, lone.schema, (*path, 0, lone.name))
        if inner.value is None:
            return TypedNode(schema=shape, node=node, value=None, key_node=key, notation=YamlNotation.SINGLE_ITEM)
        value = build_record_value(item, {lone.name: inner.value})
        single = TypedNode(
            schema=item, node=node, value=value, notation=YamlNotation.SHORTHAND, children={lone.name: inner}
        )
        return TypedNode(
            schema=shape,
            node=node,
            value=(value,),
            key_node=key,
            notation=YamlNotation.SINGLE_ITEM,
            children={0: single},
        )

    def _read_map(self, node: YamlNode, shape: MapSchema, path: DesignPath, key: YamlNode | None) -> TypedNode:
        if isinstance(node, YamlMapping):
            return self._read_full_map(node, shape, path, key)
        if isinstance(node, YamlSequence) and shape.allows_name_list:
            return self._read_name_list(node, shape, path, key)
        if isinstance(node, YamlScalar) and shape.shorthand_key:
            inner = self.read(node, shape.value_schema, (*path, shape.shorthand_key))
            value: FormatValue | None = None if inner.value is None else ((shape.shorthand_key, inner.value),)
            parts: dict[str | int, TypedNode] = {shape.shorthand_key: inner}
            return TypedNode(
                schema=shape, node=node, value=value, key_node=key, notation=YamlNotation.SHORTHAND, children=parts
            )
        if _is_null(node):
            return TypedNode(schema=shape, node=node, value=(), key_node=key)
        mend = "write 'name: …' without '- '" if isinstance(node, YamlSequence) else ""
        self._report_invalid(node, f"expected {shape.description}, but this is {_describe_node(node)}", path, mend)
        return TypedNode(schema=shape, node=node, value=None, key_node=key)

    def _read_full_map(self, node: YamlMapping, shape: MapSchema, path: DesignPath, key: YamlNode | None) -> TypedNode:
        parts: dict[str | int, TypedNode] = {}
        members: list[str | int | None] = []
        for name, key_node, value in self._entries(node, path):
            members.append(None)
            if name is None or key_node is None:
                continue
            if shape.allowed_keys and name not in shape.allowed_keys:
                mend = did_you_mean(name, shape.allowed_keys, f"known are {', '.join(shape.allowed_keys)}")
                self.report.add(
                    "Y102",
                    f"unknown key '{_shorten(name)}' in {shape.description}",
                    _span(key_node),
                    fix=mend,
                    path=path,
                )
                continue
            if shape.value_schema == ScalarSchema(scalar_type=ScalarType.EXPRESSION) and _is_blank(value):
                # One that is not written yet is told by the rules, and kept, so that half a work can be saved.
                parts[name] = TypedNode(schema=shape.value_schema, node=value, value="", key_node=key_node)
            else:
                parts[name] = self.read(value, shape.value_schema, (*path, name), key_node)
            members[-1] = name
        # A state that could not be read is still a state: only texts have no empty value to go on with.
        pairs = [(name, _or_empty(read)) for name, read in parts.items()]
        value_of = tuple((str(name), value) for name, value in pairs if value is not None)
        return TypedNode(
            schema=shape, node=node, value=value_of, key_node=key, children=parts, child_keys=tuple(members)
        )

    def _read_name_list(
        self, node: YamlSequence, shape: MapSchema, path: DesignPath, key: YamlNode | None
    ) -> TypedNode:
        parts: dict[str | int, TypedNode] = {}
        members: list[str | int | None] = []
        for item in node.items:
            members.append(None)
            name = self._read_scalar(item, ScalarSchema(scalar_type=ScalarType.NAME), path)
            if not isinstance(name, str):
                continue
            if name in parts:
                self.report.add(
                    "Y105", f"'{_shorten(name)}' is given twice", _span(item), fix="take one away", path=path
                )
                continue
            empty: FormatValue = "" if isinstance(shape.value_schema, ScalarSchema) else ()
            parts[name] = TypedNode(
                schema=shape.value_schema, node=item, value=empty, key_node=item, notation=YamlNotation.NAME_LIST
            )
            members[-1] = name
        pairs = tuple((str(name), read.value) for name, read in parts.items() if read.value is not None)
        return TypedNode(
            schema=shape,
            node=node,
            value=pairs,
            key_node=key,
            notation=YamlNotation.NAME_LIST,
            children=parts,
            child_keys=tuple(members),
        )

    def _read_record(self, node: YamlNode, shape: RecordSchema, path: DesignPath, key: YamlNode | None) -> TypedNode:
        short = shape.find_key(shape.shorthand_key) if shape.shorthand_key else None
        if short and not _is_full_notation(node, short) and not (isinstance(node, YamlScalar) and node.is_empty):
            inner = self.read(node, short.schema, (*path, short.name))
            value: FormatValue | None = (
                None if inner.value is None else build_record_value(shape, {short.name: inner.value})
            )
            parts: dict[str | int, TypedNode] = {short.name: inner}
            return TypedNode(
                schema=shape, node=node, value=value, key_node=key, notation=YamlNotation.SHORTHAND, children=parts
            )
        if isinstance(node, YamlMapping):
            return self._read_full_record(node, shape, path, key)
        if _is_null(node):
            value = self._finish_record(node, shape, {}, path)
            return TypedNode(schema=shape, node=node, value=value, key_node=key)
        mend = "write 'key: value' without '- '" if isinstance(node, YamlSequence) else ""
        self._report_invalid(node, f"expected {shape.description}, but this is {_describe_node(node)}", path, mend)
        return TypedNode(schema=shape, node=node, value=None, key_node=key)

    def _read_full_record(
        self, node: YamlMapping, shape: RecordSchema, path: DesignPath, key: YamlNode | None
    ) -> TypedNode:
        parts: dict[str | int, TypedNode] = {}
        members: list[str | int | None] = []
        for name, key_node, value in self._entries(node, path):
            members.append(None)
            known = shape.find_key(name) if name is not None else None
            if known is None and name is not None and key_node is not None:
                self._report_unknown_key(name, key_node, shape, path)
            if known is None or _is_omitted(value, known, shape):
                continue
            target = shape.find_key(known.shorthand_for) if known.shorthand_for else known
            assert target is not None, "the table names a key that the record does not have"
            if target.name in parts:
                other = "actions" if known.shorthand_for else "code"
                message = f"'{known.name}' and '{other}' exclude each other"
                self.report.add("Y111", message, _span(key_node or node), fix="put all of it into 'actions'", path=path)
                continue
            parts[target.name] = self.read(value, target.schema, (*path, target.name), key_node)
            members[-1] = target.name
        value_of = self._finish_record(node, shape, parts, path)
        return TypedNode(
            schema=shape, node=node, value=value_of, key_node=key, children=parts, child_keys=tuple(members)
        )

    def _finish_record(
        self, node: YamlNode, shape: RecordSchema, parts: "dict[str | int, TypedNode]", path: DesignPath
    ) -> FormatValue | None:
        """The value of a record's parts, after a look at which keys must and must not come together."""
        for each in shape.keys:
            if each.required and each.name not in parts:
                example = VERSION if each.schema == ScalarSchema(scalar_type=ScalarType.VERSION) else "…"
                self._report_missing(node, f"{shape.name} has no '{each.name}'", f"add '{each.name}: {example}'", path)
        given = [str(name) for name in parts if name in shape.one_of]
        if shape.one_of and not given:
            self._report_missing(node, *shape.missing_message, path)
            return None
        for extra in given[1:]:
            message = f"'{given[0]}' and '{extra}' exclude each other"
            self.report.add(
                "Y111", message, _span(parts[extra].key_node or node), fix=f"take '{extra}' away", path=path
            )
        values = {str(name): read.value for name, read in parts.items() if name not in given[1:]}
        for name, needed in shape.dependent_keys:
            if name in values and needed not in values and given:
                message = f"'{name}' belongs to '{needed}', not to '{given[0]}'"
                self.report.add(
                    "Y111", message, _span(parts[name].key_node or node), fix=f"take '{name}' away", path=path
                )
                del values[name]
        if given and values.get(given[0]) is None:
            return None
        return build_record_value(shape, values)

    def _report_missing(self, node: YamlNode, message: str, mend: str, path: DesignPath) -> None:
        first = node.pairs[0][0] if isinstance(node, YamlMapping) and node.pairs and not node.is_flow else node
        self.report.add("Y104", message, _span(first), fix=mend, path=path)

    def _entries(self, node: YamlMapping, path: DesignPath) -> list[tuple[str | None, YamlNode | None, YamlNode]]:
        """Name, key and value of every pair; no name for a key that is no text or was there before."""
        entries: list[tuple[str | None, YamlNode | None, YamlNode]] = []
        seen: dict[str, YamlNode] = {}
        for key, value in node.pairs:
            if not isinstance(key, YamlScalar) or key.is_rejected:
                if not isinstance(key, YamlScalar):
                    self._report_invalid(key, f"expected a key, but this is {_describe_node(key)}", path)
                entries.append((None, None, value))
            elif key.text in seen:
                note = ("first here", seen[key.text].start)
                message = f"'{_shorten(key.text)}' is given twice"
                self.report.add("Y105", message, _span(key), fix="take one away, or rename it", path=path, note=note)
                entries.append((None, key, value))
            else:
                seen[key.text] = key
                entries.append((key.text, key, value))
        return entries

    def _report_unknown_key(self, name: str, key: YamlNode, shape: RecordSchema, path: DesignPath) -> None:
        if self.report.is_full:
            return
        known = [each.name for each in shape.keys]
        meant = shape.synonyms.get(name)
        mend = f"did you mean '{meant}'?" if meant else did_you_mean(name, known, f"known are {', '.join(known)}")
        self.report.add(
            "Y102", f"unknown key '{_shorten(name)}' in {shape.description}", _span(key), fix=mend, path=path
        )


def _is_full_notation(node: YamlNode, short: KeySchema) -> bool:
    if not isinstance(node, YamlMapping):
        return False
    if not isinstance(short.schema, MapSchema):
        return True
    names = {key.text: value for key, value in node.pairs if isinstance(key, YamlScalar)}
    return not isinstance(names.get(short.name, YamlScalar("", "", 0, 0)), YamlScalar)


def _is_omitted(value: YamlNode, key: KeySchema, record: RecordSchema) -> bool:
    """A key with nothing behind it counts as left out, unless that would be another guard or another item."""
    is_needed = key.name in record.one_of or key.schema == ScalarSchema(scalar_type=ScalarType.EXPRESSION)
    return isinstance(value, YamlScalar) and value.is_empty and not is_needed


def _is_null(node: YamlNode) -> bool:
    return isinstance(node, YamlScalar) and not node.style and node.text in _NULLS


def _is_blank(node: YamlNode) -> bool:
    return isinstance(node, YamlScalar) and not node.is_rejected and not node.text.strip()


def _or_empty(read: TypedNode) -> FormatValue | None:
    return () if read.value is None and isinstance(read.schema, RecordSchema | MapSchema) else read.value


def _parse_number(node: YamlNode) -> float | None:
    if not isinstance(node, YamlScalar) or node.style or not _NUMBER.match(node.text):
        return None
    number = float(node.text)
    return number if math.isfinite(number) else None


def _span(node: YamlNode) -> tuple[int, int]:
    return node.start, max(node.end, node.start + 1)


def _shorten(text: str) -> str:
    return text if len(text) <= 60 else text[:57] + "…"


def _describe_expected(shape: ScalarSchema) -> str:
    return {ScalarType.TEXT: "a text", ScalarType.NAME: "a name", ScalarType.EXPRESSION: "an expression"}.get(
        shape.scalar_type, f"{shape.scalar_type.value}"
    )


def _describe_node(node: YamlNode) -> str:
    if isinstance(node, YamlMapping):
        return "a mapping"
    if isinstance(node, YamlSequence):
        return "a list"
    return f"'{_shorten(node.text)}'" if node.text else "nothing"
