"""Compares the comments of designs with those of the XABSL files: place by place, a line of a design file each."""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from vicode.findings import DesignPath
from vicode.importers import ImportResult, PlacedComment
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.model.xabsl.names import component_name
from vicode.services.imported_behavior.comment_paths import PathMap, map_design, map_project
from vicode.store import CommentedFile

PlaceKey = tuple[str, int]
"""The component of a design, "" for project.yaml, and a line of its file."""


@dataclass(frozen=True, slots=True)
class XabslComment:
    """A comment with the file that contains it."""

    file: Path
    comment: PlacedComment

    @property
    def lines(self) -> tuple[str, ...]:
        """Its lines as a design shows them."""
        return tuple(line for line in map(_shown, self.comment.text.splitlines()) if line)


@dataclass(slots=True)
class CommentPlace:
    """A line of a design file with the comments above it there and in XABSL.

    Attributes:
        key: The design and the line.
        start: The XABSL file and the token before which comments of this place are written; None if there is none.
        comments: The comments in XABSL.
        wanted: The lines of the comments in the design, with their line numbers.
        is_exact: Whether the design and XABSL have the same structure here, so that new comments have a place.
        header_file: The XABSL file if the place is the start of its design.
    """

    key: PlaceKey
    start: tuple[Path, int] | None = None
    comments: list[XabslComment] = field(default_factory=list)
    wanted: list[tuple[str, int]] = field(default_factory=list)
    is_exact: bool = True
    header_file: Path | None = None

    @property
    def is_header(self) -> bool:
        return self.header_file is not None

    @property
    def wanted_lines(self) -> list[str]:
        return [text for text, _line in self.wanted]

    @property
    def present_lines(self) -> list[str]:
        return [line for comment in self.comments for line in comment.lines]

    @property
    def is_equal(self) -> bool:
        return self.present_lines == self.wanted_lines

    def missing(self) -> list[tuple[str, int]]:
        """The lines of the design that XABSL does not have, with their line numbers."""
        present, missing = Counter(self.present_lines), []
        for text, line in self.wanted:
            if present[text]:
                present[text] -= 1
            else:
                missing.append((text, line))
        return missing


class DesignComments:
    """The comments of the files of a project."""

    def __init__(self, project: Project, texts: Mapping[str, str]) -> None:
        self.project = project
        self._files = {name: CommentedFile(text, is_project_file=not name) for name, text in texts.items()}

    def compare(self, imported: ImportResult) -> list[CommentPlace]:
        """The places with comments in a design or in the import of its XABSL files."""
        places: list[CommentPlace] = []
        if "" in self._files:
            places += self._project_places(imported)
        ours = {component_name(design): design for design in self.project.designs}
        for design, about in zip(imported.project.designs, imported.designs, strict=True):
            other = ours.get(component_name(design))
            if other is not None and other.component in self._files:
                found = _FilePlaces(other.component, self._files[other.component], map_design(design, other))
                found.add_header(about.file)
                found.add_starts(about.file, about.places.starts)
                found.add_comments([XabslComment(about.file, each) for each in about.comments])
                found.remove_docs(other)
                places += found.places()
        return places

    def _project_places(self, imported: ImportResult) -> Iterator[CommentPlace]:
        found = _FilePlaces("", self._files[""], map_project(imported.project, self.project))
        known = [each for file in imported.declaration_files for each in file.comments]
        main = next((file.file for file in imported.declaration_files), Path())
        found.add_comments([XabslComment(main, each) for each in imported.comments if each not in known])
        for file in imported.declaration_files:
            found.add_starts(file.file, file.places.starts)
            found.add_comments([XabslComment(file.file, each) for each in file.comments])
        return found.places()


class _FilePlaces:
    """Collects the places of one design file."""

    def __init__(self, component: str, commented: CommentedFile, paths: PathMap) -> None:
        self.component, self.commented, self.paths = component, commented, paths
        self._places: dict[int, CommentPlace] = {}
        self._inexact: set[int] = set()

    def add_header(self, file: Path) -> None:
        self._place(()).header_file = file

    def add_starts(self, file: Path, starts: Mapping[DesignPath, int]) -> None:
        for path, token in starts.items():
            place = self._place(path)
            if place.start is None or (place.start[0] == file and token < place.start[1]):
                place.start = (file, token)

    def add_comments(self, comments: list[XabslComment]) -> None:
        for each in comments:
            self._place(each.comment.path).comments.append(each)

    def remove_docs(self, design: Design) -> None:
        """Leave out the comments that the design has as descriptions of its states."""
        for state in design.states:
            place = self._places.get(self.commented.line_of(("states", state.name)))
            if place is not None and state.doc:
                _remove_words(place.comments, state.doc.split())

    def places(self) -> Iterator[CommentPlace]:
        blocks = [self.commented.block_of(line) for line in sorted(self._inexact)]
        for each in self.commented.comments:
            line = each.content_line
            block = next((block for block in blocks if line in block and line not in self._places), None)
            place = self._at(block.start if block else line)
            if _shown(each.text):
                place.wanted.append((_shown(each.text), each.line))
        return (place for place in self._places.values() if place.comments or place.wanted)

    def _place(self, path: DesignPath) -> CommentPlace:
        place = self._at(self.commented.line_of(self.paths.translate(path)))
        if not self.paths.is_exact(path):
            place.is_exact = False
            self._inexact.add(place.key[1])
        return place

    def _at(self, line: int) -> CommentPlace:
        return self._places.setdefault(line, CommentPlace((self.component, line)))


def _remove_words(comments: list[XabslComment], words: list[str]) -> None:
    """Remove consecutive comments that together have these words."""
    for first in range(len(comments)):
        for last in range(first + 1, len(comments) + 1):
            if " ".join(each.comment.text for each in comments[first:last]).split() == words:
                del comments[first:last]
                return


def _shown(line: str) -> str:
    """A line of a comment as the import writes it to a design."""
    return "".join(char if char.isprintable() else " " for char in line).rstrip()
