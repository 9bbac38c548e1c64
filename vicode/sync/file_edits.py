"""Finds the edits in generated files: in regions and outside regions."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

from vicode.findings import Finding, SourceLocation, get_rule
from vicode.model.merge import contains_edits
from vicode.output import FileDiff, FileStatus, OutputFile
from vicode.regions import ParsedRegions, Region, find_regions, get_comment_prefix, has_header, is_edited, strip_bodies
from vicode.sync.applied_edits import RecordedEdit, RegionKey
from vicode.sync.merge_markers import MergeConflict, find_merge_conflicts
from vicode.sync.region_merge import RegionEdit, merge_region_edits
from vicode.sync.same_code import is_same_code

History = Callable[[str], Iterable[str]]
"""Returns the texts that were generated for a path before, the last one first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FileEdits:
    """The edits in one generated file.

    Attributes:
        path: The file, relative to the folder of generated files.
        component: The component that the file is generated from, "" for a shared file.
        old: The text of the file.
        new: The text generated now, None if no design generates the file any more.
        regions: The edited regions.
        is_edited_outside: Whether the file was edited outside regions, or may have been.
        is_origin_known: Whether an earlier generated text of the file is known.
        merge_conflicts: The conflicts that git left in the file; nothing else of it is read then.
        problems: Errors in the file, such as broken marks.
    """

    path: str
    component: str
    old: str
    new: str | None
    regions: tuple[RegionEdit, ...] = ()
    is_edited_outside: bool = False
    is_origin_known: bool = True
    merge_conflicts: tuple[MergeConflict, ...] = ()
    problems: tuple[Finding, ...] = ()

    @property
    def language(self) -> str:
        return self.path.partition("/")[0]

    @property
    def is_empty(self) -> bool:
        return not (self.regions or self.is_edited_outside or self.merge_conflicts or self.problems)


def find_file_edits(
    differences: Iterable[FileDiff],
    files: Iterable[OutputFile],
    history: History = lambda _path: (),
    *,
    applied: Mapping[RegionKey, RecordedEdit | None] = MappingProxyType({}),
    display_folder: str = "",
) -> tuple[FileEdits, ...]:
    """Find the edits that generation would overwrite, by file; files without edits are left out.

    Args:
        differences: The files on disk and their new texts.
        files: The files that are generated now.
        history: Returns earlier generated texts.
        applied: The edits that the designs contain already.
        display_folder: The folder of the files as findings show it.
    """
    differences = tuple(differences)
    added = (difference for difference in differences if difference.status is FileStatus.NEW)
    finder = _EditFinder(
        components={file.path: file.component for file in files},
        added_regions=tuple(region for each in added for region in _regions(each.new or "", each.path)),
        history=history,
        applied=applied,
        display_folder=display_folder,
    )
    edits = (finder.find(each) for each in differences if each.old is not None and each.old != each.new)
    return tuple(each for each in edits if not each.is_empty)


@dataclass(frozen=True, slots=True, kw_only=True)
class _EditFinder:
    components: Mapping[str, str]
    added_regions: Sequence[Region]
    """The regions of new files, which may be those of a component that was renamed."""
    history: History
    applied: Mapping[RegionKey, RecordedEdit | None]
    display_folder: str

    def find(self, difference: FileDiff) -> FileEdits:
        path, old, new = difference.path, difference.old or "", difference.new
        file = f"{self.display_folder}/{path}" if self.display_folder else path
        edits = FileEdits(path=path, component=self.components.get(path, ""), old=old, new=new)
        comment = get_comment_prefix(path)
        if conflicts := find_merge_conflicts(old, new or "", comment):
            return replace(edits, merge_conflicts=conflicts)
        if not has_header(old):
            message = "this file was not generated; generation would replace it"
            fix = f"move it away, or generate with --force, which keeps it as {file.rpartition('/')[2]}.edited"
            location = SourceLocation(file=file, line=1, column=1)
            return replace(
                edits, problems=(Finding(rule=get_rule("G501"), message=message, fix=fix, location=location),)
            )
        parsed = find_regions(old, comment, file=file)
        if parsed.findings:
            return replace(edits, problems=parsed.findings)
        targets = _regions(new, path) if new is not None else self._renamed_regions(parsed)
        regions = merge_region_edits(
            parsed.regions,
            targets,
            _BaseTexts(path, old, self.history).find,
            lambda region: self.applied.get((path, region)),
            comment=comment,
        )
        is_outside = self._is_edited_outside(path, old, new)
        return replace(
            edits,
            regions=regions,
            is_edited_outside=is_outside,
            is_origin_known=not is_outside or any(True for _text in self.history(path)),
        )

    def _renamed_regions(self, parsed: ParsedRegions) -> tuple[Region, ...]:
        """The regions of new files with the same code as those of a file that no design generates any more."""
        checksums = {region.checksum for region in parsed.regions}
        return tuple(region for region in self.added_regions if region.checksum in checksums)

    def _is_edited_outside(self, path: str, old: str, new: str | None) -> bool:
        """Whether the file was edited outside regions, and not only the design."""
        comment = get_comment_prefix(path)
        if new is not None and is_same_code(old, new, comment):
            return False
        return not any(
            is_same_code(old, base, comment) or (new is not None and _has_all_edits(path, base, old, new))
            for base in self.history(path)
            if base != new
        )


class _BaseTexts:
    """Finds generated texts of regions by their checksum; the history is read when it is needed."""

    def __init__(self, path: str, text: str, history: History) -> None:
        self._path = path
        self._found: dict[str, str] = {}
        self._unread = (text for texts in ((text,), _later(history, path)) for text in texts)

    def find(self, checksum: str) -> str | None:
        while checksum not in self._found:
            text = next(self._unread, None)
            if text is None:
                return None
            regions = (region for region in _regions(text, self._path) if not is_edited(region))
            self._found |= {region.checksum: region.body for region in regions}
        return self._found[checksum]


def _later(history: History, path: str) -> Iterator[str]:
    yield from history(path)


def _has_all_edits(path: str, base: str, old: str, new: str) -> bool:
    """Whether the new text contains all that was changed in the old one outside regions, as after a merge in git."""
    comment = get_comment_prefix(path)
    stripped = [strip_bodies(text, comment) for text in (base, old, new)]
    return contains_edits(*stripped)


def _regions(text: str, path: str) -> tuple[Region, ...]:
    return find_regions(text, get_comment_prefix(path)).regions
