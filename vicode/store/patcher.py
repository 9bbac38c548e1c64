"""Changes a YAML text to a target value by replacing only the parts that differ.

The target names for each part the old node that it continues. Members that keep their order are patched in place, the
others are moved or inserted with whole lines. Edits are ranges of the old text that do not overlap; moved members are
patched by a patcher of their own. Layouts that the patcher cannot keep raise CannotPatchError, and `save` replaces a
larger part. It also reads the result, so an error here costs layout, not content.
"""

import re
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TypeGuard

from vicode.matching import find_unmoved
from vicode.store.member_spans import (
    MemberSpan,
    blank_lines_start,
    find_member_spans,
    line_end,
    line_start,
    next_line_start,
)
from vicode.store.target_tree import TargetCollection, TargetKeep, TargetMember, TargetNode, TargetScalar
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar, YamlSequence
from vicode.store.yaml_writer import (
    YamlStyle,
    format_block_text,
    format_flow,
    format_flow_member,
    format_inline_text,
    format_member,
    format_value,
)

_BEFORE_COMMENT = re.compile(r" +(?=#)")
_HEADER = re.compile(r"[|>][-+0-9]*")


class CannotPatchError(Exception):
    """The text has a form that cannot be patched; a larger part must be replaced."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueSlot:
    """The position of a value.

    Attributes:
        after: Offset after its colon or dash.
        column: Column of its member.
        end: End offset of the span of its member.
    """

    after: int
    column: int
    end: int
    is_item: bool = False
    in_flow: bool = False


@dataclass(slots=True, kw_only=True)
class Patcher:
    """Collects the edits of one text. The text must end with a line break and must not contain carriage returns."""

    text: str
    style: YamlStyle
    edits: list[tuple[int, int, str]] = field(default_factory=list)

    def patched_text(self, start: int = 0, end: int | None = None) -> str:
        """The text between two offsets with all edits applied."""
        parts: list[str] = []
        offset = start
        for first, last, new in sorted(self.edits, key=lambda edit: edit[:2]):
            if first < offset:
                raise CannotPatchError
            parts += [self.text[offset:first], new]
            offset = last
        return "".join([*parts, self.text[offset : len(self.text) if end is None else end]])

    def patch_value(self, node: YamlNode, target: TargetNode, slot: ValueSlot) -> None:
        if isinstance(target, TargetKeep):
            return
        if isinstance(target, TargetScalar) and isinstance(node, YamlScalar) and not node.is_empty:
            self._patch_scalar(node, target, slot)
        elif isinstance(target, TargetCollection) and _is_same_kind(node, target):
            self._patch_collection(node, target, slot)
        else:
            self._replace(node, target, slot)

    def patch_document(self, node: YamlNode, target: TargetNode) -> None:
        if not isinstance(target, TargetCollection) or not _is_same_kind(node, target):
            raise CannotPatchError
        self._patch_collection(node, target, None)

    def _add_edit(self, start: int, end: int, new: str) -> None:
        if self.text[start:end] != new:
            self.edits.append((start, end, new))

    def _patch_scalar(self, node: YamlScalar, target: TargetScalar, slot: ValueSlot) -> None:
        is_block = node.style in ("|", ">")
        if target.is_plain or not (is_block or "\n" in target.text):
            quote = node.style if node.style in ("'", '"') and not target.is_plain else ""
            new = target.text if target.is_plain else format_inline_text(target.text, in_flow=slot.in_flow, quote=quote)
            self._replace(node, target, slot) if is_block else self._replace_text(node, new, slot)
        elif slot.in_flow:
            self._add_edit(node.start, node.end, format_inline_text(target.text, in_flow=True, quote='"'))
        elif is_block:
            self._patch_block_scalar(node, target, slot)
        else:
            self._replace(node, target, slot)

    def _replace_text(self, node: YamlScalar, new: str, slot: ValueSlot) -> None:
        """Replace a text in its line; a comment after it keeps its column if possible."""
        spaces = _BEFORE_COMMENT.match(self.text, node.end)
        end, old = node.end, self.text[node.start : node.end]
        if spaces and not slot.in_flow and "\n" not in old and new != old:
            end = spaces.end()
            new += " " * max(min(2, end - node.end), end - node.start - len(new))
        self._add_edit(node.start, end, new)

    def _patch_block_scalar(self, node: YamlScalar, target: TargetScalar, slot: ValueSlot) -> None:
        """Replace the text of a block scalar and keep its indentation."""
        header_end = line_end(self.text, node.start)
        lines = self.text[next_line_start(self.text, node.start) : node.end].split("\n")
        first = next((line for line in lines if line.strip()), "")
        depth = len(first) - len(first.lstrip(" ")) - slot.column
        digit = re.match(r"[|>][-+]?(\d)", self.text[node.start : header_end])
        depth = int(digit.group(1)) if digit else depth
        new = format_block_text(target.text, depth, folded=node.style == ">") if 0 < depth < 10 else None
        if new is None or self.text[slot.after : node.start].strip(" "):
            self._replace(node, target, slot)
            return
        header, *body = new.split("\n")
        match = _HEADER.match(self.text, node.start, header_end)
        self._add_edit(node.start, match.end() if match else header_end, header)
        indented = "\n".join(" " * slot.column + line if line else "" for line in body)
        body_start = min(next_line_start(self.text, node.start), node.end)
        if node.end <= header_end:
            self.edits.append((header_end, header_end, "\n" + indented))
        else:
            self._add_edit(body_start, node.end, indented)

    def _replace(self, node: YamlNode, target: TargetNode, slot: ValueSlot) -> None:
        if slot.in_flow:
            self._replace_in_flow(node, target)
            return
        used = slot.after - line_start(self.text, slot.after) + 1
        new = format_value(target, slot.column, used, self.style, after_dash=slot.is_item)
        head, _, tail = new.partition("\n")
        is_block = (isinstance(node, YamlScalar) and node.style in ("|", ">")) or (
            not isinstance(node, YamlScalar) and not node.is_flow
        )
        if is_block:
            self._replace_block(node, head, tail, slot)
            return
        if "#" in self.text[slot.after : node.start]:
            raise CannotPatchError
        self._add_edit(slot.after, node.end, head)
        if tail:
            rest = line_end(self.text, node.end)
            self.edits.append((rest, rest, "\n" + tail))

    def _replace_in_flow(self, node: YamlNode, target: TargetNode) -> None:
        new = format_flow(target)
        if node.end > node.start:
            self._add_edit(node.start, node.end, new)
        else:
            colon = "" if self.text[: node.start].rstrip()[-1:] in (":", ",", "[") else ":"
            self.edits.append((node.start, node.start, f"{colon} {new}"))

    def _replace_block(self, node: YamlNode, head: str, tail: str, slot: ValueSlot) -> None:
        """Replace a value on separate lines; a comment after the key is kept."""
        header_end = line_end(self.text, slot.after)
        header = self.text[slot.after : header_end]
        comment_start = header.find(" #")
        if slot.is_item and not (isinstance(node, YamlScalar)) and node.start < header_end:
            comment_start = -1
        comment = f"  {header[comment_start:].strip()}" if comment_start >= 0 else ""
        new = head + comment + (f"\n{tail}" if tail else "")
        self._add_edit(slot.after, max(header_end, line_end(self.text, slot.end - 1)), new)

    def _patch_collection(
        self, node: YamlMapping | YamlSequence, target: TargetCollection, slot: ValueSlot | None
    ) -> None:
        count = len(node.pairs) if isinstance(node, YamlMapping) else len(node.items)
        order = [member.old_index for member in target.members]
        is_restructured = order != list(range(count))
        if node.is_flow:
            self._patch_flow(node, target, is_restructured=is_restructured)
            return
        limit = slot.end if slot is not None else len(self.text)
        spans = find_member_spans(self.text, node, slot.after if slot is not None else None, limit)
        if is_restructured:
            self._restructure(node, target, spans)
        else:
            for member in target.members:
                self._patch_member(node, member, spans)

    def _patch_member(self, node: YamlMapping | YamlSequence, member: TargetMember, spans: list[MemberSpan]) -> None:
        assert member.old_index is not None
        span = spans[member.old_index]
        column = spans[0].key_start - line_start(self.text, spans[0].key_start)
        if isinstance(node, YamlMapping):
            key, value = node.pairs[member.old_index]
            self._rename_key(key, member, in_flow=False)
            after = self._after_colon(key, value)
        else:
            value, after = node.items[member.old_index], span.key_start + 1
        is_item = isinstance(node, YamlSequence)
        self.patch_value(value, member.value, ValueSlot(after=after, column=column, end=span.end, is_item=is_item))

    def _after_colon(self, key: YamlNode, value: YamlNode) -> int:
        colon = self.text.find(":", key.end, max(value.start, key.end + 1) + 1)
        if colon < 0 or self.text[key.end : colon].strip():
            raise CannotPatchError
        return colon + 1

    def _rename_key(self, key: YamlNode, member: TargetMember, *, in_flow: bool) -> None:
        if isinstance(key, YamlScalar) and member.key is not None and member.key != key.text:
            quote = key.style if key.style in ("'", '"') else ""
            new = format_inline_text(member.key, in_flow=in_flow, quote=quote)
            self._add_edit(key.start, key.end, new)

    def _restructure(self, node: YamlMapping | YamlSequence, target: TargetCollection, spans: list[MemberSpan]) -> None:
        """Add, remove and move members with their lines."""
        unmoved = find_unmoved(member.old_index for member in target.members)
        used_indices = {member.old_index for member in target.members}
        column = spans[0].key_start - line_start(self.text, spans[0].key_start)
        spaced = self._is_spaced(spans)
        anchor = self._first_anchor(spans, min(unmoved), target)
        for member in target.members:
            if member.old_index in unmoved:
                self._patch_member(node, member, spans)
                anchor = max(anchor, spans[member.old_index].end)
                continue
            if member.old_index is None:
                new = format_member(member, column, self.style) + "\n"
            else:
                new = self._moved_text(node, member, spans)
            self.edits.append((anchor, anchor, self._with_blank_line(new, anchor, spans) if spaced else new))
        for index in set(range(len(spans))) - unmoved:
            is_last = not any(later in used_indices for later in range(index, len(spans)))
            self._remove(index, spans, is_last=is_last)

    def _first_anchor(self, spans: list[MemberSpan], first: int, target: TargetCollection) -> int:
        """Offset of the members that precede all unmoved ones."""
        span = spans[first]
        if not span.is_inline:
            return span.start
        if target.is_ordered:
            raise CannotPatchError
        return span.end

    def _moved_text(self, node: YamlMapping | YamlSequence, member: TargetMember, spans: list[MemberSpan]) -> str:
        assert member.old_index is not None
        span = spans[member.old_index]
        if span.is_inline:
            raise CannotPatchError
        inner = Patcher(text=self.text, style=self.style)
        inner._patch_member(node, member, spans)
        return inner.patched_text(span.start, span.end)

    def _is_spaced(self, spans: list[MemberSpan]) -> bool:
        gaps = [(left.end, right.start) for left, right in pairwise(spans)]
        return bool(gaps) and all(self._has_blank_line(start, end) for start, end in gaps)

    def _has_blank_line(self, start: int, end: int) -> bool:
        return any(not line.strip() for line in self.text[start:end].splitlines())

    def _with_blank_line(self, new: str, anchor: int, spans: list[MemberSpan]) -> str:
        return new + "\n" if anchor <= spans[0].start else "\n" + new

    def _remove(self, index: int, spans: list[MemberSpan], *, is_last: bool) -> None:
        span = spans[index]
        if span.is_inline:
            self._remove_inline(span, spans[index + 1])
            return
        start = span.start
        is_blank_below = span.end >= len(self.text) or not self.text[span.end : line_end(self.text, span.end)].strip()
        if index and (is_last or is_blank_below):
            start = max(blank_lines_start(self.text, start), spans[index - 1].end)
        self.edits.append((start, span.end, ""))

    def _remove_inline(self, span: MemberSpan, following: MemberSpan) -> None:
        """Remove the first member of a mapping that starts after a dash: the next member moves there."""
        if self.text[span.end : following.key_start].strip():
            self.edits.append((span.key_start, line_end(self.text, span.end - 1), ""))
        else:
            self.edits.append((span.key_start, following.key_start, ""))

    def _patch_flow(self, node: YamlMapping | YamlSequence, target: TargetCollection, *, is_restructured: bool) -> None:
        spans = _flow_spans(node)
        unmoved = find_unmoved(member.old_index for member in target.members)
        first = min(unmoved)
        anchor: int | None = None
        for member in target.members:
            if member.old_index in unmoved:
                self._patch_flow_member(node, member)
                anchor = spans[member.old_index][1]
                continue
            new = format_flow_member(member) if member.old_index is None else self._moved_flow_text(node, member, spans)
            if anchor is None:
                self.edits.append((spans[first][0], spans[first][0], f"{new}, "))
            else:
                self.edits.append((anchor, anchor, f", {new}"))
        if is_restructured:
            self._remove_in_flow(spans, unmoved)

    def _patch_flow_member(self, node: YamlMapping | YamlSequence, member: TargetMember) -> None:
        assert member.old_index is not None
        value = node.items[member.old_index] if isinstance(node, YamlSequence) else node.pairs[member.old_index][1]
        if isinstance(node, YamlMapping):
            self._rename_key(node.pairs[member.old_index][0], member, in_flow=True)
        self.patch_value(value, member.value, ValueSlot(after=value.start, column=0, end=value.end, in_flow=True))

    def _moved_flow_text(
        self, node: YamlMapping | YamlSequence, member: TargetMember, spans: list[tuple[int, int]]
    ) -> str:
        assert member.old_index is not None
        inner = Patcher(text=self.text, style=self.style)
        inner._patch_flow_member(node, member)
        return inner.patched_text(*spans[member.old_index])

    def _remove_in_flow(self, spans: list[tuple[int, int]], unmoved: set[int]) -> None:
        last = max(unmoved)
        for index, (start, end) in enumerate(spans):
            if index in unmoved or index > last:
                continue
            following = spans[index + 1][0]
            gap = self.text[end:following]
            self.edits.append((start, end + gap.index("\n") if "#" in gap and "\n" in gap else following, ""))
        if last + 1 < len(spans):
            start = spans[last][1]
            start = spans[last + 1][0] if "#" in self.text[start : spans[last + 1][0]] else start
            self.edits.append((start, spans[-1][1], ""))


def _is_same_kind(node: YamlNode, target: TargetCollection) -> TypeGuard[YamlMapping | YamlSequence]:
    if isinstance(node, YamlScalar) or isinstance(node, YamlMapping) != target.is_mapping:
        return False
    return any(member.old_index is not None for member in target.members)


def _flow_spans(node: YamlMapping | YamlSequence) -> list[tuple[int, int]]:
    if isinstance(node, YamlMapping):
        return [(key.start, max(key.end, value.end)) for key, value in node.pairs]
    return [(item.start, item.end) for item in node.items]
