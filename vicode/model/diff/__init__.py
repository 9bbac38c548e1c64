"""The differences between two versions of a design or project, as values and in words."""

from vicode.model.diff.changes import Change, ChangeKind, changed_lines, describe_change, describe_changes
from vicode.model.diff.design_diff import diff_designs, rename_like
from vicode.model.diff.project_diff import diff_projects
from vicode.model.diff.unread_diff import diff_unread

__all__ = [
    "Change",
    "ChangeKind",
    "changed_lines",
    "describe_change",
    "describe_changes",
    "diff_designs",
    "diff_projects",
    "diff_unread",
    "rename_like",
]
