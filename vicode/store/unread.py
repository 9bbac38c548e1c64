"""Finds the content of a file that the reader did not understand; no edit may lose it."""

from collections import Counter
from collections.abc import Iterator
from typing import cast

from vicode.findings import DesignPath
from vicode.store.schema_types import FormatValue, KeySchema, RecordSchema
from vicode.store.source_map import SourceMap
from vicode.store.typed_node import TypedNode
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar

_MAX_SHOWN = 60

UnreadMember = tuple[DesignPath, str]
"""The path of the parent, and the text."""


class UnreadContentError(ValueError):
    """An edit would remove content that was not understood."""


def find_unread(root: TypedNode, text: str) -> Counter[str]:
    """The members that were not understood, without their whitespace: unknown and duplicate keys, invalid values."""
    return Counter("".join(text[start:end].split()) for start, end in iter_unread_spans(root))


def require_unread(missing: Counter[str], root: TypedNode, text: str) -> None:
    """Raise the error that names the first missing member.

    Raises:
        UnreadContentError: A member is missing.
    """
    for start, end in iter_unread_spans(root):
        if "".join(text[start:end].split()) in missing:
            shown = " ".join(text[start:end].split())
            shown = shown if len(shown) <= _MAX_SHOWN else f"{shown[:_MAX_SHOWN]}…"
            line = text.count("\n", 0, start) + 1
            raise UnreadContentError(
                f"line {line}, '{shown}', was not understood and would be lost; correct or remove it in the file first"
            )


def list_unread(source: SourceMap) -> tuple[UnreadMember, ...]:
    """The members of a file that were not understood, each with the path of its parent."""
    if source.root is None:
        return ()
    text = source.line_index.text
    return tuple((path, text[start:end]) for path, (start, end) in _iter_unread(source.root, ()))


def iter_unread_spans(read: TypedNode) -> Iterator[tuple[int, int]]:
    """The offsets of the members that were not understood."""
    return (span for _path, span in _iter_unread(read, ()))


def _iter_unread(read: TypedNode, path: DesignPath) -> Iterator[tuple[DesignPath, tuple[int, int]]]:
    if not read.child_keys:
        for step, child in read.children.items():
            yield from _iter_unread(child, (*path, step))
        return
    for index, key in enumerate(read.child_keys):
        if _is_unread_member(read, index):
            yield path, _member_span(read.node, index)
        elif key is not None:
            yield from _iter_unread(read.children[key], (*path, key))


def _is_unread_member(read: TypedNode, index: int) -> bool:
    """Whether a member of a collection as a whole is not part of its value."""
    key = read.child_keys[index]
    if key is None:
        return not _is_omitted_key(read, index)
    child = read.children[key]
    if child.value is None:
        return not child.child_keys
    if not isinstance(read.schema, RecordSchema) or child.value in ("", (), False):
        return False
    known = cast("KeySchema", read.schema.find_key(str(key)))
    return child.value != known.default and str(key) not in dict(
        cast("tuple[tuple[str, FormatValue]]", read.value or ())
    )


def _is_omitted_key(read: TypedNode, index: int) -> bool:
    """Whether a member is a known key without a value."""
    if not isinstance(read.node, YamlMapping) or not isinstance(read.schema, RecordSchema):
        return False
    key, value = read.node.pairs[index]
    is_known = isinstance(key, YamlScalar) and read.schema.find_key(key.text) is not None
    return is_known and isinstance(value, YamlScalar) and value.is_empty


def _member_span(node: YamlNode, index: int) -> tuple[int, int]:
    if isinstance(node, YamlMapping):
        key, value = node.pairs[index]
        return key.start, max(key.end, value.end)
    assert not isinstance(node, YamlScalar)
    return node.items[index].start, node.items[index].end
