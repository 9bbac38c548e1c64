"""Finds texts that were generated before: the copies kept with the generated files, and revisions in git."""

import contextlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from vicode.generators import UnsoundDesignError, generate
from vicode.git import GitError, Repository, find_repository
from vicode.output import temporary_folder
from vicode.regions import has_header
from vicode.store import OpenProject, open_project
from vicode.transactions import STATE_FOLDER

_MAX_REVISIONS = 8
_SUFFIXES = (".yaml", ".yml")


class _Revisions:
    """What the last revisions of a project generate, read when it is needed and only once."""

    def __init__(self) -> None:
        self._known: list[Mapping[str, str]] = []
        self._unread: Iterator[Mapping[str, str]] | None = None

    def read(self, folder: Path) -> Iterator[Mapping[str, str]]:
        if self._unread is None:
            self._unread = _generate_revisions(folder)
        index = 0
        while True:
            if index == len(self._known):
                files = next(self._unread, None)
                if files is None:
                    return
                self._known.append(files)
            yield self._known[index]
            index += 1


@dataclass(frozen=True, slots=True, kw_only=True)
class GeneratedHistory:
    """The texts that were generated for a path, the last one first.

    Attributes:
        folder: The folder of generated files, with the copies of the last texts.
        project_folder: The folder of the designs, whose revisions in git are generated again; None skips them.
    """

    folder: Path
    project_folder: Path | None = None
    _revisions: _Revisions = field(default_factory=_Revisions)

    def __call__(self, path: str) -> Iterator[str]:
        try:
            kept = (self.folder / STATE_FOLDER / "generated" / f"{path}.base").read_text("utf-8")
        except (OSError, UnicodeDecodeError):
            kept = ""
        if has_header(kept):
            yield kept
        if self.project_folder is not None:
            texts = self._revisions.read(self.project_folder)
            yield from (files[path] for files in texts if path in files)


def _generate_revisions(folder: Path) -> Iterator[Mapping[str, str]]:
    try:
        repository = find_repository(folder)
        path = repository.relative(folder)
        revisions = [commit.revision for commit in repository.log([path], limit=_MAX_REVISIONS)]
    except GitError:
        return
    for revision in revisions:
        yield generate_revision(repository, revision, path)


def generate_revision(repository: Repository, revision: str, path: str) -> Mapping[str, str]:
    """What a revision of the project in a folder generates, by path; empty if a design has errors."""
    with temporary_folder("revision") as name, contextlib.suppress(OSError):
        # The name of a project without project.yaml is that of its folder.
        return _generate_sound(_check_out(repository, revision, path, name / (repository.root / path).name))
    return {}


def _check_out(repository: Repository, revision: str, path: str, folder: Path) -> OpenProject:
    """Open the designs of a revision, written to a folder."""
    for file in repository.list_blobs(revision, [path]):
        content = repository.read(revision, file) if file.endswith(_SUFFIXES) else None
        if content is not None:
            target = folder / (file if path == "." else file.removeprefix(f"{path}/"))
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)
    return open_project(folder)


def _generate_sound(opened: OpenProject) -> Mapping[str, str]:
    """The generated texts by path; empty if a design has errors."""
    with contextlib.suppress(UnsoundDesignError):
        return {file.path: file.text for file in generate(opened.project, standalone=True, sources=opened.design_paths)}
    return {}
