"""A project whose files a rename changes, on disk or open in the editor."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from vicode.model.project import Project
from vicode.services import messages
from vicode.store import OpenProject, is_read_only


class ProjectFiles(Protocol):
    """A project with its files; the editor implements it with the unsaved edits of open designs."""

    @property
    def folder(self) -> Path: ...

    @property
    def project(self) -> Project: ...

    @property
    def files(self) -> Mapping[str, Path]:
        """The design files by component."""

    @property
    def broken_file_names(self) -> tuple[str, ...]:
        """The files that cannot be parsed, relative to the folder."""

    @property
    def unsaved_components(self) -> tuple[str, ...]:
        """The components whose designs have unsaved edits."""

    def is_file_unchanged(self, component: str) -> bool:
        """Whether the file of a design still contains the text that was read."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FilesOnDisk:
    """A project as it was read from disk, without unsaved edits."""

    opened: OpenProject

    @property
    def folder(self) -> Path:
        return self.opened.folder

    @property
    def project(self) -> Project:
        return self.opened.project

    @property
    def files(self) -> Mapping[str, Path]:
        return self.opened.files

    @property
    def broken_file_names(self) -> tuple[str, ...]:
        opened, root = self.opened, self.folder.resolve()
        broken = (*opened.broken_files, *([opened.files[""]] if opened.is_project_file_broken else []))
        return tuple(file.resolve().relative_to(root).as_posix() for file in broken)

    @property
    def unsaved_components(self) -> tuple[str, ...]:
        return ()

    def is_file_unchanged(self, component: str) -> bool:
        file = self.files[component]
        return file.is_file() and file.read_bytes() == self.opened.texts[component].encode()


def validate_writable(project_files: ProjectFiles, components: Collection[str]) -> str:
    """An error message if the files of designs cannot be written, else an empty string."""
    unsaved = sorted(set(components) & set(project_files.unsaved_components))
    if unsaved:
        return messages.unsaved_changes(unsaved)
    names = sorted(components)
    locked = [project_files.files[name].name for name in names if is_read_only(project_files.files[name])]
    if locked:
        return messages.read_only(locked)
    stale = [name for name in names if not project_files.is_file_unchanged(name)]
    return messages.changed_on_disk(project_files.files[stale[0]].name) if stale else ""
