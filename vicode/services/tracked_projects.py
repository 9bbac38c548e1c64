"""The projects in a git repository, and whether git tracks their generated files."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from vicode.git import Repository


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackedProject:
    """The folder of a project and, if git tracks generated files, their folder; relative to the root."""

    folder: str
    generated: str
    is_generated_tracked: bool

    def has_changed(self, files: Sequence[str]) -> bool:
        """Whether one of some files belongs to the project."""
        folders = (self.folder, *((self.generated,) if self.generated else ()))
        return any(folder == "." or file.startswith(f"{folder}/") for file in files for folder in folders)


def find_tracked_projects(repository: Repository) -> list[TrackedProject]:
    from vicode.store import find_projects, open_project

    found = []
    for folder in find_projects(repository.root):
        output = Path(os.path.realpath(folder / open_project(folder).project.generated))
        is_inside = output.is_relative_to(repository.root)
        generated = repository.relative(output) if is_inside else ""
        found.append(
            TrackedProject(
                folder=repository.relative(folder),
                generated=generated,
                is_generated_tracked=is_inside and bool(repository.list_tracked([generated])),
            )
        )
    return found
