"""Merges the texts of three versions of a design or project file; comments and layout survive.

The values decide, the lines only carry comments. The designs are merged first. If a merge by lines reads as that
design, it is the result, with the comments of both sides; otherwise the design is saved over the lines, or over our
text. Conflicts are marked where our text differs from the one with their side of a conflict. Choosing their side
everywhere must give the design with all their sides; if it does not, the conflicts depend on each other and are marked
as one.
"""

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from itertools import pairwise
from typing import Any

from vicode.findings import DesignPath
from vicode.model.design import Design
from vicode.model.merge import Conflict, merge_designs, merge_projects, merge_texts
from vicode.model.paths import describe_path
from vicode.model.project import Project
from vicode.store.conflicts import LineChange, find_conflicts, format_conflicts, resolve_conflicts
from vicode.store.documents import read_design, read_project_file
from vicode.store.save import save_design, save_project_file

_Paths = frozenset[DesignPath]
_MAX_NAMES = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class TextMerge:
    """The merged text. Each conflict is marked in it; `conflicts` are their names."""

    text: str
    conflicts: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class _Format:
    """How to read, merge and write one kind of file."""

    read: Callable[[str], Any]
    save: Callable[[Any, str], str]
    merge: Callable[[Any, Any, Any, Collection[DesignPath]], tuple[Any, tuple[Conflict, ...]]]
    whole: str


def merge_file_texts(base: str, ours: str, theirs: str, *, is_project_file: bool = False) -> TextMerge | None:
    """Merge by state and transition, and write the result into our text.

    Returns:
        None if a version cannot be read without errors. An empty `base` is an empty design.
    """
    form = _PROJECT if is_project_file else _DESIGN
    is_windows = "\r\n" in ours
    texts = [text.replace("\r\n", "\n") for text in (base, ours, theirs)]
    values = [form.read(text) for text in texts]
    if not texts[0].strip() and values[1] is not None:
        names = f"project: {values[1].name}" if is_project_file else f"component: {values[1].component}"
        values[0] = form.read(f"vicode: 1\n{names}\n")
    if None in values:
        return None
    try:
        merged = _FileMerge(form, texts, values).run()
    except ValueError:
        return None
    if is_windows and merged is not None:
        return TextMerge(text=merged.text.replace("\n", "\r\n"), conflicts=merged.conflicts)
    return merged


class _FileMerge:
    def __init__(self, form: _Format, texts: list[str], values: list[Any]) -> None:
        self.form, self.texts, self.values = form, texts, values

    def run(self) -> TextMerge:
        value, conflicts = self._merge(frozenset())
        text = self._write(value)
        if not conflicts:
            return TextMerge(text=text)
        changes = self._separate_changes(text, [(conflict.path,) for conflict in conflicts])
        everything = self._all_theirs()
        marked = format_conflicts(text.splitlines(keepends=True), changes)
        read = self.form.read(resolve_conflicts(marked, find_conflicts(marked), takes_theirs=True))
        if read != everything:
            # The conflicts depend on each other: they are one.
            name = self._name([conflict.path for conflict in conflicts])
            changes = list(_diff_lines(name, text, self.form.save(everything, text)))
            marked = format_conflicts(text.splitlines(keepends=True), changes)
        return TextMerge(text=marked, conflicts=tuple(dict.fromkeys(change.name for change in changes)))

    def _merge(self, theirs_at: _Paths) -> tuple[Any, tuple[Conflict, ...]]:
        base, ours, theirs = self.values
        return self.form.merge(base, ours, theirs, theirs_at)

    def _write(self, value: Any) -> str:
        """The text of a value: the merged lines if they have it, which keeps the comments of both sides."""
        merged = [merge_texts(*self.texts, keeps_theirs=keeps_theirs) for keeps_theirs in (False, True)]
        read = [self.form.read(text) for text in merged]
        for text, found in zip(merged, read, strict=True):
            if found == value:
                return text
        return self.form.save(value, merged[0] if read[0] is not None else self.texts[1])

    def _separate_changes(self, text: str, groups: list[tuple[DesignPath, ...]]) -> list[LineChange]:
        """The lines that their side of each group of conflicts changes; groups that share lines are joined."""
        changes = [self._changes_of(text, group) for group in groups]
        shared = _find_overlap(changes)
        while shared:
            first, second = shared
            groups[first] += groups.pop(second)
            changes.pop(second)
            changes[first] = self._changes_of(text, groups[first])
            shared = _find_overlap(changes)
        return [change for group in changes for change in group]

    def _changes_of(self, text: str, paths: tuple[DesignPath, ...]) -> list[LineChange]:
        value, _conflicts = self._merge(frozenset(paths))
        return list(_diff_lines(self._name(paths), text, self.form.save(value, text)))

    def _name(self, paths: Sequence[DesignPath]) -> str:
        names = [describe_path(path, self.form.whole) for path in paths]
        return ", ".join(names) if len(names) < _MAX_NAMES else f"{names[0]} and {len(names) - 1} more"

    def _all_theirs(self) -> Any:
        """The merge with their side of all conflicts. A renamed state changes the paths of other conflicts."""
        chosen: _Paths = frozenset()
        while True:
            value, conflicts = self._merge(chosen)
            paths = chosen | {conflict.path for conflict in conflicts}
            if paths == chosen:
                return value
            chosen = paths


def _diff_lines(name: str, ours: str, theirs: str) -> Iterator[LineChange]:
    old, new = ours.splitlines(keepends=True), theirs.splitlines(keepends=True)
    for tag, start, end, first, last in SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if tag != "equal":
            yield LineChange(name=name, start=start, end=end, theirs=tuple(new[first:last]))


def _find_overlap(groups: list[list[LineChange]]) -> tuple[int, int] | None:
    """The indices of two groups that change the same lines, the lower one first."""
    ordered = sorted(
        ((change.start, change.end, index) for index, changes in enumerate(groups) for change in changes),
    )
    for (start, end, first), (next_start, next_end, second) in pairwise(ordered):
        if first != second and (next_start < end or (start, end) == (next_start, next_end)):
            return min(first, second), max(first, second)
    return None


def _read_design(text: str) -> Design | None:
    read = read_design(text)
    return None if read.findings else read.design


def _read_project(text: str) -> Project | None:
    read = read_project_file(text)
    return None if read.findings else read.project


def _merge_designs(
    base: Design, ours: Design, theirs: Design, theirs_at: Collection[DesignPath]
) -> tuple[Design, tuple[Conflict, ...]]:
    result = merge_designs(base, ours, theirs, theirs_at=theirs_at)
    return result.design, result.conflicts


def _merge_projects(
    base: Project, ours: Project, theirs: Project, theirs_at: Collection[DesignPath]
) -> tuple[Project, tuple[Conflict, ...]]:
    result = merge_projects(base, ours, theirs, theirs_at=theirs_at)
    return result.project, result.conflicts


_DESIGN = _Format(read=_read_design, save=save_design, merge=_merge_designs, whole="the design")
_PROJECT = _Format(read=_read_project, save=save_project_file, merge=_merge_projects, whole="the project")
