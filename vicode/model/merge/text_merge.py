"""Three-way merges of texts: by lines when two versions of a file meet, by characters when two people type."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher


@dataclass(frozen=True, slots=True, kw_only=True)
class _Chunk:
    """A run of the three texts that stands between two places where all of them agree."""

    base: Sequence[str]
    ours: Sequence[str]
    theirs: Sequence[str]

    def resolve(self) -> Sequence[str] | None:
        """What it becomes; None when both sides changed it, and differently."""
        if self.ours in (self.theirs, self.base):
            return self.theirs
        return self.ours if self.theirs == self.base else None


def merge_lines(base: str, ours: str, theirs: str) -> str | None:
    """Both changes, or None when they touch: the same line was changed, or two lines beside each other."""
    merged: list[str] = []
    for piece in _diff3_chunks(base.split("\n"), ours.split("\n"), theirs.split("\n")):
        lines = piece.resolve()
        if lines is None:
            return None
        merged += lines
    return "\n".join(merged)


def merge_characters(base: str, ours: str, theirs: str) -> str:
    """Both changes, to the character; where two people typed at one place, ours comes first and nothing is lost."""
    merged: list[str] = []
    for piece in _diff3_chunks(*(text.splitlines(keepends=True) for text in (base, ours, theirs))):
        settled = piece.resolve()
        merged += _merge_chunk_characters(piece) if settled is None else settled
    return "".join(merged)


def _merge_chunk_characters(lines: _Chunk) -> Iterator[str]:
    for piece in _diff3_chunks(*("".join(side) for side in (lines.base, lines.ours, lines.theirs))):
        settled = piece.resolve()
        yield from (*piece.ours, *piece.theirs) if settled is None else settled


def _diff3_chunks(base: Sequence[str], ours: Sequence[str], theirs: Sequence[str]) -> Iterator[_Chunk]:
    """The texts cut at every run that all three share, as in diff3 (Khanna, Kunal, Pierce: A Formal Investigation)."""
    at = (0, 0, 0)
    for begin, length in _common_runs(base, ours, theirs):
        yield _Chunk(
            base=base[at[0] : begin[0]],
            ours=ours[at[1] : begin[1]],
            theirs=theirs[at[2] : begin[2]],
        )
        at = (begin[0] + length, begin[1] + length, begin[2] + length)
        kept = base[begin[0] : at[0]]
        yield _Chunk(base=kept, ours=kept, theirs=kept)


def _common_runs(
    base: Sequence[str], ours: Sequence[str], theirs: Sequence[str]
) -> Iterator[tuple[tuple[int, int, int], int]]:
    """Where each run begins in the three texts, and how long it is; the last one is empty and at their ends."""
    in_ours = SequenceMatcher(None, base, ours, autojunk=False).get_matching_blocks()
    in_theirs = SequenceMatcher(None, base, theirs, autojunk=False).get_matching_blocks()
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
