"""Opens folders: finds project.yaml and the designs that belong to it, and reads them all."""

import errno
import os
import re
import stat
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from vicode.findings import Finding, Note, rule, sort_findings
from vicode.model.names import name_like
from vicode.model.project import Project
from vicode.store.documents import (
    PROJECT_FILES,
    ReadDesign,
    default_name,
    read_design,
    read_project_file,
)
from vicode.store.lines import Lines, Report
from vicode.store.nodes import MAXIMUM_BYTES
from vicode.store.sources import SourceMap

SUFFIXES = (".yaml", ".yml")
_LOOKS_LIKE_DESIGN = re.compile(rb"^(vicode|component|states)[ \t]*:", re.MULTILINE)
_COMPONENT = re.compile(rb"^component[ \t]*:[ \t]*[\"']?([A-Za-z]\w*)", re.MULTILINE)
_SKIPPED_FOLDERS = {"node_modules", "__pycache__", "site-packages"}
_LEVELS_ABOVE = 8
# What each file said when it was read last, by its content and the name that messages give it.
_MOST_KNOWN = 4096
_known: dict[Path, tuple[bytes, str, ReadDesign]] = {}


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenProject:
    """A project as it stands on disk.

    `files`, `sources` and `texts` are by component; "" stands for project.yaml, if there is one. `broken` are files
    that are meant to be designs, but hold none that can be read. `findings` are mistakes of reading, with places.
    """

    project: Project
    folder: Path
    files: Mapping[str, Path]
    sources: Mapping[str, SourceMap]
    texts: Mapping[str, str]
    broken: tuple[Path, ...]
    findings: tuple[Finding, ...]

    @property
    def project_file(self) -> Path | None:
        """The project.yaml, None when the project does without."""
        return self.files.get("")

    def component_of(self, path: Path) -> str | None:
        """The component whose design a file holds, None when it holds none of this project."""
        wanted = path.resolve()
        return next((name for name, file in self.files.items() if name and file.resolve() == wanted), None)


def open_project(path: Path | str) -> OpenProject:
    """Open the project of a folder, or the one that a design file belongs to.

    Raises:
        OSError: The path does not exist or cannot be read.
    """
    given = Path(path)
    folder = given if given.is_dir() else _folder_of(given)
    listed = list(design_files(folder))
    if not given.is_dir() and given.name not in PROJECT_FILES:
        given.stat()
        listed += [given] if given.resolve() not in {file.resolve() for file in listed} else []
    opening = _Opening(folder)
    opening.read_project_file()
    for file in listed:
        opening.read_design(file, is_meant=not given.is_dir() and file.resolve() == given.resolve())
    return opening.result()


def find_projects(folder: Path | str) -> tuple[Path, ...]:
    """The folders of all projects in a folder, in order; of a design file the one it belongs to."""
    top = Path(folder)
    if not top.is_dir():
        return (_folder_of(top),)
    found = {Path(place) for place, _folders, names in _walk(top) if set(names) & set(PROJECT_FILES)}
    loose = [
        Path(place)
        for place, _folders, names in _walk(top)
        if not any(_is_inside(Path(place), project) for project in found)
        and any(_is_design(Path(place) / name, top) for name in names)
    ]
    for place in loose:
        if not any(_is_inside(place, project) for project in found):
            found.add(place)
    return tuple(sorted(found))


def design_files(folder: Path) -> tuple[Path, ...]:
    """The files of a folder's own designs, those of projects inside it left out."""
    files: list[Path] = []
    for place, folders, names in _walk(folder):
        folders[:] = [name for name in folders if not _holds_project(Path(place) / name)]
        files += [Path(place) / name for name in names if _is_candidate(Path(place) / name, folder)]
    return tuple(sorted(files))


def project_file_in(folder: Path) -> Path | None:
    """The project.yaml of a folder."""
    return next((folder / name for name in PROJECT_FILES if (folder / name).is_file()), None)


def shown_path(path: Path) -> str:
    """A path as messages name it: relative where that is shorter to read."""
    relative = os.path.relpath(path)
    return str(path) if relative.startswith("..") else relative


