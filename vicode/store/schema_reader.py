"""Reads YAML nodes against the schema of the format, reports each error at its location, and keeps what is valid.

Values come out in full notation, whatever the file uses; the node of each value and its notation are kept for locations
and patches. A value that cannot be read is None, and its parent leaves it out: one error hides no other, and the valid
rest of a file can be shown and edited.
"""

from vicode.findings import DesignPath, did_you_mean
from vicode.store.format_values import VERSION
from vicode.store.line_index import ReadReport
from vicode.store.scalar_reader import ScalarReader, node_span, shorten
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
from vicode.store.typed_node import TypedNode, YamlNotation
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar, YamlSequence

_NULLS = ("", "~", "null", "Null", "NULL")


class SchemaReader:
    """Reads the nodes of one file."""

    def __init__(self, report: ReadReport) -> None:
        """Errors are added to `report`."""
        self.report = report
        self.scalars = ScalarReader(report)

    def read(
        self, node: YamlNode, schema: ValueSchema, path: DesignPath = (), key: YamlNode | None = None
    ) -> TypedNode:
        """Read a node.

        Args:
            node: The node to read.
            schema: The schema of the node.
            path: The path of the node in the file.
            key: The key of the node in its parent mapping.
        """
        if isinstance(node, YamlScalar) and node.is_rejected:
            return TypedNode(schema=schema, node=node, value=None, key_node=key)
        match schema:
            case ScalarSchema():
                value = self.scalars.read_scalar(node, schema, path)
                return TypedNode(schema=schema, node=node, value=value, key_node=key)
            case PairSchema():
                value = self.scalars.read_pair(node, schema, path)
                return TypedNode(schema=schema, node=node, value=value, key_node=key)
            case ListSchema():
                return self._read_list(node, schema, path, key)
            case MapSchema():
                return self._read_map(node, schema, path, key)
            case RecordSchema():
                return self._read_record(node, schema, path, key)

    def _read_list(self, node: YamlNode, schema: ListSchema, path: DesignPath, key: YamlNode | None) -> TypedNode:
        item_schema = schema.item_schema()
        if isinstance(node, YamlSequence):
            children: dict[str | int, TypedNode] = {}
            child_keys: list[str | int | None] = []
            for item in node.items:
                child = self.read(item, item_schema, (*path, len(children)))
                child_keys.append(None if child.value is None else len(children))
                if child.value is not None:
                    children[len(children)] = child
            return TypedNode(
                schema=schema,
                node=node,
                value=tuple(child.value for child in children.values() if child.value is not None),
                key_node=key,
                children=children,
                child_keys=tuple(child_keys),
            )
        is_single = schema.single_item_key and isinstance(item_schema, RecordSchema)
        if is_single and isinstance(item_schema, RecordSchema) and not _has_key_of(node, item_schema):
            return self._read_single_item(node, schema, item_schema, path, key)
        fix = "start each item with '- '" if isinstance(node, YamlMapping) else "write it as [a, b]"
        self.scalars.report_unexpected(node, schema.description, path, fix)
        return TypedNode(schema=schema, node=node, value=None, key_node=key)

    def _read_single_item(
        self, node: YamlNode, schema: ListSchema, item: RecordSchema, path: DesignPath, key: YamlNode | None
    ) -> TypedNode:
        item_key = item.find_key(schema.single_item_key)
        assert item_key is not None, "the item schema lacks the single_item_key of its list"
        value: FormatValue | None = ()
        children: dict[str | int, TypedNode] = {}
        if not (isinstance(node, YamlScalar) and not node.text.strip()):
            inner = self.read(node, item_key.schema, (*path, 0, item_key.name))
            value = None
            if inner.value is not None:
                item_value = build_record_value(item, {item_key.name: inner.value})
                value = (item_value,)
                children[0] = TypedNode(
                    schema=item,
                    node=node,
                    value=item_value,
                    notation=YamlNotation.SHORTHAND,
                    children={item_key.name: inner},
                )
        return TypedNode(
            schema=schema, node=node, value=value, key_node=key, notation=YamlNotation.SINGLE_ITEM, children=children
        )

    def _read_map(self, node: YamlNode, schema: MapSchema, path: DesignPath, key: YamlNode | None) -> TypedNode:
        if isinstance(node, YamlMapping):
            return self._read_full_map(node, schema, path, key)
        if isinstance(node, YamlSequence) and schema.allows_name_list:
            return self._read_name_list(node, schema, path, key)
        if isinstance(node, YamlScalar) and schema.shorthand_key:
            inner = self.read(node, schema.value_schema, (*path, schema.shorthand_key))
            return TypedNode(
                schema=schema,
                node=node,
                value=None if inner.value is None else ((schema.shorthand_key, inner.value),),
                key_node=key,
                notation=YamlNotation.SHORTHAND,
                children={schema.shorthand_key: inner},
            )
        if _is_null(node):
            return TypedNode(schema=schema, node=node, value=(), key_node=key)
        fix = "write 'name: …' without '- '" if isinstance(node, YamlSequence) else ""
        self.scalars.report_unexpected(node, schema.description, path, fix)
        return TypedNode(schema=schema, node=node, value=None, key_node=key)

    def _read_full_map(self, node: YamlMapping, schema: MapSchema, path: DesignPath, key: YamlNode | None) -> TypedNode:
        children: dict[str | int, TypedNode] = {}
        child_keys: list[str | int | None] = []
        for name, key_node, value in self._entries(node, path):
            child_keys.append(None)
            if name is None or key_node is None:
                continue
            if schema.allowed_keys and name not in schema.allowed_keys:
                fix = did_you_mean(name, schema.allowed_keys, f"use one of: {', '.join(schema.allowed_keys)}")
                self._report_unknown_key(name, key_node, schema.description, fix, path)
                continue
            if schema.value_schema == ScalarSchema(scalar_type=ScalarType.EXPRESSION) and _is_blank(value):
                # The check reports an empty expression; it is kept so that unfinished designs can be saved.
                children[name] = TypedNode(schema=schema.value_schema, node=value, value="", key_node=key_node)
            else:
                children[name] = self.read(value, schema.value_schema, (*path, name), key_node)
            child_keys[-1] = name
        # An unreadable state still counts as a state. Scalars have no empty value, so an unreadable one is dropped.
        pairs = [(name, _or_empty(child)) for name, child in children.items()]
        return TypedNode(
            schema=schema,
            node=node,
            value=tuple((str(name), value) for name, value in pairs if value is not None),
            key_node=key,
            children=children,
            child_keys=tuple(child_keys),
        )

    def _read_name_list(
        self, node: YamlSequence, schema: MapSchema, path: DesignPath, key: YamlNode | None
    ) -> TypedNode:
        children: dict[str | int, TypedNode] = {}
        child_keys: list[str | int | None] = []
        empty: FormatValue = "" if isinstance(schema.value_schema, ScalarSchema) else ()
        for item in node.items:
            child_keys.append(None)
            name = self.scalars.read_scalar(item, ScalarSchema(scalar_type=ScalarType.NAME), path)
            if not isinstance(name, str):
                continue
            if name in children:
                message = f"duplicate name '{shorten(name)}'"
                self.report.add("Y105", message, node_span(item), fix="remove one of them", path=path)
                continue
            children[name] = TypedNode(
                schema=schema.value_schema, node=item, value=empty, key_node=item, notation=YamlNotation.NAME_LIST
            )
            child_keys[-1] = name
        return TypedNode(
            schema=schema,
            node=node,
            value=tuple((str(name), empty) for name in children),
            key_node=key,
            notation=YamlNotation.NAME_LIST,
            children=children,
            child_keys=tuple(child_keys),
        )

    def _read_record(self, node: YamlNode, schema: RecordSchema, path: DesignPath, key: YamlNode | None) -> TypedNode:
        short = schema.find_shorthand(node.text if isinstance(node, YamlScalar) else "")
        if short and not _is_full_notation(node, short) and not (isinstance(node, YamlScalar) and node.is_empty):
            inner = self.read(node, short.schema, (*path, short.name))
            return TypedNode(
                schema=schema,
                node=node,
                value=None if inner.value is None else build_record_value(schema, {short.name: inner.value}),
                key_node=key,
                notation=YamlNotation.SHORTHAND,
                children={short.name: inner},
            )
        if isinstance(node, YamlMapping):
            return self._read_full_record(node, schema, path, key)
        if _is_null(node):
            value = self._finish_record(node, schema, {}, path)
            return TypedNode(schema=schema, node=node, value=value, key_node=key)
        fix = "write 'key: value' without '- '" if isinstance(node, YamlSequence) else ""
        self.scalars.report_unexpected(node, schema.description, path, fix)
        return TypedNode(schema=schema, node=node, value=None, key_node=key)

    def _read_full_record(
        self, node: YamlMapping, schema: RecordSchema, path: DesignPath, key: YamlNode | None
    ) -> TypedNode:
        children: dict[str | int, TypedNode] = {}
        child_keys: list[str | int | None] = []
        for name, key_node, value in self._entries(node, path):
            child_keys.append(None)
            known = schema.find_key(name) if name is not None else None
            if known is None and name is not None and key_node is not None:
                names = [known.name for known in schema.keys]
                meant = schema.synonyms.get(name)
                fix = (
                    f"did you mean '{meant}'?"
                    if meant
                    else did_you_mean(name, names, f"use one of: {', '.join(names)}")
                )
                self._report_unknown_key(name, key_node, schema.description, fix, path)
            if known is None or _is_omitted(value, known, schema):
                continue
            target = schema.find_key(known.shorthand_for) if known.shorthand_for else known
            assert target is not None, "shorthand_for names a key that the record lacks"
            if target.name in children:
                other = "actions" if known.shorthand_for else "code"
                message = f"'{known.name}' and '{other}' cannot be combined"
                self.report.add(
                    "Y111", message, node_span(key_node or node), fix="move everything into 'actions'", path=path
                )
                continue
            children[target.name] = self.read(value, target.schema, (*path, target.name), key_node)
            child_keys[-1] = target.name
        return TypedNode(
            schema=schema,
            node=node,
            value=self._finish_record(node, schema, children, path),
            key_node=key,
            children=children,
            child_keys=tuple(child_keys),
        )

    def _finish_record(
        self, node: YamlNode, schema: RecordSchema, children: dict[str | int, TypedNode], path: DesignPath
    ) -> FormatValue | None:
        """Check which keys are given together and build the value of the record."""
        for key in schema.keys:
            if key.required and key.name not in children:
                example = VERSION if key.schema == ScalarSchema(scalar_type=ScalarType.VERSION) else "…"
                self._report_missing(node, f"{schema.name} has no '{key.name}'", f"add '{key.name}: {example}'", path)
        given = [str(name) for name in children if name in schema.one_of]
        if schema.one_of and not given:
            self._report_missing(node, *schema.missing_message, path)
            return None
        for extra in given[1:]:
            message = f"'{given[0]}' and '{extra}' cannot be combined"
            self._report_conflict(children[extra].key_node or node, message, extra, path)
        values = {str(name): child.value for name, child in children.items() if name not in given[1:]}
        for name, *needed in schema.dependent_keys:
            if name in values and not any(each in values for each in needed) and given:
                required = " or ".join(f"'{each}'" for each in needed)
                message = f"'{name}' requires {required}, found '{given[0]}'"
                self._report_conflict(children[name].key_node or node, message, name, path)
                del values[name]
        if given and values.get(given[0]) is None:
            return None
        return build_record_value(schema, values)

    def _report_conflict(self, node: YamlNode, message: str, name: str, path: DesignPath) -> None:
        self.report.add("Y111", message, node_span(node), fix=f"remove '{name}'", path=path)

    def _report_missing(self, node: YamlNode, message: str, fix: str, path: DesignPath) -> None:
        first = node.pairs[0][0] if isinstance(node, YamlMapping) and node.pairs and not node.is_flow else node
        self.report.add("Y104", message, node_span(first), fix=fix, path=path)

    def _report_unknown_key(self, name: str, key: YamlNode, parent: str, fix: str, path: DesignPath) -> None:
        self.report.add("Y102", f"unknown key '{shorten(name)}' in {parent}", node_span(key), fix=fix, path=path)

    def _entries(self, node: YamlMapping, path: DesignPath) -> list[tuple[str | None, YamlNode | None, YamlNode]]:
        """Name, key and value of each pair; the name is None for duplicate keys and for keys that are no scalars."""
        entries: list[tuple[str | None, YamlNode | None, YamlNode]] = []
        seen: dict[str, YamlNode] = {}
        for key, value in node.pairs:
            if not isinstance(key, YamlScalar) or key.is_rejected:
                if not isinstance(key, YamlScalar):
                    self.scalars.report_unexpected(key, "a key", path)
                entries.append((None, None, value))
            elif key.text in seen:
                note = ("first defined here", seen[key.text].start)
                message = f"duplicate key '{shorten(key.text)}'"
                self.report.add("Y105", message, node_span(key), fix="remove or rename one", path=path, note=note)
                entries.append((None, key, value))
            else:
                seen[key.text] = key
                entries.append((key.text, key, value))
        return entries


