"""Reads designs and projects from YAML with all errors at once, and patches the text when a design is saved."""

from importlib import import_module
from typing import TYPE_CHECKING

from vicode.store.conflicts import ConflictPart, TextConflict, find_conflicts, resolve_conflicts
from vicode.store.documents import DesignReadResult, ProjectReadResult, read_design, read_project_file
from vicode.store.durable_write import FileChangedError, is_read_only, replace_text, write_text
from vicode.store.locations import find_faulty_components, find_location, iter_owning_components, locate_findings
from vicode.store.projects import (
    OpenProject,
    find_design_files,
    find_project_file,
    find_projects,
    folder_times,
    is_file_taken,
    is_project_text,
    looks_like_design,
    open_project,
    read_python_module,
    relative_design_paths,
)
from vicode.store.source_map import SourceMap
from vicode.store.unread import UnreadContentError

if TYPE_CHECKING:
    from vicode.store.comments import CommentedFile, add_comments, merge_comments
    from vicode.store.json_schema import design_schema, project_schema
    from vicode.store.kept_comments import take_comments
    from vicode.store.merge_texts import TextMerge, merge_file_texts
    from vicode.store.save import save_design, save_extracted, save_project_file
from vicode.store.unread import UnreadMember, list_unread

__all__ = [
    "CommentedFile",
    "ConflictPart",
    "DesignReadResult",
    "FileChangedError",
    "OpenProject",
    "ProjectReadResult",
    "SourceMap",
    "TextConflict",
    "TextMerge",
    "UnreadContentError",
    "UnreadMember",
    "add_comments",
    "design_schema",
    "find_conflicts",
    "find_design_files",
    "find_faulty_components",
    "find_location",
    "find_project_file",
    "find_projects",
    "folder_times",
    "is_file_taken",
    "is_project_text",
    "is_read_only",
    "iter_owning_components",
    "list_unread",
    "locate_findings",
    "looks_like_design",
    "merge_comments",
    "merge_file_texts",
    "open_project",
    "project_schema",
    "read_design",
    "read_project_file",
    "read_python_module",
    "relative_design_paths",
    "replace_text",
    "resolve_conflicts",
    "save_design",
    "save_extracted",
    "save_project_file",
    "take_comments",
    "write_text",
]

_LAZY_MODULES = {
    "CommentedFile": "comments",
    "add_comments": "comments",
    "merge_comments": "comments",
    "take_comments": "kept_comments",
    "TextMerge": "merge_texts",
    "design_schema": "json_schema",
    "merge_file_texts": "merge_texts",
    "project_schema": "json_schema",
    "save_design": "save",
    "save_extracted": "save",
    "save_project_file": "save",
}


def __getattr__(name: str) -> object:
    """Import what writes on first use: it is half of the package, and most commands only read."""
    if name not in _LAZY_MODULES:
        raise AttributeError(name)
    return getattr(import_module(f"vicode.store.{_LAZY_MODULES[name]}"), name)
