"""Reads nodes as the shapes of the format say, with every mistake at its place; what can be kept is kept."""

import math
import re
from collections.abc import Mapping as MappingOf
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType

from vicode.findings import Path, did_you_mean
from vicode.store.format import VERSION
from vicode.store.lines import Report
from vicode.store.nodes import Mapping, Node, Scalar, Sequence
from vicode.store.shapes import Data, Key, Kind, Leaf, Listing, Pair, Record, Shape, Table, gather

_NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?\Z", re.ASCII)
_NOTHING = ("", "~", "null", "Null", "NULL")
_TRUTHS = {"true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}


class Form(StrEnum):
    """How a value was written."""

    LONG = "as the format has it"
    SHORT = "one key's value instead of a mapping"
    NAMES = "a list of names instead of a mapping"
    LONE = "one item's key instead of a list"


@dataclass(frozen=True, slots=True, kw_only=True)
class Read:
    """A node as it was understood.

    `value` is None when nothing could be made of it. `parts` are what it holds, by the words of paths. `members` are
    the keys of `parts` in the order of the node's own members, None for a member that was not understood.
    """

    shape: Shape
    node: Node
    value: Data | None
    key: Node | None = None
    form: Form = Form.LONG
    parts: "Parts" = field(default_factory=lambda: _NO_PARTS)
    members: tuple[str | int | None, ...] = ()


Parts = MappingOf[str | int, Read]
_NO_PARTS: Parts = MappingProxyType({})


class Reader:
    """Reads the nodes of one file."""

    def __init__(self, report: Report) -> None:
        """Mistakes go to `report`."""
        self.report = report

    def read(self, node: Node, shape: Shape, path: Path = (), key: Node | None = None) -> Read:
        """Read a node as a shape; `path` leads to it, `key` is the key it stands under."""
        if isinstance(node, Scalar) and node.refused:
            return Read(shape=shape, node=node, value=None, key=key)
        match shape:
            case Leaf():
                return Read(shape=shape, node=node, value=self._leaf(node, shape, path), key=key)
            case Pair():
                return Read(shape=shape, node=node, value=self._pair(node, shape, path), key=key)
            case Listing():
                return self._listing(node, shape, path, key)
            case Table():
                return self._table(node, shape, path, key)
            case Record():
                return self._record(node, shape, path, key)

    def _wrong(self, node: Node, message: str, path: Path, mend: str = "") -> None:
        self.report.add("Y103", message, _span(node), mend=mend, path=path)

    def _leaf(self, node: Node, shape: Leaf, path: Path) -> Data | None:
        if not isinstance(node, Scalar):
            mend = "put a text that begins with a bracket in quotes" if node.flow else ""
            self._wrong(node, f"expected {_wanted(shape)}, but this is {_kind_of(node)}", path, mend)
            return None
        match shape.kind:
            case Kind.TEXT:
                return node.text
            case Kind.NAME | Kind.EXPRESSION:
                return self._word(node, shape, path)
            case Kind.NUMBER:
                return self._number(node, path)
            case Kind.COUNT:
                return self._count(node, path)
            case Kind.FLAG | Kind.TRUE:
                return self._truth(node, shape, path)
            case Kind.VERSION:
                return self._version(node, path)

    def _word(self, node: Scalar, shape: Leaf, path: Path) -> Data | None:
        if not node.text.strip():
            what = "name" if shape.kind is Kind.NAME else "expression"
            self._wrong(node, f"the {what} is missing", path, "write one, or take the key away")
            return None
        if shape.choices and node.text not in shape.choices:
            mend = did_you_mean(node.text, shape.choices, f"write {' or '.join(shape.choices)}")
            self._wrong(node, f"'{_short(node.text)}' is not known here", path, mend)
            return None
        return node.text

    def _number(self, node: Scalar, path: Path) -> Data | None:
        number = _number_of(node)
        if number is None or number <= 0:
            self._wrong(node, f"expected a number greater than 0, but this is {_kind_of(node)}", path)
            return None
        return number

    def _count(self, node: Scalar, path: Path) -> Data | None:
        number = _number_of(node)
        if number is None or number < 0 or number != int(number):
            self._wrong(node, f"expected a whole number from 0 up, but this is {_kind_of(node)}", path)
            return None
        return number

    def _truth(self, node: Scalar, shape: Leaf, path: Path) -> Data | None:
        truth = None if node.style else _TRUTHS.get(node.text)
        if truth is None:
            self._wrong(node, f"expected true or false, but this is {_kind_of(node)}", path, "write true or false")
        elif shape.kind is Kind.TRUE and not truth:
            self._wrong(node, f"'{path[-1]}' can only be true", path, f"take '{path[-1]}' away")
            return None
        return truth

    def _version(self, node: Scalar, path: Path) -> Data | None:
        if node.style or node.text != VERSION:
            message = f"version {_short(node.text)!r} of the format is not known"
            mend = f"this vicode reads version {VERSION}: write 'vicode: {VERSION}', or use a newer vicode"
            self.report.add("Y109", message, _span(node), mend=mend, path=path)
            return None
        return VERSION

    def _pair(self, node: Node, shape: Pair, path: Path) -> Data | None:
        numbers = [_number_of(item) for item in node.items] if isinstance(node, Sequence) else []
        if len(numbers) != 2 or None in numbers:
            self._wrong(node, f"expected {shape.what}, two numbers", path, "write it like [80, 120]")
            return None
        return tuple(number for number in numbers if number is not None)

    def _listing(self, node: Node, shape: Listing, path: Path, key: Node | None) -> Read:
        if isinstance(node, Sequence):
            parts: dict[str | int, Read] = {}
            members: list[str | int | None] = []
            for item in node.items:
                read = self.read(item, shape.item(), (*path, len(parts)))
                members.append(None if read.value is None else len(parts))
                if read.value is not None:
                    parts[len(parts)] = read
            value = tuple(read.value for read in parts.values() if read.value is not None)
            return Read(shape=shape, node=node, value=value, key=key, parts=parts, members=tuple(members))
        item_shape = shape.item()
        if shape.lone and isinstance(item_shape, Record) and not self._is_item_alone(node, item_shape):
            return self._lone(node, shape, item_shape, path, key)
        mend = "begin each with '- '" if isinstance(node, Mapping) else "write it like [a, b]"
        self._wrong(node, f"expected {shape.what}, but this is {_kind_of(node)}", path, mend)
        return Read(shape=shape, node=node, value=None, key=key)

    def _is_item_alone(self, node: Node, item: Record) -> bool:
        keys = (
            {key.text for key, _value in node.pairs if isinstance(key, Scalar)} if isinstance(node, Mapping) else set()
        )
        return bool(keys & {key.name for key in item.keys})

    def _lone(self, node: Node, shape: Listing, item: Record, path: Path, key: Node | None) -> Read:
        lone = item.key(shape.lone)
        assert lone is not None, "the table names a key that the item does not have"
        if isinstance(node, Scalar) and not node.text.strip():
            return Read(shape=shape, node=node, value=(), key=key, form=Form.LONE)
        inner = self.read(node, lone.shape, (*path, 0, lone.name))
        if inner.value is None:
            return Read(shape=shape, node=node, value=None, key=key, form=Form.LONE)
        value = gather(item, {lone.name: inner.value})
        single = Read(shape=item, node=node, value=value, form=Form.SHORT, parts={lone.name: inner})
        return Read(shape=shape, node=node, value=(value,), key=key, form=Form.LONE, parts={0: single})

    def _table(self, node: Node, shape: Table, path: Path, key: Node | None) -> Read:
        if isinstance(node, Mapping):
            return self._long_table(node, shape, path, key)
        if isinstance(node, Sequence) and shape.names:
            return self._names(node, shape, path, key)
        if isinstance(node, Scalar) and shape.short:
            inner = self.read(node, shape.value, (*path, shape.short))
            value: Data | None = None if inner.value is None else ((shape.short, inner.value),)
            parts: dict[str | int, Read] = {shape.short: inner}
            return Read(shape=shape, node=node, value=value, key=key, form=Form.SHORT, parts=parts)
        if _is_nothing(node):
            return Read(shape=shape, node=node, value=(), key=key)
        mend = "write 'name: …' without '- '" if isinstance(node, Sequence) else ""
        self._wrong(node, f"expected {shape.what}, but this is {_kind_of(node)}", path, mend)
        return Read(shape=shape, node=node, value=None, key=key)

    def _long_table(self, node: Mapping, shape: Table, path: Path, key: Node | None) -> Read:
        parts: dict[str | int, Read] = {}
        members: list[str | int | None] = []
        for name, key_node, value in self._entries(node, path):
            members.append(None)
            if name is None or key_node is None:
                continue
            if shape.keys and name not in shape.keys:
                mend = did_you_mean(name, shape.keys, f"known are {', '.join(shape.keys)}")
                self.report.add(
                    "Y102", f"unknown key '{_short(name)}' in {shape.what}", _span(key_node), mend=mend, path=path
                )
                continue
            if shape.value == Leaf(kind=Kind.EXPRESSION) and _is_blank(value):
                # One that is not written yet is told by the rules, and kept, so that half a work can be saved.
                parts[name] = Read(shape=shape.value, node=value, value="", key=key_node)
            else:
                parts[name] = self.read(value, shape.value, (*path, name), key_node)
            members[-1] = name
        # A state that could not be read is still a state: only texts have no empty value to go on with.
        pairs = [(name, _or_empty(read)) for name, read in parts.items()]
        value_of = tuple((str(name), value) for name, value in pairs if value is not None)
        return Read(shape=shape, node=node, value=value_of, key=key, parts=parts, members=tuple(members))

    def _names(self, node: Sequence, shape: Table, path: Path, key: Node | None) -> Read:
        parts: dict[str | int, Read] = {}
        members: list[str | int | None] = []
        for item in node.items:
            members.append(None)
            name = self._leaf(item, Leaf(kind=Kind.NAME), path)
            if not isinstance(name, str):
                continue
            if name in parts:
                self.report.add(
                    "Y105", f"'{_short(name)}' is given twice", _span(item), mend="take one away", path=path
                )
                continue
            empty: Data = "" if isinstance(shape.value, Leaf) else ()
            parts[name] = Read(shape=shape.value, node=item, value=empty, key=item, form=Form.NAMES)
            members[-1] = name
        pairs = tuple((str(name), read.value) for name, read in parts.items() if read.value is not None)
        return Read(shape=shape, node=node, value=pairs, key=key, form=Form.NAMES, parts=parts, members=tuple(members))

    def _record(self, node: Node, shape: Record, path: Path, key: Node | None) -> Read:
        short = shape.key(shape.short) if shape.short else None
        if short and not _is_long(node, short) and not (isinstance(node, Scalar) and node.is_empty):
            inner = self.read(node, short.shape, (*path, short.name))
            value: Data | None = None if inner.value is None else gather(shape, {short.name: inner.value})
            parts: dict[str | int, Read] = {short.name: inner}
            return Read(shape=shape, node=node, value=value, key=key, form=Form.SHORT, parts=parts)
        if isinstance(node, Mapping):
            return self._long_record(node, shape, path, key)
        if _is_nothing(node):
            value = self._completed(node, shape, {}, path)
            return Read(shape=shape, node=node, value=value, key=key)
        mend = "write 'key: value' without '- '" if isinstance(node, Sequence) else ""
        self._wrong(node, f"expected {shape.what}, but this is {_kind_of(node)}", path, mend)
        return Read(shape=shape, node=node, value=None, key=key)

    def _long_record(self, node: Mapping, shape: Record, path: Path, key: Node | None) -> Read:
        parts: dict[str | int, Read] = {}
        members: list[str | int | None] = []
        for name, key_node, value in self._entries(node, path):
            members.append(None)
            known = shape.key(name) if name is not None else None
            if known is None and name is not None and key_node is not None:
                self._unknown_key(name, key_node, shape, path)
            if known is None or _is_left_out(value, known, shape):
                continue
            target = shape.key(known.stands_for) if known.stands_for else known
            assert target is not None, "the table names a key that the record does not have"
            if target.name in parts:
                other = "actions" if known.stands_for else "code"
                message = f"'{known.name}' and '{other}' exclude each other"
                self.report.add(
                    "Y111", message, _span(key_node or node), mend="put all of it into 'actions'", path=path
                )
                continue
            parts[target.name] = self.read(value, target.shape, (*path, target.name), key_node)
            members[-1] = target.name
        value_of = self._completed(node, shape, parts, path)
        return Read(shape=shape, node=node, value=value_of, key=key, parts=parts, members=tuple(members))

    def _completed(self, node: Node, shape: Record, parts: "dict[str | int, Read]", path: Path) -> Data | None:
        """The value of a record's parts, after a look at which keys must and must not come together."""
        for each in shape.keys:
            if each.required and each.name not in parts:
                example = VERSION if each.shape == Leaf(kind=Kind.VERSION) else "…"
                self._missing(node, f"{shape.name} has no '{each.name}'", f"add '{each.name}: {example}'", path)
        given = [str(name) for name in parts if name in shape.one_of]
        if shape.one_of and not given:
            self._missing(node, *shape.missing, path)
            return None
        for extra in given[1:]:
            message = f"'{given[0]}' and '{extra}' exclude each other"
            self.report.add("Y111", message, _span(parts[extra].key or node), mend=f"take '{extra}' away", path=path)
        values = {str(name): read.value for name, read in parts.items() if name not in given[1:]}
        for name, needed in shape.needs:
            if name in values and needed not in values and given:
                message = f"'{name}' belongs to '{needed}', not to '{given[0]}'"
                self.report.add("Y111", message, _span(parts[name].key or node), mend=f"take '{name}' away", path=path)
                del values[name]
        if given and values.get(given[0]) is None:
            return None
        return gather(shape, values)

    def _missing(self, node: Node, message: str, mend: str, path: Path) -> None:
        first = node.pairs[0][0] if isinstance(node, Mapping) and node.pairs and not node.flow else node
        self.report.add("Y104", message, _span(first), mend=mend, path=path)

    def _entries(self, node: Mapping, path: Path) -> list[tuple[str | None, Node | None, Node]]:
        """Name, key and value of every pair; no name for a key that is no text or was there before."""
        entries: list[tuple[str | None, Node | None, Node]] = []
        seen: dict[str, Node] = {}
        for key, value in node.pairs:
            if not isinstance(key, Scalar) or key.refused:
                if not isinstance(key, Scalar):
                    self._wrong(key, f"expected a key, but this is {_kind_of(key)}", path)
                entries.append((None, None, value))
            elif key.text in seen:
                note = ("first here", seen[key.text].start)
                message = f"'{_short(key.text)}' is given twice"
                self.report.add("Y105", message, _span(key), mend="take one away, or rename it", path=path, note=note)
                entries.append((None, key, value))
            else:
                seen[key.text] = key
                entries.append((key.text, key, value))
        return entries

    def _unknown_key(self, name: str, key: Node, shape: Record, path: Path) -> None:
        if self.report.is_full:
            return
        known = [each.name for each in shape.keys]
        meant = shape.meant.get(name)
        mend = f"did you mean '{meant}'?" if meant else did_you_mean(name, known, f"known are {', '.join(known)}")
        self.report.add("Y102", f"unknown key '{_short(name)}' in {shape.what}", _span(key), mend=mend, path=path)


def _is_long(node: Node, short: Key) -> bool:
    if not isinstance(node, Mapping):
        return False
    if not isinstance(short.shape, Table):
        return True
    names = {key.text: value for key, value in node.pairs if isinstance(key, Scalar)}
    return not isinstance(names.get(short.name, Scalar("", "", 0, 0)), Scalar)


def _is_left_out(value: Node, key: Key, record: Record) -> bool:
    """A key with nothing behind it counts as left out, unless that would be another guard or another item."""
    is_needed = key.name in record.one_of or key.shape == Leaf(kind=Kind.EXPRESSION)
    return isinstance(value, Scalar) and value.is_empty and not is_needed


def _is_nothing(node: Node) -> bool:
    return isinstance(node, Scalar) and not node.style and node.text in _NOTHING


def _is_blank(node: Node) -> bool:
    return isinstance(node, Scalar) and not node.refused and not node.text.strip()


def _or_empty(read: Read) -> Data | None:
    return () if read.value is None and isinstance(read.shape, Record | Table) else read.value


def _number_of(node: Node) -> float | None:
    if not isinstance(node, Scalar) or node.style or not _NUMBER.match(node.text):
        return None
    number = float(node.text)
    return number if math.isfinite(number) else None


def _span(node: Node) -> tuple[int, int]:
    return node.start, max(node.end, node.start + 1)


def _short(text: str) -> str:
    return text if len(text) <= 60 else text[:57] + "…"


def _wanted(shape: Leaf) -> str:
    return {Kind.TEXT: "a text", Kind.NAME: "a name", Kind.EXPRESSION: "an expression"}.get(
        shape.kind, f"{shape.kind.value}"
    )


def _kind_of(node: Node) -> str:
    if isinstance(node, Mapping):
        return "a mapping"
    if isinstance(node, Sequence):
        return "a list"
    return f"'{_short(node.text)}'" if node.text else "nothing"
