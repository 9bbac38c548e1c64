"""Builds the target tree of a patch from a new value and the nodes of the old text.

The schema, the new value and the old nodes are walked together. Equal parts are kept, whatever their notation; a part
that differs gets a target in the notation of the old one if the value fits, such as the short form of a declaration.
Members continue old ones by name or similarity, also if they moved into another list or out of it. Content that the
reader did not understand stays a member in its place. What to write is decided here; `patcher` only decides where.
"""

import itertools
from collections.abc import Iterable, Iterator
from typing import cast

from vicode.store.format_values import FLOW_WIDTH
from vicode.store.matching import match_items, match_names
from vicode.store.member_spans import end_of_deeper_comments, first_attached_comment, line_start, next_line_start
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
)
from vicode.store.target_tree import TargetCollection, TargetKeep, TargetMember, TargetMoved, TargetNode, TargetScalar
from vicode.store.typed_node import TypedNode, YamlNotation
from vicode.store.unread import iter_unread_spans
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar, YamlSequence


class TargetBuilder:
    """Builds targets for one old text."""

    def __init__(self, text: str, max_depth: int = 0) -> None:
        """`text` is the old text; below `max_depth`, differing values are replaced as a whole."""
        self.text = text
        self.max_depth = max_depth
        self.depth = 0
        self.moved: dict[FormatValue, tuple[tuple[str, ...], int]] = {}

    def build(
        self, schema: ValueSchema, data: FormatValue, old: TypedNode | None = None, *, in_flow: bool = False
    ) -> TargetNode:
        """Build the target for a value; `in_flow`: whether the old node is part of a flow collection."""
        if old is not None and _value_of(old) == data:
            return TargetKeep()
        is_replaced = old is not None and (
            self.depth >= self.max_depth or self._outgrows_flow_style(old, data, in_flow=in_flow)
        )
        if old is not None and is_replaced and not any(iter_unread_spans(old)):
            old = None
        in_flow = in_flow or (old is not None and not isinstance(old.node, YamlScalar) and old.node.is_flow)
        self.depth += 1
        target = self._build_changed(schema, data, old, in_flow=in_flow)
        self.depth -= 1
        return target

    def _build_changed(
        self, schema: ValueSchema, data: FormatValue, old: TypedNode | None, *, in_flow: bool
    ) -> TargetNode:
        match schema:
            case ScalarSchema():
                return _scalar_target(schema, data)
            case PairSchema():
                return TargetCollection(members=_number_members(data, old), is_mapping=False, flow_width=FLOW_WIDTH)
            case ListSchema():
                return self._build_list(schema, data, old, in_flow=in_flow)
            case MapSchema():
                return self._build_map(schema, data, old, in_flow=in_flow)
            case RecordSchema():
                return self._build_record(schema, data, old, in_flow=in_flow)

    def _outgrows_flow_style(self, old: TypedNode, data: FormatValue, *, in_flow: bool) -> bool:
        """Whether flow style no longer fits: the value has a new multi-line text, or the line becomes too long."""
        node = old.node
        if in_flow or isinstance(node, YamlScalar) or not node.is_flow or "#" in self.text[node.start : node.end]:
            return False
        before = _value_of(old)
        if _multiline_texts(data) - _multiline_texts(() if before is None else before):
            return True
        length = _flow_length(data)
        return length > FLOW_WIDTH and before is not None and length > _flow_length(before)

    def _build_list(self, schema: ListSchema, data: FormatValue, old: TypedNode | None, *, in_flow: bool) -> TargetNode:
        items = cast("tuple[FormatValue, ...]", data)
        item_schema = schema.item_schema()
        item_value = _single_item_value(schema, items)
        if item_value is not None and (old is None or old.notation is YamlNotation.SINGLE_ITEM):
            inner = old.children[0].children[schema.single_item_key] if old is not None and old.children else None
            assert isinstance(item_schema, RecordSchema)
            key = item_schema.find_key(schema.single_item_key)
            assert key is not None
            return self.build(key.schema, item_value, inner, in_flow=in_flow)
        if old is None or old.notation is not YamlNotation.FULL:
            members = [TargetMember(value=self._build_item(item_schema, item)) for item in items]
            return TargetCollection(members=tuple(members), is_mapping=False, flow_width=schema.flow_width)
        indices = {child: index for index, child in enumerate(old.child_keys) if child is not None}
        old_values = [cast("FormatValue", old.children[child].value) for child in indices]
        members = []
        matches = self._without_moved(old, items, match_items(old_values, items))
        for item, match in zip(items, matches, strict=True):
            child = old.children[match] if match is not None else None
            value = self._build_item(item_schema, item, child, in_flow=in_flow)
            members.append(TargetMember(value=value, old_index=indices[match] if match is not None else None))
        with_others = _merge_unread(members, _unread_members(old))
        return TargetCollection(members=with_others, is_mapping=False, flow_width=schema.flow_width)

    def _build_item(
        self, schema: ValueSchema, data: FormatValue, old: TypedNode | None = None, *, in_flow: bool = False
    ) -> TargetNode:
        target = self.build(schema, data, old, in_flow=in_flow)
        if old is None and data in self.moved:
            lines, column = self.moved[data]
            return TargetMoved(lines=lines, column=column, target=target)
        return target

    def _without_moved(
        self, old: TypedNode, items: tuple[FormatValue, ...], matches: list[int | None]
    ) -> list[int | None]:
        """Record the items that move into or out of others, with their comments, and drop their matches."""
        if isinstance(old.node, YamlScalar) or old.node.is_flow:
            return matches
        inner = set(itertools.chain.from_iterable(map(_inner_values, items)))
        before = {cast("FormatValue", child.value) for child in old.children.values()}
        into = {key for key, child in old.children.items() if child.value in inner and child.value not in items}
        for lists, child in _iter_items(old):
            is_moved = child.value in inner if lists is old else child.value in items
            if child.value is not None and is_moved and (lists is old) == (child.value in before):
                self._note_moved(child)
        return [
            None if match in into or (match is not None and item in self.moved and item not in before) else match
            for item, match in zip(items, matches, strict=True)
        ]

    def _note_moved(self, item: TypedNode) -> None:
        """Note the lines of an item of a list, if they contain more than its value."""
        line = line_start(self.text, item.node.start)
        dash = self.text[line : item.node.start].rstrip(" ")
        if dash.strip(" ") != "-":
            return
        start = first_attached_comment(self.text, line, 0)
        after = next_line_start(self.text, item.node.end)
        end = end_of_deeper_comments(self.text, after, len(self.text), len(dash) - 1)
        text = self.text[start:end]
        if item.value is not None and ("#" in text or any(iter_unread_spans(item))):
            self.moved[item.value] = tuple(text.removesuffix("\n").split("\n")), len(dash) - 1

    def _build_map(self, schema: MapSchema, data: FormatValue, old: TypedNode | None, *, in_flow: bool) -> TargetNode:
        pairs = cast("tuple[tuple[str, FormatValue], ...]", data)
        _reject_duplicate_names(pairs)
        fits_short = bool(schema.shorthand_key) and [name for name, _value in pairs] == [schema.shorthand_key]
        if fits_short and (old is None or old.notation is YamlNotation.SHORTHAND):
            inner = old.children[schema.shorthand_key] if old is not None else None
            return self.build(schema.value_schema, pairs[0][1], inner, in_flow=in_flow)
        fits_names = schema.allows_name_list and bool(pairs) and not any(value for _name, value in pairs)
        if fits_names and (old is None or old.notation is YamlNotation.NAME_LIST):
            return self._build_name_list(schema, pairs, old)
        if old is None or old.notation is not YamlNotation.FULL:
            members = [TargetMember(key=name, value=self.build(schema.value_schema, value)) for name, value in pairs]
            return TargetCollection(members=tuple(members), is_mapping=True, flow_width=schema.flow_width)
        indices = {
            child: index
            for index, child in enumerate(old.child_keys)
            if child is not None and _value_of(old.children[child]) is not None
        }
        names = [str(child) for child in indices]
        known = [(name, cast("FormatValue", _value_of(old.children[name]))) for name in names]
        members = []
        for (name, value), match in zip(pairs, match_names(known, pairs), strict=True):
            child = old.children[names[match]] if match is not None else None
            target = self.build(schema.value_schema, value, child, in_flow=in_flow)
            members.append(
                TargetMember(key=name, value=target, old_index=indices[names[match]] if match is not None else None)
            )
        return TargetCollection(
            members=_merge_unread(members, _unread_members(old)), is_mapping=True, flow_width=schema.flow_width
        )

    def _build_name_list(
        self, schema: MapSchema, pairs: tuple[tuple[str, FormatValue], ...], old: TypedNode | None
    ) -> TargetNode:
        indices = {child: index for index, child in enumerate(old.child_keys) if child is not None} if old else {}
        members = [
            TargetMember(
                value=TargetKeep() if name in indices else TargetScalar(text=name), old_index=indices.get(name)
            )
            for name, _value in pairs
        ]
        with_others = _merge_unread(members, _unread_members(old) if old else ())
        return TargetCollection(members=with_others, is_mapping=False, flow_width=schema.flow_width)

    def _build_record(
        self, schema: RecordSchema, data: FormatValue, old: TypedNode | None, *, in_flow: bool
    ) -> TargetNode:
        values = dict(cast("tuple[tuple[str, FormatValue], ...]", data))
        short = _fitting_shorthand(schema, values)
        if short and (old is None or old.notation is YamlNotation.SHORTHAND):
            inner = old.children.get(short.name) if old is not None else None
            return self.build(short.schema, values[short.name], inner, in_flow=in_flow)
        if short and old is not None and self._shrinks(old):
            return self.build(short.schema, values[short.name], in_flow=in_flow)
        if old is None or old.notation is not YamlNotation.FULL or isinstance(old.node, YamlScalar):
            members = [self._new_pair(schema, key, values[key.name]) for key in schema.keys if key.name in values]
            return TargetCollection(
                members=tuple(members), is_mapping=True, flow_width=schema.flow_width, is_ordered=False
            )
        return self._update_record(schema, values, old, in_flow=in_flow)

    def _shrinks(self, old: TypedNode) -> bool:
        """Whether a record in one line loses keys; it then returns to its short form, as an undone edit should."""
        is_short = isinstance(old.node, YamlMapping) and old.node.is_flow and None not in old.child_keys
        return is_short and len(old.children) > 1 and "\n" not in self.text[old.node.start : old.node.end]

    def _update_record(
        self, schema: RecordSchema, values: dict[str, FormatValue], old: TypedNode, *, in_flow: bool
    ) -> TargetNode:
        before = dict(cast("tuple[tuple[str, FormatValue], ...]", old.value or ()))
        members: list[TargetMember] = []
        written: set[str] = set()
        for index, child in enumerate(old.child_keys):
            name = str(child) if child is not None else _key_text(old.node, index)
            key = schema.find_key(name)
            if key is not None and name in values and name not in written:
                written.add(name)
                members.append(self._update_pair(schema, key, values[name], old, index, in_flow=in_flow))
            elif child is None or name not in before:
                # Keep unknown keys and explicit default values.
                members.append(TargetMember(key=_key_text(old.node, index), value=TargetKeep(), old_index=index))
        order = {key.name: index for index, key in enumerate(schema.keys)}
        for name, value in values.items():
            if name not in written:
                key = schema.find_key(name)
                assert key is not None
                members.insert(_insertion_index(key, members, schema, order), self._new_pair(schema, key, value))
        return TargetCollection(members=tuple(members), is_mapping=True, flow_width=schema.flow_width, is_ordered=False)

    def _update_pair(
        self, schema: RecordSchema, key: KeySchema, data: FormatValue, old: TypedNode, index: int, *, in_flow: bool
    ) -> TargetMember:
        written = _key_text(old.node, index)
        child = old.children.get(key.name) if old.child_keys[index] is not None else None
        short_key = schema.find_key(written)
        if short_key is not None and short_key.shorthand_for and child is not None and _value_of(child) != data:
            assert isinstance(key.schema, ListSchema)
            if _single_item_value(key.schema, cast("tuple[FormatValue, ...]", data)) is None:
                return TargetMember(key=key.name, value=self.build(key.schema, data), old_index=index)
        return TargetMember(key=written, value=self.build(key.schema, data, child, in_flow=in_flow), old_index=index)

    def _new_pair(self, schema: RecordSchema, key: KeySchema, data: FormatValue) -> TargetMember:
        short_key = next((short for short in schema.keys if short.shorthand_for == key.name), None)
        name = key.name
        if short_key is not None and isinstance(key.schema, ListSchema):
            items = cast("tuple[FormatValue, ...]", data)
            name = short_key.name if _single_item_value(key.schema, items) is not None else name
        return TargetMember(key=name, value=self.build(key.schema, data))


