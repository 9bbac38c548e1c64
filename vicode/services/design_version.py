"""A version of a design: a path, or a path in a revision of git, as `REVISION:PATH`."""

from pathlib import Path

from vicode.git import GitError, find_repository
from vicode.store.documents import PROJECT_FILES


def find_version(text: str, target: Path) -> Path:
    """The path of a version; the project of a revision is copied to a folder, which must not exist.

    Args:
        text: An existing path, or REVISION:PATH with a path from the root of the repository.
        target: The folder for the copy.

    Raises:
        OSError: There is neither such a path nor such a revision.
    """
    revision, colon, name = text.partition(":")
    if Path(text).exists() or not colon:
        return Path(text)
    repository, path = find_repository(Path()), Path(name)
    commit = repository.resolve(revision)
    files = [Path(blob) for blob in repository.list_blobs(commit)]
    if not any(file.is_relative_to(path) for file in files):
        raise GitError(f"revision {revision} has no '{name}'; write the path from the root of the repository")
    folder = path.parent if path in files else path
    folder = next((up for up in (folder, *folder.parents) if any(up / each in files for each in PROJECT_FILES)), folder)
    for file in files:
        if file.is_relative_to(folder):
            copy = target / file.relative_to(folder)
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(repository.read(commit, file.as_posix()) or b"")
    return target / path.relative_to(folder)
