"""Keeps generated code and designs in sync: finds edits in generated files and applies them to designs."""

from vicode.sync.applied_edits import RecordedEdit, RegionKey, read_applied, record_applied
from vicode.sync.apply_regions import AppliedEdit, AppliedEdits, Side, apply_regions, set_code
from vicode.sync.file_edits import FileEdits, find_file_edits
from vicode.sync.findings import describe_conflict, describe_edits
from vicode.sync.generation import (
    GenerationInput,
    GenerationPlan,
    back_up,
    find_new_errors,
    plan_generation,
    write_generated,
)
from vicode.sync.history import GeneratedHistory
from vicode.sync.outside_edits import rebase_outside_edits
from vicode.sync.region_merge import RegionEdit

__all__ = [
    "AppliedEdit",
    "AppliedEdits",
    "FileEdits",
    "GeneratedHistory",
    "GenerationInput",
    "GenerationPlan",
    "RecordedEdit",
    "RegionEdit",
    "RegionKey",
    "Side",
    "apply_regions",
    "back_up",
    "describe_conflict",
    "describe_edits",
    "find_file_edits",
    "find_new_errors",
    "plan_generation",
    "read_applied",
    "rebase_outside_edits",
    "record_applied",
    "set_code",
    "write_generated",
]