def format_number(number: float) -> str:
    """Format a number; integral numbers have no decimal point."""
    return str(int(number)) if number == int(number) and abs(number) < 1e15 else repr(number)


def _value_of(read: TypedNode) -> FormatValue | None:
    # As in the reader, an unreadable record or map has the empty value.
    return () if read.value is None and isinstance(read.schema, RecordSchema | MapSchema) else read.value


def _scalar_target(schema: ScalarSchema, data: FormatValue) -> TargetScalar:
    if isinstance(data, bool):
        return TargetScalar(text="true" if data else "false", is_plain=True)
    if isinstance(data, int | float):
        return TargetScalar(text=format_number(data), is_plain=True)
    assert isinstance(data, str)
    return TargetScalar(text=data, is_plain=schema.scalar_type is ScalarType.VERSION)


def _number_members(data: FormatValue, old: TypedNode | None) -> tuple[TargetMember, ...]:
    numbers = cast("tuple[float, ...]", data)
    is_patched = old is not None and isinstance(old.node, YamlSequence) and len(old.node.items) == len(numbers)
    return tuple(
        TargetMember(
            value=TargetScalar(text=format_number(number), is_plain=True), old_index=index if is_patched else None
        )
        for index, number in enumerate(numbers)
    )


def _single_item_value(schema: ListSchema, items: tuple[FormatValue, ...]) -> FormatValue | None:
    """The value of the single item if the list can be written without brackets and key."""
    if not schema.single_item_key or len(items) != 1:
        return None
    pairs = cast("tuple[tuple[str, FormatValue], ...]", items[0])
    if [name for name, _value in pairs] != [schema.single_item_key]:
        return None
    texts = cast("tuple[tuple[str, str], ...]", pairs[0][1])
    is_blank = [name for name, _text in texts] == ["python"] and not texts[0][1].strip()
    return None if is_blank else pairs[0][1]


