"""Prints what a generation plan does with the edits of generated files."""

import sys
from collections.abc import Iterator
from difflib import unified_diff
from typing import TYPE_CHECKING

from vicode.cli.console import print_findings
from vicode.output import FileStatus
from vicode.services.project_loader import LoadedProject

if TYPE_CHECKING:
    from vicode.sync import GenerationPlan


def print_refusal(opened: LoadedProject, plan: "GenerationPlan") -> None:
    """Print why nothing is written, the texts of conflicts, and what can be done with each edit."""
    from vicode.store import locate_findings

    print_findings(locate_findings(plan.findings, opened.open_project), to_stderr=True)
    print("".join(_conflict_diffs(plan)), end="", file=sys.stderr)
    for line in _describe_edits(opened, plan):
        print(line, file=sys.stderr)


def print_written(opened: LoadedProject, plan: "GenerationPlan") -> None:
    """Print what was done with each edit, and which files were written."""
    for line in _describe_applied(opened, plan):
        print(line)
    for reading in plan.outside_readings:
        for reason in reading.reasons:
            print(f"{(plan.folder / reading.file.path).as_posix()}: {reason}")
    for path in plan.patches:
        print(f"kept the rest of the edit as {(plan.folder / path).as_posix()}")
    for difference in plan.differences:
        verb = "deleted" if difference.status is FileStatus.STALE else "wrote"
        print(f"{verb} {(plan.folder / difference.path).as_posix()}")


def _conflict_diffs(plan: "GenerationPlan") -> Iterator[str]:
    """The texts of each conflict, as differences of the file from the design."""
    chosen = {(each.path, name) for each in plan.settled for name in each.names}
    for file in plan.edits:
        for region in file.regions:
            if region.is_conflict and (file.path, region.id) not in chosen:
                yield from _differences(region.id, region.base, region.design_text, region.file_text)
        for merge in file.merge_conflicts:
            name = ", ".join(merge.regions)
            if name:
                yield from _lines(merge.ours, merge.theirs, f"ours: {name}", f"theirs: {name}")
    for reading in plan.outside_readings:
        for each in reading.conflicts:
            name = f"{reading.file.path}:{each.line}"
            yield from _differences(name, each.base, each.design_text, each.file_text)


def _differences(name: str, base: str | None, design: str, found: str) -> Iterator[str]:
    if base is not None and base not in (design, found):
        yield from _lines(base, design, f"generated before: {name}", f"design: {name}")
    yield from _lines(design, found, f"design: {name}", f"file: {name}")


def _lines(old: str, new: str, old_name: str, new_name: str) -> Iterator[str]:
    before, after = (f"{text.rstrip()}\n".splitlines(keepends=True) for text in (old, new))
    return unified_diff(before, after, old_name, new_name)


def _describe_edits(opened: LoadedProject, plan: "GenerationPlan") -> Iterator[str]:
    """What can be done with each edit, if the plan applies edits."""
    for edit in plan.applied:
        place = f"{(plan.folder / edit.file.path).as_posix()}:{edit.region.line}"
        design = opened.open_project.files[edit.file.component].as_posix()
        yield f"{place}: the edit of region '{edit.region.id}' can be applied to {design}"
    for each in plan.outside_readings:
        path = (plan.folder / each.file.path).as_posix()
        yield from (f"{path}:{edit.line}: the design can express: {edit.words}" for edit in each.edits)
        if each.leftover:
            yield from (f"{path}: {reason}" for reason in each.reasons)
            yield f"{path}: the design cannot express:\n{each.leftover.rstrip()}"
    is_outside = any(each.edits or each.leftover for each in plan.outside_readings)
    if is_outside and {finding.rule.code for finding in plan.findings} == {"G501"}:
        yield (
            "nothing was written; 'vicode sync --outside-regions' applies these edits and keeps what the design cannot"
            " express as NAME.patch"
        )
    elif plan.applied or is_outside:
        yield "nothing was written; fix what is reported above, then run the command again"


def _describe_applied(opened: LoadedProject, plan: "GenerationPlan") -> Iterator[str]:
    files = opened.open_project.files
    for reading in plan.outside_readings:
        for applied in reading.edits:
            place = f"{(plan.folder / reading.file.path).as_posix()}:{applied.line}"
            yield f"applied from {place} to {files[reading.file.component].as_posix()}: {applied.words}"
    for edit in plan.applied:
        place = f"{(plan.folder / edit.file.path).as_posix()}:{edit.region.line}"
        verb = "merged" if edit.region.is_merged else "applied"
        yield f"{verb} {edit.region.id} from {place} to {files[edit.file.component].as_posix()}"
    for each in plan.settled:
        other = "design" if each.side == "file" else "file"
        dropped = f", dropped:\n{each.dropped.rstrip()}" if each.dropped.strip() else ""
        yield f"took the text of the {each.side} for {each.names[0]}; that of the {other}{dropped or ' was empty'}"
