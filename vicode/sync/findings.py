"""Describes edits of generated files as findings."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import zip_longest

from vicode.findings import DesignPath, Finding, FindingSubject, Note, SourceLocation, get_rule
from vicode.sync.file_edits import FileEdits
from vicode.sync.merge_markers import MergeConflict
from vicode.sync.outside_edits import OutsideConflict
from vicode.sync.region_merge import RegionEdit
from vicode.sync.same_code import find_tokens, plain_token

_APPLY = "apply the edit to the design with 'vicode sync'"
_CHOOSE = (
    "keep this text with 'vicode sync{options} --take file', or the text of the design with 'vicode sync{options} "
    "--take design'; for this conflict only, use '--take file={item}'"
)
_DROP = "move the edit to where it belongs, or drop it with 'vicode sync --take design', which keeps a copy"
_OUTSIDE = "'vicode sync' lists the edits that the design can express; 'vicode sync --outside-regions' applies them"
_SHARED = "no design can contain the edit; 'vicode gen --force' overwrites it and keeps a copy as NAME.edited"
_DECLARED = "make the same change in project.yaml; 'vicode gen --force' drops this one and keeps a copy as NAME.edited"
_DECLARATIONS = "/declarations.py"
_UNKNOWN = "'vicode gen --force' overwrites it and keeps a copy as NAME.edited"
_RESOLVE = "keep one side or combine them, remove the markers, and run 'vicode sync'"


def describe_edits(edits: Iterable[FileEdits], display_folder: str = "") -> Iterator[Finding]:
    """One finding per edit."""
    for file in edits:
        yield from describe_problems(file, display_folder)
        describer = _Describer(file, display_folder)
        yield from map(describer.describe_region, file.regions)
        if file.is_edited_outside:
            yield describer.describe_outside()


def describe_problems(file: FileEdits, display_folder: str = "") -> Iterator[Finding]:
    """Why a file cannot be read."""
    yield from file.problems
    yield from map(_Describer(file, display_folder).describe_merge_conflict, file.merge_conflicts)


def describe_conflict(file: FileEdits, region: RegionEdit, path: DesignPath, display_folder: str = "") -> Finding:
    """A finding with the place of the code in the design, if the design has it."""
    return _Describer(file, display_folder).describe_conflict(region, path)


def describe_outside_conflict(file: FileEdits, conflict: OutsideConflict, display_folder: str = "") -> Finding:
    """A finding at the edited lines."""
    return _Describer(file, display_folder).describe_outside_conflict(conflict)


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
            message += ", but the design no longer contains this code"
            return self._finding("G504", message, _DROP, region.line)
        message += ", and the same lines in the design" if region.base is not None else " and in the design"
        return self._finding("G504", message, _CHOOSE.format(options="", item=region.id), region.line, path)

    def describe_outside_conflict(self, conflict: OutsideConflict) -> Finding:
        item = f"{self.file.path.rpartition('/')[2]}:{conflict.line}"
        fix = _CHOOSE.format(options=" --outside-regions", item=item)
        message = "this code was edited here, and the design changed it as well"
        if conflict.base is None:
            message = "this code differs from the design, and the text generated before is not known"
        return self._finding("G504", message, fix, conflict.line)

    def describe_merge_conflict(self, conflict: MergeConflict) -> Finding:
        lines = ", ".join(map(str, conflict.lines))
        place = f"line {lines}" if len(conflict.lines) == 1 else f"lines {lines}"
        if not conflict.regions:
            return self._finding("G505", f"merge conflict: markers in {place}", _RESOLVE, conflict.lines[0])
        names = ", ".join(f"'{name}'" for name in conflict.regions)
        noun = "region" if len(conflict.regions) == 1 else "regions"
        message = f"merge conflict in the code of {noun} {names}: markers in {place}"
        return self._finding("G504", message, _RESOLVE, conflict.lines[0])

    def describe_outside(self) -> Finding:
        if self.file.is_origin_known and self.file.path.endswith(_DECLARATIONS):
            line, name = self._find_declaration()
            subject = f"the constant '{name}'" if name else "a constant or enumeration"
            message = f"{subject} was edited here, but is declared in project.yaml"
            return self._finding("G501", message, _DECLARED, line, ("constants", name) if name else ("enumerations",))
        if self.file.is_origin_known:
            from vicode.sync.interpret import INTERPRETERS  # noqa: PLC0415 - most files have no such edits

            fix = _OUTSIDE if self.file.component and self.file.language in INTERPRETERS else _SHARED
            return self._finding("G501", "this file was edited outside regions", fix, self._first_edited_line())
        message = "this file may have been edited outside regions: the generated text is not known"
        return self._finding("G501", message, _UNKNOWN, 1)

    def _find_declaration(self) -> tuple[int, str]:
        """Return the first line that is not generated, and the constant that it assigns, "" if it assigns none."""
        lines, generated = (text.splitlines() for text in (self.file.old, self.file.new or ""))
        edited = (number for number, line in enumerate(lines, start=1) if line not in generated)
        number = next(edited, 1)
        found = re.match(r"(\w+): Final\b", lines[number - 1] if lines else "")
        return number, found[1] if found else ""

    def _first_edited_line(self) -> int:
        """The line of the first token of C++ that differs; 1 in other languages, whose files may be formatted."""
        if self.file.language != "cpp":
            return 1
        tokens = zip_longest(find_tokens(self.file.old), find_tokens(self.file.new or ""), fillvalue=("", 1))
        return next((own[1] for own, other in tokens if plain_token(own[0]) != plain_token(other[0])), 1)

    def _finding(self, code: str, message: str, fix: str, line: int, path: DesignPath = ()) -> Finding:
        name = f"{self.folder}/{self.file.path}" if self.folder else self.file.path
        # The project file declares what files without a component contain.
        subject = FindingSubject(component=self.file.component, path=path)
        return Finding(
            rule=get_rule(code),
            message=message,
            fix=fix,
            location=SourceLocation(file=name, line=line, column=1),
            notes=(Note(message="the design" if self.file.component else "the declaration", subject=subject),)
            if path
            else (),
        )