def _fitting_shorthand(schema: RecordSchema, values: dict[str, FormatValue]) -> KeySchema | None:
    """The key whose value is the short form of a record; None if the record must be written in full."""
    if len(values) != 1:
        return None
    ((name, value),) = values.items()
    short = schema.find_shorthand(value.strip() if isinstance(value, str) else "")
    if short is None or short.name != name:
        return None
    is_ambiguous = isinstance(short.schema, MapSchema) and name in dict(
        cast("tuple[tuple[str, FormatValue], ...]", value)
    )
    return None if is_ambiguous else short


def _reject_duplicate_names(pairs: tuple[tuple[str, FormatValue], ...]) -> None:
    names = [name for name, _value in pairs]
    duplicates = sorted({name for name in names if names.count(name) > 1}) if len(set(names)) < len(names) else []
    if duplicates:
        raise ValueError(f"duplicate names cannot be saved: {', '.join(duplicates)}; rename one of each")


def _inner_values(value: FormatValue) -> Iterator[FormatValue]:
    for inner in value if isinstance(value, tuple) else ():
        yield inner
        yield from _inner_values(inner)


def _iter_items(read: TypedNode) -> Iterator[tuple[TypedNode, TypedNode]]:
    """Each list at or below a node with each of its items."""
    for child in read.children.values():
        if isinstance(read.schema, ListSchema) and read.notation is YamlNotation.FULL:
            yield read, child
        yield from _iter_items(child)


