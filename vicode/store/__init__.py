"""The only room that knows YAML: reads designs and projects with all mistakes at once, and patches texts on save."""

from vicode.store.documents import ReadDesign, ReadProject, read_design, read_project_file
from vicode.store.locating import faulty_components, locate, owners_of, place_of
from vicode.store.projects import OpenProject, design_files, find_projects, open_project, project_file_in
from vicode.store.remarks import with_remarks
from vicode.store.saving import save_design, save_project_file
from vicode.store.schema import design_schema, project_schema
from vicode.store.sources import SourceMap
from vicode.store.writing import is_read_only, write_text

__all__ = [
    "OpenProject",
    "ReadDesign",
    "ReadProject",
    "SourceMap",
    "design_files",
    "design_schema",
    "faulty_components",
    "find_projects",
    "is_read_only",
    "locate",
    "open_project",
    "owners_of",
    "place_of",
    "project_file_in",
    "project_schema",
    "read_design",
    "read_project_file",
    "save_design",
    "save_project_file",
    "with_remarks",
    "write_text",
]
