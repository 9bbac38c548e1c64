"""A version of a design: a path, or a path in a revision of git, as `REVISION:PATH`."""

from pathlib import Path

from vicode.git import GitError, find_repository
from vicode.store.documents import PROJECT_FILES


def find_version(text: str, target: Path) -> Path:
    """The path of a version; the project of a revision is copied to a folder, which must not exist.

    Args:
        text: An existing path, or REVISION:PATH, with a path from the root of the repository or from `./`.
        target: The folder for the copy.

    Raises:
        OSError: There is neither such a path nor such a revision.
    """
    revision, colon, name = text.partition(":")
    if Path(text).exists() or not colon:
        return Path(text)
    repository = find_repository(Path())
    commit = repository.resolve(revision)
    path = Path(repository.relative(Path(name)) if name.startswith(".") else name)
    blobs = repository.list_blobs(commit)
    files = [Path(blob) for blob in blobs if Path(blob).is_relative_to(path)]
    if not files:
        raise GitError(f"revision {revision} has no '{path.as_posix()}'")
    folder = path.parent if path in files else path
    owners = (each for each in (folder, *folder.parents) for file in PROJECT_FILES if (each / file).as_posix() in blobs)
    folder = next(owners, folder)
    for blob in blobs:
        if Path(blob).is_relative_to(folder):
            file = target / Path(blob).relative_to(folder)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(repository.read(commit, blob) or b"")
    return target / path.relative_to(folder)
