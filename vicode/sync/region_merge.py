"""Merges edited regions of a generated file with the code that the design has now.

A region may have changed in the file, in the design, or in both, and two texts cannot tell which. The third one is the
text that was generated when the file was written: the checksum in the mark of the region finds it, in the code of the
design now or in earlier generated texts. With it, the merge is one by lines; without it, a difference is a conflict.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from vicode.model.merge import merge_lines
from vicode.regions import Region, compute_checksum, is_edited
from vicode.sync.applied_edits import RecordedEdit
from vicode.sync.same_code import is_same_code


@dataclass(frozen=True, slots=True, kw_only=True)
class RegionEdit:
    """A region of a file that was edited and differs from the code of the design.

    Attributes:
        id: The region in the file, which begins at `line` and is indented by `indent`.
        checksum: The checksum in its mark.
        target: The region generated from the same code now, "" if the design has no such code any more.
        file_text: The text in the file.
        design_text: The text generated now, "" without target.
        base: The text that was generated when the file was written, None if it is unknown.
        merged: The text with the edits of both sides, None on a conflict.
    """

    id: str
    checksum: str
    line: int
    indent: str
    target: str
    file_text: str
    design_text: str
    base: str | None
    merged: str | None

    @property
    def is_conflict(self) -> bool:
        return self.merged is None

    @property
    def is_merged(self) -> bool:
        """Whether the design was changed as well, in other lines."""
        return self.merged is not None and self.merged != self.file_text


def record_edit(region: RegionEdit) -> RecordedEdit:
    """The record that the design contains an edit."""
    return RecordedEdit(checksum=region.checksum, file_text=region.file_text, design_text=region.design_text)


def merge_region_edits(
    found: Sequence[Region],
    generated: Sequence[Region],
    find_base: Callable[[str], str | None],
    find_applied: Callable[[str], RecordedEdit | None] = lambda _id: None,
    *,
    comment: str = "#",
) -> tuple[RegionEdit, ...]:
    """Return the edits in the regions of a file that the design does not have yet; layout alone is no edit.

    Args:
        found: The regions of the file.
        generated: The regions generated now.
        find_base: Returns a text that was generated earlier by its checksum, None if it is unknown.
        find_applied: Returns the edit of a region that the design contains already, by the id of the region.
        comment: The start of a comment in the language.
    """
    targets = _match_regions(found, generated)
    edits = []
    for region in filter(is_edited, found):
        target = targets.get(region.id)
        applied = _applicable(find_applied(region.id), region, target)
        edits.append(_merge(region, target, applied, find_base, comment))
    return tuple(edit for edit in edits if edit is not None)


def _applicable(applied: RecordedEdit | None, region: Region, target: Region | None) -> RecordedEdit | None:
    """A record of another generation does not apply, nor one of an edit that the design has lost since."""
    if applied is None or applied.checksum != region.checksum:
        return None
    text = target.body if target else ""
    is_lost = applied.design_text is not None and compute_checksum(applied.design_text) == compute_checksum(text)
    return None if is_lost else applied


def _merge(
    region: Region,
    target: Region | None,
    applied: RecordedEdit | None,
    find_base: Callable[[str], str | None],
    comment: str,
) -> RegionEdit | None:
    if target is not None and is_same_code(region.body, target.body, comment):
        return None
    is_current = target is not None and target.checksum == region.checksum
    if applied is not None:
        base: str | None = applied.file_text
    else:
        base = target.body if target is not None and is_current else find_base(region.checksum)
    if base is not None and is_same_code(region.body, base, comment):
        return None
    merged = None if target is None or base is None else merge_lines(base, region.body, target.body)
    return RegionEdit(
        id=region.id,
        checksum=region.checksum,
        line=region.line,
        indent=region.indent,
        target=target.id if target else "",
        file_text=region.body,
        design_text=target.body if target else "",
        base=base,
        merged=merged,
    )


def _match_regions(found: Iterable[Region], generated: Sequence[Region]) -> dict[str, Region]:
    """Match regions by id, and edited ones whose id is gone by the text that they were generated with.

    A state that was renamed in the design has regions with new ids and the same texts.
    """
    by_id = {region.id: region for region in generated}
    targets = {region.id: by_id[region.id] for region in found if region.id in by_id}
    present = {region.id for region in found}
    for region in found:
        if region.id in targets or not is_edited(region):
            continue
        candidates = [other for other in generated if other.checksum == region.checksum and other.id not in present]
        in_role = [other for other in candidates if _role(other.id) == _role(region.id)]
        best = in_role or candidates
        if len(best) == 1:
            targets[region.id] = best[0]
    return targets


def _role(id_: str) -> str:
    """The part of an id that does not depend on the name of the state: "enter", "actions", "to.Kick"."""
    return id_.partition(".")[2]
