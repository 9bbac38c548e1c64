"""The record of the last build of a site: if neither its inputs nor its files changed, there is nothing to build.

It imports neither designs nor generators, so that a build without changes costs little more than reading the inputs.
"""

import json
import os
import shutil
import sys
from collections.abc import Collection, Iterator, Sequence
from dataclasses import asdict, dataclass
from hashlib import sha256
from pathlib import Path

import vicode
from vicode.output import write_atomically

# The last one marks folders that are no projects.
_INPUT_SUFFIXES = (".yaml", ".yml", ".xabsl", ".yabsl", ".py", ".vicode-deployed")
_OUTPUT_SUFFIXES = (".css", ".html", ".js", ".md", ".rst", ".svg", ".yml")
_PROJECT_FILES = ("project.yaml", "project.yml")
_NAVIGATION = "nav.yml"
_SKIPPED_FOLDERS = {"node_modules", "__pycache__", "site-packages"}


@dataclass(frozen=True, slots=True, kw_only=True)
class BuildRecord:
    """A build: digests of its inputs and of its files, and what it reported.

    `folders` are those whose designs, behaviors and classes were read; `sites` are the folders of the written files.
    """

    inputs: str
    files: str
    folders: tuple[str, ...]
    sites: tuple[str, ...]
    summary: str
    has_findings: bool


def find_unchanged_build(file: Path, options: Sequence[str], paths: Sequence[Path], out: Path) -> BuildRecord | None:
    """Return the recorded build if the same options, inputs and files would give it again."""
    record = _load(file)
    if record is None:
        return None
    try:
        is_same = record.inputs == digest_inputs(
            options, paths, [Path(each) for each in record.folders], out
        ) and record.files == digest_files(out, record.sites)
    except OSError:
        return None
    return record if is_same else None


def save_record(record: BuildRecord, file: Path) -> None:
    """Save a record; on failure, the next build reads everything."""
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(file, json.dumps(asdict(record)) + "\n", is_durable=False)
    except OSError:
        return


def digest_inputs(
    options: Sequence[str],
    paths: Sequence[Path],
    folders: Collection[Path],
    out: Path,
    *,
    newest_s: float | None = None,
) -> str:
    """Digest everything that the content of a site depends on.

    Raises:
        OSError: A file cannot be read, or it was changed after `newest_s`; or a folder is a link, whose files may be
            anywhere.
    """
    digest = sha256("\0".join([str(Path.cwd()), *options, *map(str, paths), _digest_tool()]).encode("utf-8", "replace"))
    tops = {path.resolve() for path in (*folders, *(each for each in paths if each.is_dir()))}
    files = {path.resolve() for path in paths if path.is_file()}
    files |= {file for top in tops for file in _files_in(top, out.resolve())}
    # A project file that appears above a design changes what its project is.
    parents = {parent for path in (*paths, *tops) for parent in (path.resolve(), *path.resolve().parents)}
    files |= {parent / name for parent in parents for name in _PROJECT_FILES if (parent / name).is_file()}
    # So does the root of the repository for the addresses of sources.
    digest.update(
        "\0".join(sorted(str(each) for each in parents if (each / ".git").exists())).encode("utf-8", "replace")
    )
    for file in sorted(files):
        status = file.stat()
        if newest_s is not None and max(status.st_mtime, status.st_ctime) >= newest_s:
            raise OSError(f"{file} has just been changed")
        content = file.read_bytes()
        digest.update(f"{file}\0{len(content)}\0".encode("utf-8", "replace") + content)
    return digest.hexdigest()


def digest_files(out: Path, sites: Collection[str]) -> str:
    """Digest the names, sizes and times of the pages in the folders of sites.

    The time of the last change of its status notices a page whose modification time was set back.
    """
    lines = []
    for site in sorted(sites):
        with os.scandir(out / site) as entries:
            for each in entries:
                if each.name.endswith(_OUTPUT_SUFFIXES):
                    status = each.stat()
                    lines.append(f"{site}/{each.name}\0{status.st_size}\0{status.st_mtime_ns}\0{status.st_ctime_ns}")
    return sha256("\n".join(sorted(lines)).encode("utf-8", "replace")).hexdigest()


def _files_in(top: Path, out: Path) -> Iterator[Path]:
    for path, folders, names in os.walk(top):
        folder = Path(path)
        folders[:] = [name for name in folders if not name.startswith(".") and name not in _SKIPPED_FOLDERS]
        for name in folders:
            if (folder / name).is_symlink() and (folder / name).resolve() != out:
                raise OSError(f"{folder / name} is a link")
        is_output = folder.is_relative_to(out)
        for name in names:
            if name.lower().endswith(_INPUT_SUFFIXES) and not (is_output and name == _NAVIGATION):
                yield folder / name


def _digest_tool() -> str:
    """Digest the sizes and times of the code and templates of vicode, and the folder of its libraries."""
    package = Path(vicode.__file__).parent
    installed = package / "_templates"
    templates = installed if installed.is_dir() else package.parent / "templates"
    files = [
        *package.rglob("*.py"),
        *templates.rglob("*"),
        *(Path(each) for each in sys.path if "site-packages" in each),
    ]
    states = ((str(file), file.stat()) for file in sorted(files))
    # Without its library, Graphviz is a program that may be installed later.
    lines = [
        sys.version,
        str(shutil.which("dot")),
        *(f"{path} {status.st_size} {status.st_mtime_ns}" for path, status in states),
    ]
    return sha256("\n".join(lines).encode("utf-8", "replace")).hexdigest()


def _load(file: Path) -> BuildRecord | None:
    try:
        data = json.loads(file.read_bytes())
        return BuildRecord(**{**data, "folders": tuple(data["folders"]), "sites": tuple(data["sites"])})
    except (OSError, ValueError, TypeError, KeyError):
        return None
