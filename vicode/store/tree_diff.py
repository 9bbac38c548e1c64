"""Spells a new value in the forms that the old text uses, so that only what differs is to be written."""

from collections.abc import Iterable
from typing import cast

from vicode.store.format import FLOW_WIDTH
from vicode.store.matching import match_items, match_names
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
from vicode.store.target_tree import TargetCollection, TargetKeep, TargetMember, TargetNode, TargetScalar
from vicode.store.typed_node import TypedNode, YamlNotation
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar


class TargetBuilder:
    """Spells values against one old text."""

    def __init__(self, text: str, max_depth: int = 0) -> None:
        """`text` holds the nodes of the old values; what lies `max_depth` or deeper and differs is spelt anew."""
        self.text = text
        self.max_depth = max_depth
        self.depth = 0

    def build(
        self, shape: ValueSchema, data: FormatValue, old: TypedNode | None = None, *, in_flow: bool = False
    ) -> TargetNode:
        """The wish for a value; `in_flow`: the old node stands inside brackets."""
        if old is not None and _value_of(old) == data:
            return TargetKeep()
        if old is not None and (self.depth >= self.max_depth or self._outgrows_flow_style(old, data, in_flow=in_flow)):
            old = None
        in_flow = in_flow or (old is not None and not isinstance(old.node, YamlScalar) and old.node.is_flow)
        self.depth += 1
        wish = self._build_changed(shape, data, old, in_flow=in_flow)
        self.depth -= 1
        return wish

    def _build_changed(
        self, shape: ValueSchema, data: FormatValue, old: TypedNode | None, *, in_flow: bool
    ) -> TargetNode:
        match shape:
            case ScalarSchema():
                return _scalar_target(shape, data)
            case PairSchema():
                return TargetCollection(members=_number_members(data), is_mapping=False, flow_width=FLOW_WIDTH)
            case ListSchema():
                return self._build_list(shape, data, old, in_flow=in_flow)
            case MapSchema():
                return self._build_map(shape, data, old, in_flow=in_flow)
            case RecordSchema():
                return self._build_record(shape, data, old, in_flow=in_flow)

    def _outgrows_flow_style(self, old: TypedNode, data: FormatValue, *, in_flow: bool) -> bool:
        """Whether brackets no longer suit: a text of several lines came in, or the line became too long."""
        node = old.node
        if in_flow or isinstance(node, YamlScalar) or not node.is_flow or "#" in self.text[node.start : node.end]:
            return False
        before = _value_of(old)
        if _multiline_texts(data) - _multiline_texts(() if before is None else before):
            return True
        length = _flow_length(data)
        return length > FLOW_WIDTH and before is not None and length > _flow_length(before)

    def _build_list(self, shape: ListSchema, data: FormatValue, old: TypedNode | None, *, in_flow: bool) -> TargetNode:
        items = cast("tuple[FormatValue, ...]", data)
        item_shape = shape.item_schema()
        lone = _single_item_value(shape, items)
        if lone is not None and (old is None or old.notation is YamlNotation.SINGLE_ITEM):
            inner = old.children[0].children[shape.single_item_key] if old is not None and old.children else None
            assert isinstance(item_shape, RecordSchema)
            key = item_shape.find_key(shape.single_item_key)
            assert key is not None
            return self.build(key.schema, lone, inner, in_flow=in_flow)
        if old is None or old.notation is not YamlNotation.FULL:
            members = [TargetMember(value=self.build(item_shape, item)) for item in items]
            return TargetCollection(members=tuple(members), is_mapping=False, flow_width=shape.flow_width)
        numbers = {part: number for number, part in enumerate(old.child_keys) if part is not None}
        known = [cast("FormatValue", old.children[part].value) for part in numbers]
        members = []
        for item, match in zip(items, match_items(known, items), strict=True):
            part = old.children[match] if match is not None else None
            value = self.build(item_shape, item, part, in_flow=in_flow)
            members.append(TargetMember(value=value, old_index=numbers[match] if match is not None else None))
        with_others = _merge_unread(members, _unread_members(old))
        return TargetCollection(members=with_others, is_mapping=False, flow_width=shape.flow_width)

    def _build_map(self, shape: MapSchema, data: FormatValue, old: TypedNode | None, *, in_flow: bool) -> TargetNode:
        pairs = cast("tuple[tuple[str, FormatValue], ...]", data)
        _reject_duplicate_names(pairs)
        fits_short = bool(shape.shorthand_key) and [name for name, _value in pairs] == [shape.shorthand_key]
        if fits_short and (old is None or old.notation is YamlNotation.SHORTHAND):
            inner = old.children[shape.shorthand_key] if old is not None else None
            return self.build(shape.value_schema, pairs[0][1], inner, in_flow=in_flow)
        fits_names = shape.allows_name_list and bool(pairs) and not any(value for _name, value in pairs)
        if fits_names and (old is None or old.notation is YamlNotation.NAME_LIST):
            return self._build_name_list(shape, pairs, old)
        if old is None or old.notation is not YamlNotation.FULL:
            members = [TargetMember(key=name, value=self.build(shape.value_schema, value)) for name, value in pairs]
            return TargetCollection(members=tuple(members), is_mapping=True, flow_width=shape.flow_width)
        numbers = {part: number for number, part in enumerate(old.child_keys) if part is not None}
        names = [str(part) for part in numbers]
        known = [(name, cast("FormatValue", _value_of(old.children[name]))) for name in names]
        members = []
        for (name, value), match in zip(pairs, match_names(known, pairs), strict=True):
            part = old.children[names[match]] if match is not None else None
            wish = self.build(shape.value_schema, value, part, in_flow=in_flow)
            members.append(
                TargetMember(key=name, value=wish, old_index=numbers[names[match]] if match is not None else None)
            )
        others = [other for other in _unread_members(old) if _key_text(old.node, other.old_index) not in dict(pairs)]
        return TargetCollection(members=_merge_unread(members, others), is_mapping=True, flow_width=shape.flow_width)

    def _build_name_list(
        self, shape: MapSchema, pairs: tuple[tuple[str, FormatValue], ...], old: TypedNode | None
    ) -> TargetNode:
        numbers = {part: number for number, part in enumerate(old.child_keys) if part is not None} if old else {}
        members = [
            TargetMember(
                value=TargetKeep() if name in numbers else TargetScalar(text=name), old_index=numbers.get(name)
            )
            for name, _value in pairs
        ]
        return TargetCollection(members=tuple(members), is_mapping=False, flow_width=shape.flow_width)

    def _build_record(
        self, shape: RecordSchema, data: FormatValue, old: TypedNode | None, *, in_flow: bool
    ) -> TargetNode:
        values = dict(cast("tuple[tuple[str, FormatValue], ...]", data))
        short = shape.find_key(shape.shorthand_key) if shape.shorthand_key else None
        if short and _fits_shorthand(short, values) and (old is None or old.notation is YamlNotation.SHORTHAND):
            inner = old.children[short.name] if old is not None else None
            return self.build(short.schema, values[short.name], inner, in_flow=in_flow)
        if old is None or old.notation is not YamlNotation.FULL or isinstance(old.node, YamlScalar):
            members = [self._new_pair(shape, key, values[key.name]) for key in shape.keys if key.name in values]
            return TargetCollection(
                members=tuple(members), is_mapping=True, flow_width=shape.flow_width, is_ordered=False
            )
        return self._update_record(shape, values, old, in_flow=in_flow)

    def _update_record(
        self, shape: RecordSchema, values: dict[str, FormatValue], old: TypedNode, *, in_flow: bool
    ) -> TargetNode:
        before = dict(cast("tuple[tuple[str, FormatValue], ...]", old.value or ()))
        members: list[TargetMember] = []
        written: set[str] = set()
        for number, part in enumerate(old.child_keys):
            name = str(part) if part is not None else _key_text(old.node, number)
            key = shape.find_key(name)
            if key is not None and name in values and name not in written:
                written.add(name)
                members.append(self._update_pair(shape, key, values[name], old, number, in_flow=in_flow))
            elif part is None or name not in before:
                # Not understood, or saying what is meant anyway: not ours to take away.
                members.append(TargetMember(key=_key_text(old.node, number), value=TargetKeep(), old_index=number))
        order = {key.name: number for number, key in enumerate(shape.keys)}
        for name, value in values.items():
            if name not in written:
                key = shape.find_key(name)
                assert key is not None
                members.insert(_insertion_index(key, members, shape, order), self._new_pair(shape, key, value))
        return TargetCollection(members=tuple(members), is_mapping=True, flow_width=shape.flow_width, is_ordered=False)

    def _update_pair(
        self, shape: RecordSchema, key: KeySchema, data: FormatValue, old: TypedNode, number: int, *, in_flow: bool
    ) -> TargetMember:
        written = _key_text(old.node, number)
        part = old.children.get(key.name) if old.child_keys[number] is not None else None
        stand_in = shape.find_key(written)
        if stand_in is not None and stand_in.shorthand_for and part is not None and _value_of(part) != data:
            assert isinstance(key.schema, ListSchema)
            if _single_item_value(key.schema, cast("tuple[FormatValue, ...]", data)) is None:
                return TargetMember(key=key.name, value=self.build(key.schema, data), old_index=number)
        return TargetMember(key=written, value=self.build(key.schema, data, part, in_flow=in_flow), old_index=number)

    def _new_pair(self, shape: RecordSchema, key: KeySchema, data: FormatValue) -> TargetMember:
        stand_in = next((each for each in shape.keys if each.shorthand_for == key.name), None)
        name = key.name
        if stand_in is not None and isinstance(key.schema, ListSchema):
            name = (
                stand_in.name
                if _single_item_value(key.schema, cast("tuple[FormatValue, ...]", data)) is not None
                else name
            )
        return TargetMember(key=name, value=self.build(key.schema, data))