class _Opening:
    """Reads file by file and collects."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.project = Project(name=default_name(folder.resolve().name), generated=_default_output(folder))
        self.files: dict[str, Path] = {}
        self.reads: dict[str, ReadDesign] = {}
        self.sources: dict[str, SourceMap] = {}
        self.texts: dict[str, str] = {}
        self.broken: list[Path] = []
        self.unread: list[tuple[str, str]] = []
        self.findings: list[Finding] = []

    def read_project_file(self) -> None:
        """Read project.yaml, if there is one."""
        file = project_file_in(self.folder)
        if file is None:
            return
        read = read_project_file(_content(file), shown_path(file))
        self.findings += read.findings
        self.project = read.project or self.project
        self.files[""], self.sources[""], self.texts[""] = file, read.source, read.source.lines.text

    def read_design(self, file: Path, *, is_meant: bool) -> None:
        """Read a design; a file that looks like something else counts only when it `is_meant`."""
        try:
            content = _content(file)
        except OSError as error:
            self._add_unreadable(file, error)
            return
        if not is_meant and not _looks_like_design(content):
            return
        read = _read_again(file, content)
        self.findings += read.findings
        if read.design is None:
            self._add_broken(file, content)
        elif read.design.component in self.reads:
            self._add_duplicate(file, read)
        else:
            name = read.design.component
            self.reads[name], self.files[name] = read, file
            self.sources[name], self.texts[name] = read.source, read.source.lines.text

    def _add_broken(self, file: Path, content: bytes) -> None:
        said = _COMPONENT.search(content)
        name = said[1].decode() if said else name_like(file.stem.replace("_", " "))
        self.broken.append(file)
        self.unread.append((name, file.name))

    def result(self) -> OpenProject:
        """All of it."""
        designs = tuple(read.design for read in self.reads.values() if read.design is not None)
        return OpenProject(
            project=replace(self.project, designs=designs, unread=tuple(self.unread)),
            folder=self.folder,
            files=self.files,
            sources=self.sources,
            texts=self.texts,
            broken=tuple(self.broken),
            findings=sort_findings(self.findings),
        )

    def _add_duplicate(self, file: Path, read: ReadDesign) -> None:
        assert read.design is not None
        name = read.design.component
        first = Note(message="first here", place=self.sources[name].place(("component",)))
        finding = Finding(
            rule=rule("P201"),
            message=f"there is another component '{name}'",
            mend="rename one of them",
            place=read.source.place(("component",)),
            notes=(first,),
        )
        self.findings.append(finding)
        self.broken.append(file)

    def _add_unreadable(self, file: Path, error: OSError) -> None:
        report = Report(lines=Lines("", shown_path(file)))
        report.add("Y110", f"the file cannot be read: {error.strerror}", (0, 1))
        self.findings += report.findings
        self._add_broken(file, b"")


def _read_again(file: Path, content: bytes) -> ReadDesign:
    """Read a design; a file that says what it said before is not parsed anew: large projects open again at once."""
    place, shown = file.absolute(), shown_path(file)
    known = _known.get(place)
    if known is not None and known[:2] == (content, shown):
        return known[2]
    if len(_known) >= _MOST_KNOWN:
        _known.clear()
    read = read_design(content, shown)
    _known[place] = (content, shown, read)
    return read


def _content(file: Path) -> bytes:
    # A pipe would keep us waiting, and a device may never end.
    if not stat.S_ISREG(file.stat().st_mode):
        raise OSError(errno.EINVAL, "it is no regular file", str(file))
    # One byte more than is allowed tells that it is too much.
    with file.open("rb") as stream:
        return stream.read(MAXIMUM_BYTES + 1)


def _folder_of(file: Path) -> Path:
    """The folder of the project that a design file belongs to."""
    beside = file.parent
    folder = beside.resolve()
    for _level in range(_LEVELS_ABOVE):
        found = project_file_in(folder)
        if found is not None and (folder == beside.resolve() or _looks_like_design(_content(found))):
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


def _walk(folder: Path) -> Iterator[tuple[str, list[str], list[str]]]:
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith(".") and name not in _SKIPPED_FOLDERS)
        yield place, folders, sorted(names)


def _holds_project(folder: Path) -> bool:
    return project_file_in(folder) is not None


def _is_inside(path: Path, folder: Path) -> bool:
    return path == folder or folder in path.parents


def _is_candidate(file: Path, folder: Path) -> bool:
    if file.suffix not in SUFFIXES or file.name in PROJECT_FILES or file.name.startswith("."):
        return False
    return file.is_file() and file.resolve().is_relative_to(folder.resolve())


def _is_design(file: Path, folder: Path) -> bool:
    return _is_candidate(file, folder) and _looks_like_design(_content(file))


def _looks_like_design(content: bytes) -> bool:
    # Without the zeros that other encodings put between the letters: such a file is told of, not passed over.
    return bool(_LOOKS_LIKE_DESIGN.search(content.replace(b"\0", b"")))
