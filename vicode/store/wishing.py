"""Spells a new value in the forms that the old text uses, so that only what differs is to be written."""

from collections.abc import Iterable
from typing import cast

from vicode.store.format import LINE
from vicode.store.matching import match_items, match_names
from vicode.store.nodes import Mapping, Node, Scalar
from vicode.store.reading import Form, Read
from vicode.store.shapes import Data, Key, Kind, Leaf, Listing, Pair, Record, Shape, Table
from vicode.store.wishes import Kept, Member, Members, Wish, Word


class Wishing:
    """Spells values against one old text."""

    def __init__(self, text: str, deepest: int = 0) -> None:
        """`text` holds the nodes of the old values; what lies `deepest` or deeper and differs is spelt anew."""
        self.text = text
        self.deepest = deepest
        self.depth = 0

    def wish(self, shape: Shape, data: Data, old: Read | None = None, *, in_flow: bool = False) -> Wish:
        """The wish for a value; `in_flow`: the old node stands inside brackets."""
        if old is not None and _value_of(old) == data:
            return Kept()
        if old is not None and (self.depth >= self.deepest or self._has_outgrown(old, data, in_flow=in_flow)):
            old = None
        in_flow = in_flow or (old is not None and not isinstance(old.node, Scalar) and old.node.flow)
        self.depth += 1
        wish = self._spelt(shape, data, old, in_flow=in_flow)
        self.depth -= 1
        return wish

    def _spelt(self, shape: Shape, data: Data, old: Read | None, *, in_flow: bool) -> Wish:
        match shape:
            case Leaf():
                return _word(shape, data)
            case Pair():
                return Members(members=_numbers(data), is_mapping=False, width=LINE)
            case Listing():
                return self._listing(shape, data, old, in_flow=in_flow)
            case Table():
                return self._table(shape, data, old, in_flow=in_flow)
            case Record():
                return self._record(shape, data, old, in_flow=in_flow)

    def _has_outgrown(self, old: Read, data: Data, *, in_flow: bool) -> bool:
        """Whether brackets no longer suit: a text of several lines came in, or the line became too long."""
        node = old.node
        if in_flow or isinstance(node, Scalar) or not node.flow or "#" in self.text[node.start : node.end]:
            return False
        before = _value_of(old)
        if _long_texts(data) - _long_texts(() if before is None else before):
            return True
        length = _length(data)
        return length > LINE and before is not None and length > _length(before)

    def _listing(self, shape: Listing, data: Data, old: Read | None, *, in_flow: bool) -> Wish:
        items = cast("tuple[Data, ...]", data)
        item_shape = shape.item()
        lone = _lone(shape, items)
        if lone is not None and (old is None or old.form is Form.LONE):
            inner = old.parts[0].parts[shape.lone] if old is not None and old.parts else None
            assert isinstance(item_shape, Record)
            key = item_shape.key(shape.lone)
            assert key is not None
            return self.wish(key.shape, lone, inner, in_flow=in_flow)
        if old is None or old.form is not Form.LONG:
            members = [Member(value=self.wish(item_shape, item)) for item in items]
            return Members(members=tuple(members), is_mapping=False, width=shape.width)
        numbers = {part: number for number, part in enumerate(old.members) if part is not None}
        known = [cast("Data", old.parts[part].value) for part in numbers]
        members = []
        for item, match in zip(items, match_items(known, items), strict=True):
            part = old.parts[match] if match is not None else None
            value = self.wish(item_shape, item, part, in_flow=in_flow)
            members.append(Member(value=value, old=numbers[match] if match is not None else None))
        with_others = _with_others(members, _unread(old))
        return Members(members=with_others, is_mapping=False, width=shape.width)

    def _table(self, shape: Table, data: Data, old: Read | None, *, in_flow: bool) -> Wish:
        pairs = cast("tuple[tuple[str, Data], ...]", data)
        _refuse_twins(pairs)
        fits_short = bool(shape.short) and [name for name, _value in pairs] == [shape.short]
        if fits_short and (old is None or old.form is Form.SHORT):
            inner = old.parts[shape.short] if old is not None else None
            return self.wish(shape.value, pairs[0][1], inner, in_flow=in_flow)
        fits_names = shape.names and bool(pairs) and not any(value for _name, value in pairs)
        if fits_names and (old is None or old.form is Form.NAMES):
            return self._names(shape, pairs, old)
        if old is None or old.form is not Form.LONG:
            members = [Member(key=name, value=self.wish(shape.value, value)) for name, value in pairs]
            return Members(members=tuple(members), is_mapping=True, width=shape.width)
        numbers = {part: number for number, part in enumerate(old.members) if part is not None}
        names = [str(part) for part in numbers]
        known = [(name, cast("Data", _value_of(old.parts[name]))) for name in names]
        members = []
        for (name, value), match in zip(pairs, match_names(known, pairs), strict=True):
            part = old.parts[names[match]] if match is not None else None
            wish = self.wish(shape.value, value, part, in_flow=in_flow)
            members.append(Member(key=name, value=wish, old=numbers[names[match]] if match is not None else None))
        others = [other for other in _unread(old) if _key_text(old.node, other.old) not in dict(pairs)]
        return Members(members=_with_others(members, others), is_mapping=True, width=shape.width)

    def _names(self, shape: Table, pairs: tuple[tuple[str, Data], ...], old: Read | None) -> Wish:
        numbers = {part: number for number, part in enumerate(old.members) if part is not None} if old else {}
        members = [
            Member(value=Kept() if name in numbers else Word(text=name), old=numbers.get(name))
            for name, _value in pairs
        ]
        return Members(members=tuple(members), is_mapping=False, width=shape.width)

    def _record(self, shape: Record, data: Data, old: Read | None, *, in_flow: bool) -> Wish:
        values = dict(cast("tuple[tuple[str, Data], ...]", data))
        short = shape.key(shape.short) if shape.short else None
        if short and _fits_short(short, values) and (old is None or old.form is Form.SHORT):
            inner = old.parts[short.name] if old is not None else None
            return self.wish(short.shape, values[short.name], inner, in_flow=in_flow)
        if old is None or old.form is not Form.LONG or isinstance(old.node, Scalar):
            members = [self._new_pair(shape, key, values[key.name]) for key in shape.keys if key.name in values]
            return Members(members=tuple(members), is_mapping=True, width=shape.width, is_ordered=False)
        return self._old_record(shape, values, old, in_flow=in_flow)

    def _old_record(self, shape: Record, values: dict[str, Data], old: Read, *, in_flow: bool) -> Wish:
        before = dict(cast("tuple[tuple[str, Data], ...]", old.value or ()))
        members: list[Member] = []
        written: set[str] = set()
        for number, part in enumerate(old.members):
            name = str(part) if part is not None else _key_text(old.node, number)
            key = shape.key(name)
            if key is not None and name in values and name not in written:
                written.add(name)
                members.append(self._old_pair(shape, key, values[name], old, number, in_flow=in_flow))
            elif part is None or name not in before:
                # Not understood, or saying what is meant anyway: not ours to take away.
                members.append(Member(key=_key_text(old.node, number), value=Kept(), old=number))
        order = {key.name: number for number, key in enumerate(shape.keys)}
        for name, value in values.items():
            if name not in written:
                key = shape.key(name)
                assert key is not None
                members.insert(_place_for(key, members, shape, order), self._new_pair(shape, key, value))
        return Members(members=tuple(members), is_mapping=True, width=shape.width, is_ordered=False)

    def _old_pair(self, shape: Record, key: Key, data: Data, old: Read, number: int, *, in_flow: bool) -> Member:
        written = _key_text(old.node, number)
        part = old.parts.get(key.name) if old.members[number] is not None else None
        stand_in = shape.key(written)
        if stand_in is not None and stand_in.stands_for and part is not None and _value_of(part) != data:
            assert isinstance(key.shape, Listing)
            if _lone(key.shape, cast("tuple[Data, ...]", data)) is None:
                return Member(key=key.name, value=self.wish(key.shape, data), old=number)
        return Member(key=written, value=self.wish(key.shape, data, part, in_flow=in_flow), old=number)

    def _new_pair(self, shape: Record, key: Key, data: Data) -> Member:
        stand_in = next((each for each in shape.keys if each.stands_for == key.name), None)
        name = key.name
        if stand_in is not None and isinstance(key.shape, Listing):
            name = stand_in.name if _lone(key.shape, cast("tuple[Data, ...]", data)) is not None else name
        return Member(key=name, value=self.wish(key.shape, data))


