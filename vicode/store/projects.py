"""Opens projects: finds project.yaml and the design files of a folder, and reads them."""

import contextlib
import errno
import os
import re
import stat
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path, PurePath

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
_LOOKS_LIKE_PROJECT = re.compile(rb"^project[ \t]*:", re.MULTILINE)
_COMPONENT = re.compile(rb"^component[ \t]*:[ \t]*[\"']?([A-Za-z]\w*)", re.MULTILINE)
_SKIPPED_FOLDERS = {"node_modules", "__pycache__", "site-packages"}
DEPLOYED_MARKER = ".vicode-deployed"
"""The file that marks a deployed program: its designs are copies. A folder without it is never replaced."""
_MAX_PARENT_FOLDERS = 8
# The last result for each file, with its content and display name.
_MAX_CACHED = 4096
_read_cache: dict[Path, tuple[bytes, str, DesignReadResult]] = {}


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenProject:
    """A project as read from disk.

    Attributes:
        files: Files by component, with "" for project.yaml; `sources` and `texts` have the same keys.
        broken_files: Design files that cannot be read.
        findings: Errors in the files, with locations.
        is_project_file_broken: Whether project.yaml cannot be read; it is not among the `broken_files`, as it belongs
            to all designs.
    """

    project: Project
    folder: Path
    files: Mapping[str, Path]
    sources: Mapping[str, SourceMap]
    texts: Mapping[str, str]
    broken_files: tuple[Path, ...]
    findings: tuple[Finding, ...]
    is_project_file_broken: bool = False

    @property
    def design_paths(self) -> dict[str, str]:
        return relative_design_paths(self.files, self.folder)

    def find_component(self, path: Path) -> str | None:
        """The component with this design file, None if the project has no such file."""
        resolved = path.resolve()
        return next((name for name, file in self.files.items() if name and file.resolve() == resolved), None)


def relative_design_paths(files: Mapping[str, Path], folder: Path) -> dict[str, str]:
    """The paths of designs by component, relative to the folder of their project; the name of a file that is outside.

    Args:
        files: Files by component, with "" for project.yaml.
        folder: The folder of the project.
    """
    folder = folder.resolve()
    resolved = {name: path.resolve() for name, path in files.items() if name}
    return {
        name: path.relative_to(folder).as_posix() if path.is_relative_to(folder) else path.name
        for name, path in resolved.items()
    }


def open_project(path: Path | str) -> OpenProject:
    """Open the project of a folder or of a design file.

    Raises:
        OSError: The path does not exist or cannot be read.
    """
    path = Path(path)
    folder = path if path.is_dir() else _find_project_folder(path)
    files = list(find_design_files(folder))
    if not path.is_dir() and path.name not in PROJECT_FILES:
        path.stat()
        files += [path] if path.resolve() not in {file.resolve() for file in files} else []
    loader = _ProjectLoader(folder)
    loader.read_project_file()
    for file in files:
        loader.read_design(file, is_explicit=not path.is_dir() and file.resolve() == path.resolve())
    return loader.result()


def find_projects(folder: Path | str) -> tuple[Path, ...]:
    """Find the folders of all projects in a folder, or the project folder of a design file."""
    top = Path(folder)
    if not top.is_dir():
        return (_find_project_folder(top),)
    projects = {Path(path) for path, _folders, names in _walk_visible_folders(top) if set(names) & set(PROJECT_FILES)}
    design_folders = [
        Path(path)
        for path, _folders, names in _walk_visible_folders(top)
        if not any(_is_inside(Path(path), project) for project in projects)
        and any(_is_design(Path(path) / name, top) for name in names)
    ]
    for design_folder in design_folders:
        if not any(_is_inside(design_folder, project) for project in projects):
            projects.add(design_folder)
    return tuple(sorted(projects))


def folder_times(folder: Path) -> frozenset[tuple[str, int]]:
    """The folders in which projects are searched, with their modification times."""
    found = set()
    for path, _folders, _names in _walk_visible_folders(folder):
        with contextlib.suppress(OSError):
            found.add((path, Path(path).stat().st_mtime_ns))
    return frozenset(found)


def is_file_taken(file: Path) -> bool:
    """Whether a new design file would be the same as another or project.yaml on a file system that ignores case."""
    return file.name.casefold() in {*PROJECT_FILES, *(each.name.casefold() for each in file.parent.iterdir())}


def find_design_files(folder: Path) -> tuple[Path, ...]:
    """Find the design files in and below a folder, except those of nested projects."""
    files: list[Path] = []
    for path, folders, names in _walk_visible_folders(folder):
        folders[:] = [name for name in folders if not _holds_project(Path(path) / name)]
        files += [Path(path) / name for name in names if _is_candidate(Path(path) / name, folder)]
    return tuple(sorted(files))


def find_project_file(folder: Path) -> Path | None:
    return next((folder / name for name in PROJECT_FILES if (folder / name).is_file()), None)


def looks_like_design(content: bytes) -> bool:
    """Whether a file has a key of designs or of project.yaml at its top level."""
    # Zero bytes are removed so that a UTF-16 file is recognized and reported.
    return bool(_LOOKS_LIKE_DESIGN.search(content.replace(b"\0", b"")))