def _has_key_of(node: YamlNode, item: RecordSchema) -> bool:
    if not isinstance(node, YamlMapping):
        return False
    return any(isinstance(key, YamlScalar) and item.find_key(key.text) for key, _value in node.pairs)


def _is_full_notation(node: YamlNode, short: KeySchema) -> bool:
    if not isinstance(node, YamlMapping):
        return False
    if not isinstance(short.schema, MapSchema):
        return True
    values = {key.text: value for key, value in node.pairs if isinstance(key, YamlScalar)}
    return short.name in values and not isinstance(values[short.name], YamlScalar)


def _is_omitted(value: YamlNode, key: KeySchema, record: RecordSchema) -> bool:
    """Whether a key without a value counts as missing.

    It does not where the missing key would change the meaning: a guard, or the key that selects the kind of item.
    """
    is_needed = key.name in record.one_of or key.schema == ScalarSchema(scalar_type=ScalarType.EXPRESSION)
    return isinstance(value, YamlScalar) and value.is_empty and not is_needed


def _is_null(node: YamlNode) -> bool:
    return isinstance(node, YamlScalar) and not node.style and node.text in _NULLS


def _is_blank(node: YamlNode) -> bool:
    return isinstance(node, YamlScalar) and not node.is_rejected and not node.text.strip()


def _or_empty(child: TypedNode) -> FormatValue | None:
    return () if child.value is None and isinstance(child.schema, RecordSchema | MapSchema) else child.value
