"""Separates the edits of a generated file outside regions from what changed in the design since.

An edited file is compared with what the design generates now. If the design has changed since the file was written, its
changes would look like edits that undo them. So the file is merged by lines with the text generated then and the text
generated now. Regions are replaced by those of the new text before, as `region_merge` handles them.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from vicode.model.merge import split_chunks
from vicode.regions import find_regions, get_comment_prefix
from vicode.sync.file_edits import FileEdits


@dataclass(frozen=True, slots=True, kw_only=True)
class OutsideConflict:
    """Lines outside regions that were changed in the file and, by the design, in the generated text.

    Attributes:
        line: Where they begin in the file.
        base: The lines as they were generated when the file was written, None if that is not known.
        file_text: The lines in the file.
        design_text: The lines generated now.
    """

    line: int
    base: str | None
    file_text: str
    design_text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RebasedFile:
    """The text generated now with the edits outside regions: lines, and conflicts between them."""

    parts: tuple[tuple[str, ...] | OutsideConflict, ...]

    @property
    def conflicts(self) -> tuple[OutsideConflict, ...]:
        return tuple(part for part in self.parts if isinstance(part, OutsideConflict))

    def resolve(self, choose: Callable[[OutsideConflict], str]) -> str:
        """The text with the chosen text of each conflict."""
        lines: list[str] = []
        for part in self.parts:
            if isinstance(part, OutsideConflict):
                text = choose(part)
                lines += text.split("\n") if text else []
            else:
                lines += part
        return "\n".join(lines)


def rebase_outside_edits(file: FileEdits, base: str | None) -> RebasedFile | None:
    """Return the text generated now with the edits outside regions.

    Args:
        file: The edited file.
        base: The text that was generated when the file was written, None if it is unknown.

    Returns:
        None if no design generates the file any more. Without a base, each difference is a conflict: it may be an edit
        of the file, or a change of the design since.
    """
    if file.new is None:
        return None
    new = file.new.split("\n")
    before = new if base is None else _with_regions_of(base, file.new, file.path)[0]
    edited, numbers = _with_regions_of(file.old, file.new, file.path)
    parts: list[tuple[str, ...] | OutsideConflict] = []
    at = 0
    for chunk in split_chunks(before, edited, new):
        lines = chunk.theirs if _is_layout(chunk.base, chunk.ours) else chunk.resolve()
        if lines is not None and (base is not None or lines == chunk.theirs):
            parts.append(tuple(lines))
        else:
            conflict = OutsideConflict(
                line=numbers[min(at, len(numbers) - 1)],
                base=None if base is None else "\n".join(chunk.base),
                file_text="\n".join(chunk.ours),
                design_text="\n".join(chunk.theirs),
            )
            parts.append(conflict)
        at += len(chunk.ours)
    return RebasedFile(parts=tuple(parts))


def _is_layout(base: Iterable[str], edited: Iterable[str]) -> bool:
    """Whether lines differ in spaces and quotes only, as after a formatter."""
    plain = ["".join("".join(lines).split()).replace("'", '"') for lines in (base, edited)]
    return plain[0] == plain[1]


def _with_regions_of(text: str, other: str, path: str) -> tuple[list[str], list[int]]:
    """The lines with the regions of another text, as only statements outside regions are compared, and their numbers
    in the text.
    """
    comment = get_comment_prefix(path)
    lines, others = text.replace("\r\n", "\n").split("\n"), other.split("\n")
    numbers = list(range(1, len(lines) + 1))
    blocks = {region.id: others[region.line - 1 : region.end_line] for region in find_regions(other, comment).regions}
    for region in reversed(find_regions(text, comment).regions):
        if region.id in blocks:
            lines[region.line - 1 : region.end_line] = blocks[region.id]
            numbers[region.line - 1 : region.end_line] = [region.line] * len(blocks[region.id])
    return lines, numbers
