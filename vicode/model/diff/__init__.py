"""The differences between two versions of a design or project, as values and in words."""

from vicode.model.diff.changes import Change, ChangeKind, describe_change
from vicode.model.diff.design_diff import diff_designs, rename_like
from vicode.model.diff.project_diff import diff_projects

__all__ = ["Change", "ChangeKind", "describe_change", "diff_designs", "diff_projects", "rename_like"]
