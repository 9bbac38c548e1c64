"""Keeps generated code and designs in sync: finds edits in generated files and applies them to designs."""

from vicode.sync.applied_edits import RecordedEdit, RegionKey, read_applied, record_applied
from vicode.sync.apply_regions import AppliedEdit, AppliedEdits, apply_regions, set_code
from vicode.sync.choices import Choices, SettledConflict, Side
from vicode.sync.file_edits import FileEdits, find_file_edits
from vicode.sync.findings import describe_conflict, describe_edits, describe_problems
from vicode.sync.generation import (
    GenerationInput,
    GenerationPlan,
    back_up,
    find_new_errors,
    plan_generation,
    write_generated,
)
from vicode.sync.history import GeneratedHistory, generate_revision
from vicode.sync.merge_markers import MergeConflict
from vicode.sync.outside_edits import OutsideConflict, RebasedFile, rebase_outside_edits
from vicode.sync.outside_readings import OutsideReader, OutsideReading, conflict_name
from vicode.sync.patches import describe_patch, find_patches
from vicode.sync.region_merge import RegionEdit
from vicode.sync.same_code import is_same_code

__all__ = [
    "AppliedEdit",
    "AppliedEdits",
    "Choices",
    "FileEdits",
    "GeneratedHistory",
    "GenerationInput",
    "GenerationPlan",
    "MergeConflict",
    "OutsideConflict",
    "OutsideReader",
    "OutsideReading",
    "RebasedFile",
    "RecordedEdit",
    "RegionEdit",
    "RegionKey",
    "SettledConflict",
    "Side",
    "apply_regions",
    "back_up",
    "conflict_name",
    "describe_conflict",
    "describe_edits",
    "describe_patch",
    "describe_problems",
    "find_file_edits",
    "find_new_errors",
    "find_patches",
    "generate_revision",
    "is_same_code",
    "plan_generation",
    "read_applied",
    "rebase_outside_edits",
    "record_applied",
    "set_code",
    "write_generated",
]