def is_project_text(name: str, content: bytes) -> bool:
    """Whether a text is that of a project.yaml, by its name or, for a copy with another name, by its keys."""
    return PurePath(name).name in PROJECT_FILES or bool(
        _LOOKS_LIKE_PROJECT.search(content) and not _COMPONENT.search(content)
    )


def read_python_module(folder: Path, name: str) -> tuple[str, str] | None:
    """Read the source of a module of a project.

    Returns:
        The path for messages and the text; None if the folder does not contain the module.
    """
    base = folder.joinpath(*name.split("."))
    for file in (base.with_suffix(".py"), base / "__init__.py"):
        if file.is_file():
            try:
                return display_path(file), _read_bytes(file).decode("utf-8")
            except (OSError, UnicodeDecodeError):
                return None
    return None


def display_path(path: Path) -> str:
    """The path for messages: relative if it is below the working directory."""
    relative = os.path.relpath(path)
    return str(path) if relative.startswith("..") else relative


class _ProjectLoader:
    """Reads the files of a project and collects the results."""

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
        self.is_project_file_broken = False

    def read_project_file(self) -> None:
        file = find_project_file(self.folder)
        if file is None:
            return
        read = read_project_file(_read_bytes(file), display_path(file))
        self.findings += read.findings
        self.project = read.project or self.project
        self.is_project_file_broken = read.project is None
        self.files[""], self.sources[""], self.texts[""] = file, read.source_map, read.source_map.line_index.text

    def read_design(self, file: Path, *, is_explicit: bool) -> None:
        """Read a design file. A file that does not look like a design is skipped unless `is_explicit`."""
        try:
            content = _read_bytes(file)
        except OSError as error:
            self._add_unreadable(file, error)
            return
        if not is_explicit and not looks_like_design(content):
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
        match = _COMPONENT.search(content)
        name = match[1].decode() if match else name_from_text(file.stem.replace("_", " "))
        self.broken_files.append(file)
        self.unread.append((name, file.name))

    def result(self) -> OpenProject:
        designs = tuple(read.design for read in self.reads.values() if read.design is not None)
        return OpenProject(
            project=replace(self.project, designs=designs, unreadable=tuple(self.unread)),
            folder=self.folder,
            files=self.files,
            sources=self.sources,
            texts=self.texts,
            broken_files=tuple(self.broken_files),
            findings=sort_findings(self.findings),
            is_project_file_broken=self.is_project_file_broken,
        )

    def _add_duplicate(self, file: Path, read: DesignReadResult) -> None:
        assert read.design is not None
        name = read.design.component
        first = Note(message="first defined here", location=self.sources[name].locate(("component",)))
        finding = Finding(
            rule=get_rule("P201"),
            message=f"duplicate component '{name}'",
            fix="rename one of the components",
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
    """Read a design, or return the cached result if the file has not changed, so that large projects reopen fast."""
    path, name = file.absolute(), display_path(file)
    cached = _read_cache.get(path)
    if cached is not None and cached[:2] == (content, name):
        return cached[2]
    if len(_read_cache) >= _MAX_CACHED:
        _read_cache.clear()
    result = read_design(content, name)
    _read_cache[path] = (content, name, result)
    return result


def _read_bytes(file: Path) -> bytes:
    # Reading a pipe blocks, and a device may be endless.
    if not stat.S_ISREG(file.stat().st_mode):
        raise OSError(errno.EINVAL, "it is not a regular file", str(file))
    # One more byte shows that the file exceeds the limit.
    with file.open("rb") as stream:
        return stream.read(MAX_BYTES + 1)


def _find_project_folder(file: Path) -> Path:
    """The project folder of a design file: its own folder, or a parent with a project.yaml."""
    own_folder = file.parent
    folder = own_folder.resolve()
    for _level in range(_MAX_PARENT_FOLDERS):
        project_file = find_project_file(folder)
        if project_file is not None and (
            folder == own_folder.resolve() or looks_like_design(_read_bytes(project_file))
        ):
            return own_folder if folder == own_folder.resolve() else folder
        if folder.parent == folder or (folder / ".git").exists():
            break
        folder = folder.parent
    return own_folder


def _default_output(folder: Path) -> str:
    """The default output folder: `generated` in the root of the repository, or else in the project folder."""
    resolved = folder.resolve()
    for ancestor in (resolved, *resolved.parents):
        if (ancestor / ".git").exists():
            return Path(os.path.relpath(ancestor / "generated", resolved)).as_posix()
    return "generated"


def _walk_visible_folders(folder: Path) -> Iterator[tuple[str, list[str], list[str]]]:
    for path, folders, names in os.walk(folder):
        if DEPLOYED_MARKER in names and Path(path) != folder:
            folders.clear()
            continue
        folders[:] = sorted(name for name in folders if not name.startswith(".") and name not in _SKIPPED_FOLDERS)
        yield path, folders, sorted(names)


def _holds_project(folder: Path) -> bool:
    return find_project_file(folder) is not None


def _is_inside(path: Path, folder: Path) -> bool:
    return path == folder or folder in path.parents


def _is_candidate(file: Path, folder: Path) -> bool:
    if file.suffix not in DESIGN_SUFFIXES or file.name in PROJECT_FILES or file.name.startswith("."):
        return False
    return file.is_file() and file.resolve().is_relative_to(folder.resolve())


def _is_design(file: Path, folder: Path) -> bool:
    return _is_candidate(file, folder) and looks_like_design(_read_bytes(file))