def number_text(number: float) -> str:
    """A number as people write it: 80 rather than 80.0."""
    return str(int(number)) if number == int(number) and abs(number) < 1e15 else repr(number)


def _value_of(read: Read) -> Data | None:
    # The empty value stands for a record or table that could not be read, as the reader has it.
    return () if read.value is None and isinstance(read.shape, Record | Table) else read.value


def _word(shape: Leaf, data: Data) -> Word:
    if isinstance(data, bool):
        return Word(text="true" if data else "false", bare=True)
    if isinstance(data, int | float):
        return Word(text=number_text(data), bare=True)
    assert isinstance(data, str)
    return Word(text=data, bare=shape.kind is Kind.VERSION)


def _numbers(data: Data) -> tuple[Member, ...]:
    numbers = cast("tuple[float, ...]", data)
    return tuple(Member(value=Word(text=number_text(number), bare=True), old=None) for number in numbers)


def _lone(shape: Listing, items: tuple[Data, ...]) -> Data | None:
    """What the one item holds, if the list may be written without its brackets and key."""
    if not shape.lone or len(items) != 1:
        return None
    pairs = cast("tuple[tuple[str, Data], ...]", items[0])
    if [name for name, _value in pairs] != [shape.lone]:
        return None
    texts = cast("tuple[tuple[str, str], ...]", pairs[0][1])
    is_blank = [name for name, _text in texts] == ["python"] and not texts[0][1].strip()
    return None if is_blank else pairs[0][1]