def format_number(number: float) -> str:
    """A number as people write it: 80 rather than 80.0."""
    return str(int(number)) if number == int(number) and abs(number) < 1e15 else repr(number)


def _value_of(read: TypedNode) -> FormatValue | None:
    # The empty value stands for a record or table that could not be read, as the reader has it.
    return () if read.value is None and isinstance(read.schema, RecordSchema | MapSchema) else read.value


def _scalar_target(shape: ScalarSchema, data: FormatValue) -> TargetScalar:
    if isinstance(data, bool):
        return TargetScalar(text="true" if data else "false", is_plain=True)
    if isinstance(data, int | float):
        return TargetScalar(text=format_number(data), is_plain=True)
    assert isinstance(data, str)
    return TargetScalar(text=data, is_plain=shape.scalar_type is ScalarType.VERSION)


def _number_members(data: FormatValue) -> tuple[TargetMember, ...]:
    numbers = cast("tuple[float, ...]", data)
    return tuple(
        TargetMember(value=TargetScalar(text=format_number(number), is_plain=True), old_index=None)
        for number in numbers
    )


def _single_item_value(shape: ListSchema, items: tuple[FormatValue, ...]) -> FormatValue | None:
    """What the one item holds, if the list may be written without its brackets and key."""
    if not shape.single_item_key or len(items) != 1:
        return None
    pairs = cast("tuple[tuple[str, FormatValue], ...]", items[0])
    if [name for name, _value in pairs] != [shape.single_item_key]:
        return None
    texts = cast("tuple[tuple[str, str], ...]", pairs[0][1])
    is_blank = [name for name, _text in texts] == ["python"] and not texts[0][1].strip()
    return None if is_blank else pairs[0][1]


