"""Opens folders: finds project.yaml and the designs that belong to it, and reads them all."""

import errno
import os
import re
import stat
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from vicode.findings import Finding, Note, get_rule, sort_findings
from vicode.model.names import name_from_text
from vicode.model.project import Project
from vicode.store.documents import (
    PROJECT_FILES,
    DesignReadResult,
    default_project_name,
    read_design,
    read_project_file,
)
from vicode.store.line_index import LineIndex, ReadReport
from vicode.store.source_map import SourceMap
from vicode.store.yaml_tree import MAX_BYTES

DESIGN_SUFFIXES = (".yaml", ".yml")
_LOOKS_LIKE_DESIGN = re.compile(rb"^(vicode|component|states)[ \t]*:", re.MULTILINE)
_COMPONENT = re.compile(rb"^component[ \t]*:[ \t]*[\"']?([A-Za-z]\w*)", re.MULTILINE)
_SKIPPED_FOLDERS = {"node_modules", "__pycache__", "site-packages"}
_MAX_PARENT_FOLDERS = 8
# What each file said when it was read last, by its content and the name that messages give it.
_MAX_CACHED = 4096
_read_cache: dict[Path, tuple[bytes, str, DesignReadResult]] = {}


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenProject:
    """A project as it stands on disk.

    `files`, `sources` and `texts` are by component; "" stands for project.yaml, if there is one. `broken_files` are files
    that are meant to be designs, but hold none that can be read. `findings` are mistakes of reading, with places.
    """

    project: Project
    folder: Path
    files: Mapping[str, Path]
    sources: Mapping[str, SourceMap]
    texts: Mapping[str, str]
    broken_files: tuple[Path, ...]
    findings: tuple[Finding, ...]

    @property
    def project_file(self) -> Path | None:
        """The project.yaml, None when the project does without."""
        return self.files.get("")

    def find_component(self, path: Path) -> str | None:
        """The component whose design a file holds, None when it holds none of this project."""
        wanted = path.resolve()
        return next((name for name, file in self.files.items() if name and file.resolve() == wanted), None)


def open_project(path: Path | str) -> OpenProject:
    """Open the project of a folder, or the one that a design file belongs to.

    Raises:
        OSError: The path does not exist or cannot be read.
    """
    given = Path(path)
    folder = given if given.is_dir() else _find_project_folder(given)
    listed = list(find_design_files(folder))
    if not given.is_dir() and given.name not in PROJECT_FILES:
        given.stat()
        listed += [given] if given.resolve() not in {file.resolve() for file in listed} else []
    opening = _ProjectLoader(folder)
    opening.read_project_file()
    for file in listed:
        opening.read_design(file, is_explicit=not given.is_dir() and file.resolve() == given.resolve())
    return opening.result()


def find_projects(folder: Path | str) -> tuple[Path, ...]:
    """The folders of all projects in a folder, in order; of a design file the one it belongs to."""
    top = Path(folder)
    if not top.is_dir():
        return (_find_project_folder(top),)
    found = {Path(place) for place, _folders, names in _walk_visible_folders(top) if set(names) & set(PROJECT_FILES)}
    loose = [
        Path(place)
        for place, _folders, names in _walk_visible_folders(top)
        if not any(_is_inside(Path(place), project) for project in found)
        and any(_is_design(Path(place) / name, top) for name in names)
    ]
    for place in loose:
        if not any(_is_inside(place, project) for project in found):
            found.add(place)
    return tuple(sorted(found))


def find_design_files(folder: Path) -> tuple[Path, ...]:
    """The files of a folder's own designs, those of projects inside it left out."""
    files: list[Path] = []
    for place, folders, names in _walk_visible_folders(folder):
        folders[:] = [name for name in folders if not _holds_project(Path(place) / name)]
        files += [Path(place) / name for name in names if _is_candidate(Path(place) / name, folder)]
    return tuple(sorted(files))


def find_project_file(folder: Path) -> Path | None:
    """The project.yaml of a folder."""
    return next((folder / name for name in PROJECT_FILES if (folder / name).is_file()), None)


def display_path(path: Path) -> str:
    """A path as messages name it: relative where that is shorter to read."""
    relative = os.path.relpath(path)
    return str(path) if relative.startswith("..") else relative


