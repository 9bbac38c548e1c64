"""Makes a text say something else by replacing only what differs."""

import re
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TypeGuard

from vicode.store.emitting import Layout, block_text, flow_member, flow_text, member_text, text_in_line, value_text
from vicode.store.matching import rising
from vicode.store.nodes import Mapping, Node, Scalar, Sequence
from vicode.store.regions import Region, after_line, blank_lines_before, line_end, line_start, regions_of
from vicode.store.wishes import Kept, Member, Members, Wish, Word

_BEFORE_COMMENT = re.compile(r" +(?=#)")
_HEADER = re.compile(r"[|>][-+0-9]*")


class CannotPatchError(Exception):
    """The old text has a form that no replacement was thought of for; a larger piece must be written anew."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Slot:
    """Where a value stands: `after` its colon or dash, in the region of a member that begins in `column`."""

    after: int
    column: int
    end: int
    is_item: bool = False
    in_flow: bool = False


@dataclass(slots=True, kw_only=True)
class Patcher:
    """Collects the replacements of one text, which ends with a line break and has line feeds only."""

    text: str
    layout: Layout
    edits: list[tuple[int, int, str]] = field(default_factory=list)

    def result(self, start: int = 0, end: int | None = None) -> str:
        """The text between two offsets with all replacements made."""
        pieces: list[str] = []
        here = start
        for first, last, new in sorted(self.edits, key=lambda edit: edit[:2]):
            if first < here:
                raise CannotPatchError
            pieces += [self.text[here:first], new]
            here = last
        return "".join([*pieces, self.text[here : len(self.text) if end is None else end]])

    def value(self, node: Node, wish: Wish, slot: Slot) -> None:
        """Make a node say what is wished."""
        if isinstance(wish, Kept):
            return
        if isinstance(wish, Word) and isinstance(node, Scalar) and not node.is_empty:
            self._scalar(node, wish, slot)
        elif isinstance(wish, Members) and _is_same_kind(node, wish):
            self._collection(node, wish, slot)
        else:
            self._replace(node, wish, slot)

    def document(self, node: Node, wish: Wish) -> None:
        """Make the whole document say what is wished."""
        if not isinstance(wish, Members) or not _is_same_kind(node, wish):
            raise CannotPatchError
        self._collection(node, wish, None)

    def _replace_edit(self, start: int, end: int, new: str) -> None:
        if self.text[start:end] != new:
            self.edits.append((start, end, new))

    def _scalar(self, node: Scalar, wish: Word, slot: Slot) -> None:
        is_block = node.style in ("|", ">")
        if wish.bare or not (is_block or "\n" in wish.text):
            quote = node.style if node.style in ("'", '"') and not wish.bare else ""
            new = wish.text if wish.bare else text_in_line(wish.text, in_flow=slot.in_flow, quote=quote)
            self._replace(node, wish, slot) if is_block else self._replace_text(node, new, slot)
        elif slot.in_flow:
            self._replace_edit(node.start, node.end, text_in_line(wish.text, in_flow=True, quote='"'))
        elif is_block:
            self._block(node, wish, slot)
        else:
            self._replace(node, wish, slot)

    def _replace_text(self, node: Scalar, new: str, slot: Slot) -> None:
        """Another text in the same line; a comment beside it keeps its column where it can."""
        blanks = _BEFORE_COMMENT.match(self.text, node.end)
        end, old = node.end, self.text[node.start : node.end]
        if blanks and not slot.in_flow and "\n" not in old and new != old:
            end = blanks.end()
            new += " " * max(min(2, end - node.end), end - node.start - len(new))
        self._replace_edit(node.start, end, new)

    def _block(self, node: Scalar, wish: Word, slot: Slot) -> None:
        """Another text in the same block, as deep as the old one."""
        header_end = line_end(self.text, node.start)
        lines = self.text[after_line(self.text, node.start) : node.end].split("\n")
        first = next((line for line in lines if line.strip()), "")
        depth = len(first) - len(first.lstrip(" ")) - slot.column
        digit = re.match(r"[|>][-+]?(\d)", self.text[node.start : header_end])
        depth = int(digit.group(1)) if digit else depth
        new = block_text(wish.text, depth, folded=node.style == ">") if 0 < depth < 10 else None
        if new is None or self.text[slot.after : node.start].strip(" "):
            self._replace(node, wish, slot)
            return
        header, *body = new.split("\n")
        match = _HEADER.match(self.text, node.start, header_end)
        self._replace_edit(node.start, match.end() if match else header_end, header)
        indented = "\n".join(" " * slot.column + line if line else "" for line in body)
        body_start = min(after_line(self.text, node.start), node.end)
        if node.end <= header_end:
            self.edits.append((header_end, header_end, "\n" + indented))
        else:
            self._replace_edit(body_start, node.end, indented)

    def _replace(self, node: Node, wish: Wish, slot: Slot) -> None:
        """Write a value anew where an old one stands."""
        if slot.in_flow:
            self._replace_in_flow(node, wish)
            return
        used = slot.after - line_start(self.text, slot.after) + 1
        new = value_text(wish, slot.column, used, self.layout, after_dash=slot.is_item)
        head, _, tail = new.partition("\n")
        is_block = (isinstance(node, Scalar) and node.style in ("|", ">")) or (
            not isinstance(node, Scalar) and not node.flow
        )
        if is_block:
            self._replace_block(node, head, tail, slot)
            return
        if "#" in self.text[slot.after : node.start]:
            raise CannotPatchError
        self._replace_edit(slot.after, node.end, head)
        if tail:
            rest = line_end(self.text, node.end)
            self.edits.append((rest, rest, "\n" + tail))

    def _replace_in_flow(self, node: Node, wish: Wish) -> None:
        new = flow_text(wish)
        if node.end > node.start:
            self._replace_edit(node.start, node.end, new)
        else:
            colon = "" if self.text[: node.start].rstrip()[-1:] in (":", ",", "[") else ":"
            self.edits.append((node.start, node.start, f"{colon} {new}"))

    def _replace_block(self, node: Node, head: str, tail: str, slot: Slot) -> None:
        """The old value has lines of its own; a comment beside the key stays there."""
        header_end = line_end(self.text, slot.after)
        header = self.text[slot.after : header_end]
        hash_ = header.find(" #")
        if slot.is_item and not (isinstance(node, Scalar)) and node.start < header_end:
            hash_ = -1
        comment = f"  {header[hash_:].strip()}" if hash_ >= 0 else ""
        new = head + comment + (f"\n{tail}" if tail else "")
        self._replace_edit(slot.after, max(header_end, line_end(self.text, slot.end - 1)), new)

    def _collection(self, node: Mapping | Sequence, wish: Members, slot: Slot | None) -> None:
        count = len(node.pairs) if isinstance(node, Mapping) else len(node.items)
        order = [member.old for member in wish.members]
        is_restructured = order != list(range(count))
        if node.flow:
            self._flow(node, wish, is_restructured=is_restructured)
            return
        limit = slot.end if slot is not None else len(self.text)
        regions = regions_of(self.text, node, slot.after if slot is not None else None, limit)
        if is_restructured:
            self._restructure(node, wish, regions)
        else:
            for member in wish.members:
                self._member(node, member, regions)

    def _member(self, node: Mapping | Sequence, member: Member, regions: list[Region]) -> None:
        """What changes inside a member that stays."""
        assert member.old is not None
        region = regions[member.old]
        column = regions[0].first - line_start(self.text, regions[0].first)
        if isinstance(node, Mapping):
            key, value = node.pairs[member.old]
            self._rename(key, member, in_flow=False)
            after = self._after_colon(key, value)
        else:
            value, after = node.items[member.old], region.first + 1
        is_item = isinstance(node, Sequence)
        self.value(value, member.value, Slot(after=after, column=column, end=region.end, is_item=is_item))

    def _after_colon(self, key: Node, value: Node) -> int:
        colon = self.text.find(":", key.end, max(value.start, key.end + 1) + 1)
        if colon < 0 or self.text[key.end : colon].strip():
            raise CannotPatchError
        return colon + 1

    def _rename(self, key: Node, member: Member, *, in_flow: bool) -> None:
        if isinstance(key, Scalar) and member.key is not None and member.key != key.text:
            quote = key.style if key.style in ("'", '"') else ""
            new = text_in_line(member.key, in_flow=in_flow, quote=quote)
            self._replace_edit(key.start, key.end, new)

    def _restructure(self, node: Mapping | Sequence, wish: Members, regions: list[Region]) -> None:
        """Members come, go or move, with their lines."""
        staying = rising(member.old for member in wish.members if member.old is not None)
        wanted = {member.old for member in wish.members}
        column = regions[0].first - line_start(self.text, regions[0].first)
        spaced = self._is_spaced(regions)
        anchor = self._first_anchor(regions, min(staying), wish)
        for member in wish.members:
            if member.old in staying:
                self._member(node, member, regions)
                anchor = max(anchor, regions[member.old].end)
                continue
            if member.old is None:
                new = member_text(member, column, self.layout) + "\n"
            else:
                new = self._moved(node, member, regions)
            self.edits.append((anchor, anchor, self._with_blank_line(new, anchor, regions) if spaced else new))
        for number in set(range(len(regions))) - staying:
            is_last = not any(later in wanted for later in range(number, len(regions)))
            self._remove(number, regions, is_last=is_last)

    def _first_anchor(self, regions: list[Region], first: int, wish: Members) -> int:
        """Where a member goes that comes before all that stay."""
        region = regions[first]
        if not region.is_inline:
            return region.start
        if wish.is_ordered:
            raise CannotPatchError
        return region.end

    def _moved(self, node: Mapping | Sequence, member: Member, regions: list[Region]) -> str:
        assert member.old is not None
        region = regions[member.old]
        if region.is_inline:
            raise CannotPatchError
        inner = Patcher(text=self.text, layout=self.layout)
        inner._member(node, member, regions)
        return inner.result(region.start, region.end)

    def _is_spaced(self, regions: list[Region]) -> bool:
        gaps = [(left.end, right.start) for left, right in pairwise(regions)]
        return bool(gaps) and all(self._has_blank_line(start, end) for start, end in gaps)

    def _has_blank_line(self, start: int, end: int) -> bool:
        return any(not line.strip() for line in self.text[start:end].splitlines())

    def _with_blank_line(self, new: str, anchor: int, regions: list[Region]) -> str:
        return new + "\n" if anchor <= regions[0].start else "\n" + new

    def _remove(self, number: int, regions: list[Region], *, is_last: bool) -> None:
        region = regions[number]
        if region.is_inline:
            self._remove_inline(region, regions[number + 1])
            return
        start = region.start
        is_blank_below = (
            region.end >= len(self.text) or not self.text[region.end : line_end(self.text, region.end)].strip()
        )
        if number and (is_last or is_blank_below):
            start = max(blank_lines_before(self.text, start), regions[number - 1].end)
        self.edits.append((start, region.end, ""))

    def _remove_inline(self, region: Region, following: Region) -> None:
        """The first of a mapping that begins beside a dash: the next one takes its place there."""
        if self.text[region.end : following.first].strip():
            self.edits.append((region.first, line_end(self.text, region.end - 1), ""))
        else:
            self.edits.append((region.first, following.first, ""))

    def _flow(self, node: Mapping | Sequence, wish: Members, *, is_restructured: bool) -> None:
        spans = _flow_spans(node)
        staying = rising(member.old for member in wish.members if member.old is not None)
        first = min(staying)
        anchor: int | None = None
        for member in wish.members:
            if member.old in staying:
                self._flow_member(node, member)
                anchor = spans[member.old][1]
                continue
            new = flow_member(member) if member.old is None else self._moved_in_flow(node, member, spans)
            if anchor is None:
                self.edits.append((spans[first][0], spans[first][0], f"{new}, "))
            else:
                self.edits.append((anchor, anchor, f", {new}"))
        if is_restructured:
            self._remove_in_flow(spans, staying)

    def _flow_member(self, node: Mapping | Sequence, member: Member) -> None:
        assert member.old is not None
        value = node.items[member.old] if isinstance(node, Sequence) else node.pairs[member.old][1]
        if isinstance(node, Mapping):
            self._rename(node.pairs[member.old][0], member, in_flow=True)
        self.value(value, member.value, Slot(after=value.start, column=0, end=value.end, in_flow=True))

    def _moved_in_flow(self, node: Mapping | Sequence, member: Member, spans: list[tuple[int, int]]) -> str:
        assert member.old is not None
        inner = Patcher(text=self.text, layout=self.layout)
        inner._flow_member(node, member)
        return inner.result(*spans[member.old])

    def _remove_in_flow(self, spans: list[tuple[int, int]], staying: set[int]) -> None:
        last = max(staying)
        for number, (start, end) in enumerate(spans):
            if number in staying or number > last:
                continue
            following = spans[number + 1][0]
            gap = self.text[end:following]
            self.edits.append((start, end + gap.index("\n") if "#" in gap and "\n" in gap else following, ""))
        if last + 1 < len(spans):
            start = spans[last][1]
            start = spans[last + 1][0] if "#" in self.text[start : spans[last + 1][0]] else start
            self.edits.append((start, spans[-1][1], ""))


def _is_same_kind(node: Node, wish: Members) -> TypeGuard[Mapping | Sequence]:
    if isinstance(node, Scalar) or isinstance(node, Mapping) != wish.is_mapping:
        return False
    return any(member.old is not None for member in wish.members)


def _flow_spans(node: Mapping | Sequence) -> list[tuple[int, int]]:
    if isinstance(node, Mapping):
        return [(key.start, max(key.end, value.end)) for key, value in node.pairs]
    return [(item.start, item.end) for item in node.items]