def _fits_shorthand(short: KeySchema, values: dict[str, FormatValue]) -> bool:
    if list(values) != [short.name]:
        return False
    if isinstance(short.schema, MapSchema):
        return short.name not in dict(cast("tuple[tuple[str, FormatValue], ...]", values[short.name]))
    return True


def _reject_duplicate_names(pairs: tuple[tuple[str, FormatValue], ...]) -> None:
    names = [name for name, _value in pairs]
    twins = sorted({name for name in names if names.count(name) > 1}) if len(set(names)) < len(names) else []
    if twins:
        raise ValueError(f"two things named {', '.join(twins)} cannot be saved in one mapping")


def _unread_members(old: TypedNode) -> list[TargetMember]:
    """Members that the reader could not understand: they stay where they are."""
    is_mapping = isinstance(old.node, YamlMapping)
    return [
        TargetMember(key=_key_text(old.node, number) if is_mapping else None, value=TargetKeep(), old_index=number)
        for number, part in enumerate(old.child_keys)
        if part is None
    ]


def _merge_unread(members: Iterable[TargetMember], others: Iterable[TargetMember]) -> tuple[TargetMember, ...]:
    """Members with others put in after those that they followed in the old text."""
    result = list(members)
    for other in others:
        assert other.old_index is not None
        places = [
            place
            for place, each in enumerate(result)
            if each.old_index is not None and each.old_index < other.old_index
        ]
        result.insert(max(places, key=lambda place: result[place].old_index or 0) + 1 if places else 0, other)
    return tuple(result)


def _insertion_index(key: KeySchema, members: list[TargetMember], shape: RecordSchema, order: dict[str, int]) -> int:
    """Where a new key goes: after the nearest one that the format shows before it."""
    place = 0
    for number, member in enumerate(members):
        known = shape.find_key(member.key or "")
        name = (known.shorthand_for or known.name) if known else ""
        if name in order and order[name] < order[key.name]:
            place = number + 1
    return place


def _key_text(node: YamlNode, number: int | None) -> str:
    pairs = getattr(node, "pairs", ())
    key = pairs[number][0] if number is not None and number < len(pairs) else None
    return key.text if isinstance(key, YamlScalar) else ""


def _multiline_texts(data: FormatValue) -> set[str]:
    if isinstance(data, tuple):
        return set().union(*map(_multiline_texts, data))
    return {data} if isinstance(data, str) and "\n" in data else set()


def _flow_length(data: FormatValue) -> int:
    return sum(map(_flow_length, data)) + 2 if isinstance(data, tuple) else len(str(data))
