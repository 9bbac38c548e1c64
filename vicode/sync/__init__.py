"""Keeps generated code and designs in step: finds edits in generated files and takes them over into designs."""

from vicode.sync.adopt import AdoptedEdit, Adoption, Side, adopt_regions, set_code
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
from vicode.sync.taken import RegionKey, TakenEdit, read_taken, record_taken

__all__ = [
    "AdoptedEdit",
    "Adoption",
    "FileEdits",
    "GeneratedHistory",
    "GenerationInput",
    "GenerationPlan",
    "RegionEdit",
    "RegionKey",
    "Side",
    "TakenEdit",
    "adopt_regions",
    "back_up",
    "describe_conflict",
    "describe_edits",
    "find_file_edits",
    "find_new_errors",
    "plan_generation",
    "read_taken",
    "rebase_outside_edits",
    "record_taken",
    "set_code",
    "write_generated",
]
