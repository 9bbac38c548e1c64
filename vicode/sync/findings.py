"""Describes edits of generated files as findings."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import zip_longest

from vicode.findings import DesignPath, Finding, FindingSubject, Note, SourceLocation, get_rule
from vicode.sync.file_edits import FileEdits
from vicode.sync.interpret import INTERPRETERS
from vicode.sync.region_merge import RegionEdit
from vicode.sync.same_code import find_tokens, plain_token

_APPLY = "apply the edit to the design with 'vicode sync'"
_CHOOSE = "keep this text with 'vicode sync --take file', or the text of the design with 'vicode sync --take design'"
_DROP = "move the edit to where it belongs, or drop it with 'vicode sync --take design'"
_OUTSIDE = "'vicode sync' lists the edits that the design can express; 'vicode sync --outside-regions' applies them"
_SHARED = "no design can contain the edit; 'vicode gen --force' overwrites it and keeps a copy as NAME.edited"
_UNKNOWN = "'vicode gen --force' overwrites it and keeps a copy as NAME.edited"


def describe_edits(edits: Iterable[FileEdits], display_folder: str = "") -> Iterator[Finding]:
    """One finding per edit."""
    for file in edits:
        yield from file.problems
        describer = _Describer(file, display_folder)
        yield from map(describer.describe_region, file.regions)
        if file.is_edited_outside:
            yield describer.describe_outside()


def describe_conflict(file: FileEdits, region: RegionEdit, path: DesignPath, display_folder: str = "") -> Finding:
    """A finding with the place of the code in the design, if the design has it."""
    return _Describer(file, display_folder).describe_conflict(region, path)


@dataclass(frozen=True, slots=True)
class _Describer:
    file: FileEdits
    folder: str

    def describe_region(self, region: RegionEdit) -> Finding:
        if region.is_conflict:
            return self.describe_conflict(region)
        return self._finding("G501", f"the code of region '{region.id}' was edited here", _APPLY, region.line)

    def describe_conflict(self, region: RegionEdit, path: DesignPath = ()) -> Finding:
        message = f"the code of region '{region.id}' was edited here"
        if not region.target:
            message += ", but the design has no such code any more"
            return self._finding("G504", message, _DROP, region.line)
        message += ", and the same lines in the design" if region.base is not None else " and in the design"
        return self._finding("G504", message, _CHOOSE, region.line, path)

    def describe_outside(self) -> Finding:
        if self.file.is_origin_known:
            fix = _OUTSIDE if self.file.component and self.file.language in INTERPRETERS else _SHARED
            return self._finding("G501", "this file was edited outside regions", fix, self._first_edited_line())
        message = "this file may have been edited outside regions: the generated text is not known"
        return self._finding("G501", message, _UNKNOWN, 1)

    def _first_edited_line(self) -> int:
        """The line of the first token of C++ that differs; 1 in other languages, whose files may be formatted."""
        if self.file.language != "cpp":
            return 1
        tokens = zip_longest(find_tokens(self.file.old), find_tokens(self.file.new or ""), fillvalue=("", 1))
        return next((own[1] for own, other in tokens if plain_token(own[0]) != plain_token(other[0])), 1)

    def _finding(self, code: str, message: str, fix: str, line: int, path: DesignPath = ()) -> Finding:
        name = f"{self.folder}/{self.file.path}" if self.folder else self.file.path
        subject = FindingSubject(component=self.file.component, path=path)
        return Finding(
            rule=get_rule(code),
            message=message,
            fix=fix,
            location=SourceLocation(file=name, line=line, column=1),
            notes=(Note(message="the design", subject=subject),) if path else (),
        )