def _fits_short(short: Key, values: dict[str, Data]) -> bool:
    if list(values) != [short.name]:
        return False
    if isinstance(short.shape, Table):
        return short.name not in dict(cast("tuple[tuple[str, Data], ...]", values[short.name]))
    return True


def _refuse_twins(pairs: tuple[tuple[str, Data], ...]) -> None:
    names = [name for name, _value in pairs]
    twins = sorted({name for name in names if names.count(name) > 1}) if len(set(names)) < len(names) else []
    if twins:
        raise ValueError(f"two things named {', '.join(twins)} cannot be saved in one mapping")


def _unread(old: Read) -> list[Member]:
    """Members that the reader could not understand: they stay where they are."""
    is_mapping = isinstance(old.node, Mapping)
    return [
        Member(key=_key_text(old.node, number) if is_mapping else None, value=Kept(), old=number)
        for number, part in enumerate(old.members)
        if part is None
    ]


def _with_others(members: Iterable[Member], others: Iterable[Member]) -> tuple[Member, ...]:
    """Members with others put in after those that they followed in the old text."""
    result = list(members)
    for other in others:
        assert other.old is not None
        places = [place for place, each in enumerate(result) if each.old is not None and each.old < other.old]
        result.insert(max(places, key=lambda place: result[place].old or 0) + 1 if places else 0, other)
    return tuple(result)


def _place_for(key: Key, members: list[Member], shape: Record, order: dict[str, int]) -> int:
    """Where a new key goes: after the nearest one that the format shows before it."""
    place = 0
    for number, member in enumerate(members):
        known = shape.key(member.key or "")
        name = (known.stands_for or known.name) if known else ""
        if name in order and order[name] < order[key.name]:
            place = number + 1
    return place


def _key_text(node: Node, number: int | None) -> str:
    pairs = getattr(node, "pairs", ())
    key = pairs[number][0] if number is not None and number < len(pairs) else None
    return key.text if isinstance(key, Scalar) else ""


def _long_texts(data: Data) -> set[str]:
    if isinstance(data, tuple):
        return set().union(*map(_long_texts, data))
    return {data} if isinstance(data, str) and "\n" in data else set()


def _length(data: Data) -> int:
    return sum(map(_length, data)) + 2 if isinstance(data, tuple) else len(str(data))
