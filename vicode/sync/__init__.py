"""Keeps generated code and designs in step: finds edits in generated files and takes them over into designs."""

from vicode.sync.adopt import AdoptedEdit, Adoption, Side, adopt_regions
from vicode.sync.file_edits import FileEdits, find_file_edits
from vicode.sync.findings import describe_edits
from vicode.sync.generation import GenerationInput, GenerationPlan, back_up, plan_generation, write_generated
from vicode.sync.history import GeneratedHistory
from vicode.sync.region_merge import RegionEdit

__all__ = [
    "AdoptedEdit",
    "Adoption",
    "FileEdits",
    "GeneratedHistory",
    "GenerationInput",
    "GenerationPlan",
    "RegionEdit",
    "Side",
    "adopt_regions",
    "back_up",
    "describe_edits",
    "find_file_edits",
    "plan_generation",
    "write_generated",
]