class _ProjectLoader:
    """Reads file by file and collects."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.project = Project(name=default_project_name(folder.resolve().name), generated=_default_output(folder))
        self.files: dict[str, Path] = {}
        self.reads: dict[str, DesignReadResult] = {}
        self.sources: dict[str, SourceMap] = {}
        self.texts: dict[str, str] = {}
        self.broken_files: list[Path] = []
        self.unread: list[tuple[str, str]] = []
        self.findings: list[Finding] = []

    def read_project_file(self) -> None:
        """Read project.yaml, if there is one."""
        file = find_project_file(self.folder)
        if file is None:
            return
        read = read_project_file(_read_bytes(file), display_path(file))
        self.findings += read.findings
        self.project = read.project or self.project
        self.files[""], self.sources[""], self.texts[""] = file, read.source_map, read.source_map.line_index.text

    def read_design(self, file: Path, *, is_explicit: bool) -> None:
        """Read a design; a file that looks like something else counts only when it `is_explicit`."""
        try:
            content = _read_bytes(file)
        except OSError as error:
            self._add_unreadable(file, error)
            return
        if not is_explicit and not _looks_like_design(content):
            return
        read = _read_cached(file, content)
        self.findings += read.findings
        if read.design is None:
            self._add_broken(file, content)
        elif read.design.component in self.reads:
            self._add_duplicate(file, read)
        else:
            name = read.design.component
            self.reads[name], self.files[name] = read, file
            self.sources[name], self.texts[name] = read.source_map, read.source_map.line_index.text

    def _add_broken(self, file: Path, content: bytes) -> None:
        said = _COMPONENT.search(content)
        name = said[1].decode() if said else name_from_text(file.stem.replace("_", " "))
        self.broken_files.append(file)
        self.unread.append((name, file.name))

    def result(self) -> OpenProject:
        """All of it."""
        designs = tuple(read.design for read in self.reads.values() if read.design is not None)
        return OpenProject(
            project=replace(self.project, designs=designs, unreadable=tuple(self.unread)),
            folder=self.folder,
            files=self.files,
            sources=self.sources,
            texts=self.texts,
            broken_files=tuple(self.broken_files),
            findings=sort_findings(self.findings),
        )

    def _add_duplicate(self, file: Path, read: DesignReadResult) -> None:
        assert read.design is not None
        name = read.design.component
        first = Note(message="first here", location=self.sources[name].locate(("component",)))
        finding = Finding(
            rule=get_rule("P201"),
            message=f"there is another component '{name}'",
            fix="rename one of them",
            location=read.source_map.locate(("component",)),
            notes=(first,),
        )
        self.findings.append(finding)
        self.broken_files.append(file)

    def _add_unreadable(self, file: Path, error: OSError) -> None:
        report = ReadReport(line_index=LineIndex("", display_path(file)))
        report.add("Y110", f"the file cannot be read: {error.strerror}", (0, 1))
        self.findings += report.findings
        self._add_broken(file, b"")


def _read_cached(file: Path, content: bytes) -> DesignReadResult:
    """Read a design; a file that says what it said before is not parsed anew: large projects open again at once."""
    place, shown = file.absolute(), display_path(file)
    known = _read_cache.get(place)
    if known is not None and known[:2] == (content, shown):
        return known[2]
    if len(_read_cache) >= _MAX_CACHED:
        _read_cache.clear()
    read = read_design(content, shown)
    _read_cache[place] = (content, shown, read)
    return read


def _read_bytes(file: Path) -> bytes:
    # A pipe would keep us waiting, and a device may never end.
    if not stat.S_ISREG(file.stat().st_mode):
        raise OSError(errno.EINVAL, "it is no regular file", str(file))
    # One byte more than is allowed tells that it is too much.
    with file.open("rb") as stream:
        return stream.read(MAX_BYTES + 1)


def _find_project_folder(file: Path) -> Path:
    """The folder of the project that a design file belongs to."""
    beside = file.parent
    folder = beside.resolve()
    for _level in range(_MAX_PARENT_FOLDERS):
        found = find_project_file(folder)
        if found is not None and (folder == beside.resolve() or _looks_like_design(_read_bytes(found))):
            return beside if folder == beside.resolve() else folder
        if folder.parent == folder or (folder / ".git").exists():
            break
        folder = folder.parent
    return beside


def _default_output(folder: Path) -> str:
    """Where a project without project.yaml generates to: `generated` at the top of its repository, else beside it."""
    inside = folder.resolve()
    for place in (inside, *inside.parents):
        if (place / ".git").exists():
            return Path(os.path.relpath(place / "generated", inside)).as_posix()
    return "generated"


def _walk_visible_folders(folder: Path) -> Iterator[tuple[str, list[str], list[str]]]:
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith(".") and name not in _SKIPPED_FOLDERS)
        yield place, folders, sorted(names)


def _holds_project(folder: Path) -> bool:
    return find_project_file(folder) is not None


def _is_inside(path: Path, folder: Path) -> bool:
    return path == folder or folder in path.parents


def _is_candidate(file: Path, folder: Path) -> bool:
    if file.suffix not in DESIGN_SUFFIXES or file.name in PROJECT_FILES or file.name.startswith("."):
        return False
    return file.is_file() and file.resolve().is_relative_to(folder.resolve())


def _is_design(file: Path, folder: Path) -> bool:
    return _is_candidate(file, folder) and _looks_like_design(_read_bytes(file))


def _looks_like_design(content: bytes) -> bool:
    # Without the zeros that other encodings put between the letters: such a file is told of, not passed over.
    return bool(_LOOKS_LIKE_DESIGN.search(content.replace(b"\0", b"")))
