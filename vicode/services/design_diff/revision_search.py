"""Searches the revisions of a repository for the design with a hash."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from vicode.git import Commit, Repository, find_repository
from vicode.model.design_hash import hash_design
from vicode.output import temporary_folder
from vicode.store import find_projects, open_project

_SUFFIXES = (".yaml", ".yml")


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundDesign:
    """A design and the files of its project, by path in the repository; `commit` is None for the work tree."""

    component: str
    path: str
    texts: dict[str, str]
    commit: Commit | None


def find_design(path: Path, wanted: str) -> FoundDesign | None:
    """The design at or below a path whose hash starts with `wanted`: of the newest revision, or else of the work tree.

    Raises:
        GitError: The path is in no repository.
    """
    repository = find_repository(path)
    with temporary_folder("show") as copy:
        found = next(search_revisions(repository, repository.relative(path), wanted, copy), None)
    return found or find_in_folder(path, repository.root, wanted, None)


def find_in_folder(folder: Path, root: Path, wanted: str, commit: Commit | None) -> FoundDesign | None:
    """The first design in the projects of a folder whose hash starts with `wanted`; paths are relative to `root`."""
    for project_folder in find_projects(folder):
        opened = open_project(project_folder)
        for design in opened.project.designs:
            if hash_design(opened.project, design.component).startswith(wanted):
                paths = {name: _relative(file, root) for name, file in opened.files.items()}
                return FoundDesign(
                    component=design.component,
                    path=paths[design.component],
                    texts={path: opened.texts[name] for name, path in paths.items()},
                    commit=commit,
                )
    return None


def search_revisions(repository: Repository, folder: str, wanted: str, copy: Path) -> Iterator[FoundDesign]:
    """The revisions with a design, newest first.

    Args:
        repository: The repository.
        folder: The folder to search, relative to the root.
        wanted: The first digits of the hash.
        copy: An empty folder; it gets the designs of one revision after the other.
    """
    present: dict[str, str] = {}
    for commit in repository.log([folder], all_branches=True):
        blobs = {
            path: blob for path, blob in repository.list_blobs(commit.revision, [folder]).items() if _is_yaml(path)
        }
        if blobs == present:
            continue
        for path in present.keys() - blobs.keys():
            (copy / path).unlink()
        for path, blob in blobs.items():
            if present.get(path) != blob:
                (copy / path).parent.mkdir(parents=True, exist_ok=True)
                (copy / path).write_bytes(repository.read(commit.revision, path) or b"")
        present = blobs
        found = find_in_folder(copy, copy, wanted, commit)
        if found is not None:
            yield found


def _is_yaml(path: str) -> bool:
    return path.endswith(_SUFFIXES) and not path.startswith("/") and ".." not in Path(path).parts


def _relative(file: Path, root: Path) -> str:
    return file.resolve().relative_to(root.resolve()).as_posix()
