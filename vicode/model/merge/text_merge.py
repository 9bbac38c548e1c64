"""Three-way merges of texts: by lines, for versions of a file."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import Match, SequenceMatcher


@dataclass(frozen=True, slots=True, kw_only=True)
class MergeChunk:
    """Corresponding parts of the three texts."""

    base: Sequence[str]
    ours: Sequence[str]
    theirs: Sequence[str]

    @property
    def contains_ours(self) -> bool:
        base, ours, theirs = Counter(self.base), Counter(self.ours), Counter(self.theirs)
        return ours - base <= theirs and not (base - ours) & (theirs - ours)

    def resolve(self) -> Sequence[str] | None:
        """Return the merged part, None if both sides changed it differently."""
        if self.ours in (self.theirs, self.base):
            return self.theirs
        return self.ours if self.theirs == self.base else None


def merge_lines(base: str, ours: str, theirs: str) -> str | None:
    """Merge by lines. Return None if both sides changed the same or adjacent lines."""
    if base in (ours, theirs):
        return theirs if base == ours else ours
    merged: list[str] = []
    for chunk in split_chunks(base.split("\n"), ours.split("\n"), theirs.split("\n")):
        lines = chunk.resolve()
        if lines is None:
            return None
        merged += lines
    return "\n".join(merged)


def split_chunks(base: Sequence[str], ours: Sequence[str], theirs: Sequence[str]) -> Iterator[MergeChunk]:
    """Split the texts at common runs, as in Khanna, Kunal, Pierce: A Formal Investigation of Diff3."""
    at = (0, 0, 0)
    for begin, length in _common_runs(base, ours, theirs):
        yield MergeChunk(
            base=base[at[0] : begin[0]],
            ours=ours[at[1] : begin[1]],
            theirs=theirs[at[2] : begin[2]],
        )
        at = (begin[0] + length, begin[1] + length, begin[2] + length)
        kept = base[begin[0] : at[0]]
        yield MergeChunk(base=kept, ours=kept, theirs=kept)


def contains_edits(base: str, ours: str, theirs: str) -> bool:
    """Whether `theirs` contains all edits of `ours`, and perhaps more."""
    if base in (ours, theirs):
        return base == ours
    return all(chunk.contains_ours for chunk in split_chunks(base.split("\n"), ours.split("\n"), theirs.split("\n")))


def merge_texts(base: str, ours: str, theirs: str, *, keeps_theirs: bool) -> str:
    """Merge by lines; changes of neighboring lines do not conflict.

    Where both sides changed the same lines, ours are kept, and theirs after them if `keeps_theirs`.
    """
    lines, mine, yours = (text.splitlines(keepends=True) for text in (base, ours, theirs))
    merged: list[str] = []
    offset = 0
    for our_edits, their_edits in _group_edits(_line_edits(lines, mine), _line_edits(lines, yours)):
        edits = (*our_edits, *their_edits)
        start, end = min(edit[0] for edit in edits), max(edit[1] for edit in edits)
        sides = [_apply_edits(lines, side, start, end) for side in (our_edits, their_edits) if side]
        merged += lines[offset:start] + sides[0]
        merged += sides[-1] if keeps_theirs and sides[-1] != sides[0] else []
        offset = end
    return "".join([*merged, *lines[offset:]])


def _common_runs(
    base: Sequence[str], ours: Sequence[str], theirs: Sequence[str]
) -> Iterator[tuple[tuple[int, int, int], int]]:
    """Yield the start of each common run in the three texts and its length. The last run is empty, at the ends."""
    in_ours, in_theirs = _matching_blocks(base, ours), _matching_blocks(base, theirs)
    mine = yours = 0
    while mine < len(in_ours) and yours < len(in_theirs):
        one, other = in_ours[mine], in_theirs[yours]
        begin, end = max(one.a, other.a), min(one.a + one.size, other.a + other.size)
        if begin < end:
            yield (begin, one.b + begin - one.a, other.b + begin - other.a), end - begin
        if one.a + one.size < other.a + other.size:
            mine += 1
        else:
            yours += 1
    yield (len(base), len(ours), len(theirs)), 0


def _matching_blocks(a: Sequence[str], b: Sequence[str]) -> list[Match]:
    """Return the common blocks; equal starts and ends need no search."""
    shorter = min(len(a), len(b))
    start = next((at for at in range(shorter) if a[at] != b[at]), shorter)
    end = next((at for at in range(shorter - start) if a[-1 - at] != b[-1 - at]), shorter - start)
    matcher = SequenceMatcher(None, a[start : len(a) - end], b[start : len(b) - end], autojunk=False)
    inner = (Match(one + start, other + start, size) for one, other, size in matcher.get_matching_blocks() if size)
    ends = (Match(0, 0, start), *inner, Match(len(a) - end, len(b) - end, end))
    return [*(block for block in ends if block.size), Match(len(a), len(b), 0)]


_Edit = tuple[int, int, list[str]]
"""Start and end of the replaced lines of the base, and the new lines."""


def _line_edits(base: list[str], side: list[str]) -> list[_Edit]:
    opcodes = SequenceMatcher(None, base, side, autojunk=False).get_opcodes()
    return [(start, end, side[first:last]) for tag, start, end, first, last in opcodes if tag != "equal"]


def _group_edits(ours: list[_Edit], theirs: list[_Edit]) -> list[tuple[list[_Edit], list[_Edit]]]:
    """The edits in order; those that overlap are one group."""
    groups: list[tuple[list[_Edit], list[_Edit]]] = []
    start, end = -1, -1
    sided = [*((edit, 0) for edit in ours), *((edit, 1) for edit in theirs)]
    for edit, side in sorted(sided, key=lambda pair: (pair[0][:2], pair[1])):
        if edit[0] >= end and edit[:2] != (start, end):
            groups.append(([], []))
            start, end = edit[:2]
        groups[-1][side].append(edit)
        end = max(end, edit[1])
    return groups


def _apply_edits(base: list[str], edits: list[_Edit], start: int, end: int) -> list[str]:
    """The lines from `start` to `end` after some edits."""
    lines: list[str] = []
    for first, last, new in edits:
        lines += base[start:first] + new
        start = last
    return lines + base[start:end]
