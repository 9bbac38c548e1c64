"""Finds the pairs of files to compare: of two paths, or of revisions and the work tree of a git repository."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from vicode.git import GitError, Repository, find_repository
from vicode.store import find_design_files, find_project_file, find_projects

_SUFFIXES = (".yaml", ".yml")


@dataclass(frozen=True, slots=True, kw_only=True)
class FileVersion:
    """A file in one version; `name` is its path in messages."""

    name: str
    content: bytes


@dataclass(frozen=True, slots=True, kw_only=True)
class VersionPair:
    """Two versions of a file; None where it does not exist. `is_explicit`: the user named the file."""

    old: FileVersion | None
    new: FileVersion | None
    is_explicit: bool = False

    @property
    def name(self) -> str:
        version = self.new or self.old
        assert version is not None
        return version.name


def find_pairs(items: Sequence[str]) -> Iterator[VersionPair]:
    """The pairs to compare for the arguments of the command.

    Raises:
        OSError: A path or revision does not exist.
    """
    paths = [Path(item) for item in items if Path(item).exists()]
    if len(items) == len(paths) == 2:
        yield from _pair_paths(*paths)
        return
    repository = find_repository(paths[0] if paths else Path())
    revisions, rest = _split_revisions(items, repository)
    if len(revisions) > 2:
        raise GitError(f"more than two revisions: {', '.join(revisions)}")
    old = repository.resolve(revisions[0] if revisions else "HEAD")
    new = repository.resolve(revisions[1]) if len(revisions) > 1 else None
    yield from _pair_revisions(repository, old, new, [repository.relative(Path(item)) for item in rest])


def _split_revisions(items: Sequence[str], repository: Repository) -> tuple[list[str], list[str]]:
    """Separate revisions from paths: a path exists, or is no revision."""
    revisions: list[str] = []
    paths: list[str] = []
    for item in items:
        first, dots, last = item.partition("..")
        if paths or Path(item).exists():
            paths.append(item)
        elif repository.has_revision(item):
            revisions.append(item)
        elif dots and not revisions and repository.has_revision(first or "HEAD"):
            end = last.removeprefix(".") or "HEAD"
            is_merge_base = last.startswith(".")
            begin = repository.resolve(first or "HEAD")
            revisions += [repository.merge_base(begin, repository.resolve(end)) if is_merge_base else begin, end]
        elif Path(item).suffix in _SUFFIXES or "/" in item:
            paths.append(item)
        else:
            raise GitError(f"'{item}' is neither a path nor a revision")
    return revisions, paths


def _pair_paths(old: Path, new: Path) -> Iterator[VersionPair]:
    if old.is_dir() != new.is_dir():
        folder, file = (old, new) if old.is_dir() else (new, old)
        raise OSError(f"{folder} is a folder, and {file} a file; compare two files or two folders")
    if not old.is_dir():
        yield VersionPair(old=_read(old), new=_read(new), is_explicit=True)
        return
    olds, news = _list_files(old), _list_files(new)
    for name in sorted({*olds, *news}):
        before = _read(olds[name]) if name in olds else None
        after = _read(news[name]) if name in news else None
        if before is None or after is None or before.content != after.content:
            yield VersionPair(old=before, new=after)


def _list_files(folder: Path) -> dict[str, Path]:
    """The designs and project files at and below a folder, by relative path."""
    files: list[Path] = []
    for project in find_projects(folder) or (folder,):
        project_file = find_project_file(project)
        files += [*find_design_files(project), *([project_file] if project_file else [])]
    return {file.relative_to(folder).as_posix(): file for file in files}


def _pair_revisions(repository: Repository, old: str, new: str | None, paths: Sequence[str]) -> Iterator[VersionPair]:
    explicit = {path for path in paths if Path(path).suffix in _SUFFIXES}
    for changed in sorted(repository.list_changed(old, new, paths), key=lambda each: each.new or each.old or ""):
        name = changed.new or changed.old or ""
        if Path(name).suffix not in _SUFFIXES:
            continue
        before = _read_revision(repository, old, changed.old)
        after = _read_work_tree(repository, changed.new) if new is None else None
        after = after or (_read_revision(repository, new, changed.new) if new is not None else None)
        if before is not None or after is not None:
            yield VersionPair(old=before, new=after, is_explicit=name in explicit)


def _read(file: Path) -> FileVersion:
    return FileVersion(name=file.as_posix(), content=file.read_bytes())


def _read_revision(repository: Repository, revision: str, path: str | None) -> FileVersion | None:
    content = repository.read(revision, path) if path is not None else None
    return None if path is None or content is None else FileVersion(name=path, content=content)


def _read_work_tree(repository: Repository, path: str | None) -> FileVersion | None:
    file = repository.root / path if path is not None else None
    return (
        None
        if path is None or file is None or not file.is_file()
        else FileVersion(name=path, content=file.read_bytes())
    )