def _unread_members(old: TypedNode) -> list[TargetMember]:
    """Members that the reader could not read; they keep their position."""
    is_mapping = isinstance(old.node, YamlMapping)
    return [
        TargetMember(key=_key_text(old.node, index) if is_mapping else None, value=TargetKeep(), old_index=index)
        for index, child in enumerate(old.child_keys)
        if child is None or _value_of(old.children[child]) is None
    ]


def _merge_unread(members: Iterable[TargetMember], others: Iterable[TargetMember]) -> tuple[TargetMember, ...]:
    """Insert unread members after the members that precede them in the old text."""
    result = list(members)
    for other in others:
        assert other.old_index is not None
        before = [
            position
            for position, member in enumerate(result)
            if member.old_index is not None and member.old_index < other.old_index
        ]
        result.insert(max(before, key=lambda position: result[position].old_index or 0) + 1 if before else 0, other)
    return tuple(result)


def _insertion_index(key: KeySchema, members: list[TargetMember], schema: RecordSchema, order: dict[str, int]) -> int:
    """The position of a new key: after the last key that precedes it in the schema."""
    position = 0
    for index, member in enumerate(members):
        known = schema.find_key(member.key or "")
        name = (known.shorthand_for or known.name) if known else ""
        if name in order and order[name] < order[key.name]:
            position = index + 1
    return position


def _key_text(node: YamlNode, index: int | None) -> str:
    pairs = getattr(node, "pairs", ())
    key = pairs[index][0] if index is not None and index < len(pairs) else None
    return key.text if isinstance(key, YamlScalar) else ""


def _multiline_texts(data: FormatValue) -> set[str]:
    if isinstance(data, tuple):
        return set().union(*map(_multiline_texts, data))
    return {data} if isinstance(data, str) and "\n" in data else set()


def _flow_length(data: FormatValue) -> int:
    return sum(map(_flow_length, data)) + 2 if isinstance(data, tuple) else len(str(data))
