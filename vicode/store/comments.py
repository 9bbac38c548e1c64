"""Inserts YAML comments above nodes of a file, and reads them."""

import re
from bisect import bisect_left
from collections import Counter, deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property

from vicode.findings import DesignPath
from vicode.store.documents import read_record
from vicode.store.format import DESIGN
from vicode.store.line_index import ReadReport
from vicode.store.project_format import PROJECT
from vicode.store.schema_types import RecordSchema
from vicode.store.source_map import SourceMap
from vicode.store.typed_node import TypedNode
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar, parse_yaml

PathComment = tuple[DesignPath, str]
"""The path of a node, empty for the whole file, and the text of its comment."""

_COMMENT = re.compile(r"(?:^|(?<=\s))#[^\r\n]*", re.MULTILINE)


@dataclass(frozen=True, slots=True, kw_only=True)
class FileComment:
    """A line of a comment in a file; `content_line` is the line of the content it belongs to."""

    text: str
    line: int
    content_line: int


class CommentedFile:
    """The comments of a design or project file, and the lines of its nodes."""

    def __init__(self, text: str, *, is_project_file: bool = False) -> None:
        self._report, root = read_record(text, "", PROJECT if is_project_file else DESIGN)
        self._source = SourceMap(file="", line_index=self._report.line_index, root=root)
        lines = self._report.line_index.text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
        self._indents = [(number, _indent(line)) for number, line in enumerate(lines, 1) if _is_content(line)]
        self.comments = tuple(self._read_comments())

    @property
    def root(self) -> TypedNode | None:
        """None if the text is not readable."""
        return self._source.root

    @property
    def is_readable(self) -> bool:
        return self.root is not None

    def line_of(self, path: DesignPath) -> int:
        """The line above which `add_comments` writes a comment of a node."""
        if not path:
            return self._indents[0][0] if self._indents else 1
        return self._source.locate(path, of_key=True).line

    def path_at(self, line: int) -> DesignPath:
        """The path of the outermost node that starts in a line; empty if there is none."""
        return next((path for path, _node in self._nodes_by_line.get(line, ())), ())

    def owner_of(self, comment: FileComment) -> DesignPath:
        """The path of the node that a comment is beside, or above; empty if there is none."""
        nodes = self._nodes_by_line.get(comment.content_line, [])
        if comment.line != comment.content_line or not nodes:
            return self.path_at(comment.content_line)
        ended = (path for path, node in nodes if self._end_line(node) == comment.line)
        return next(ended, nodes[-1][0])

    def _end_line(self, node: TypedNode) -> int:
        return self._report.line_index.locate(node.node.end, node.node.end).line

    @cached_property
    def _nodes_by_line(self) -> dict[int, list[tuple[DesignPath, TypedNode]]]:
        """The nodes that start in each line, the outermost first."""
        found: dict[int, list[tuple[DesignPath, TypedNode]]] = {}
        pending: deque[tuple[DesignPath, TypedNode]] = deque([((), self.root)] if self.root else [])
        while pending:
            path, node = pending.popleft()
            if path:
                found.setdefault(self.line_of(path), []).append((path, node))
            pending += [((*path, step), child) for step, child in node.children.items()]
        return found

    def block_of(self, line: int) -> range:
        """The lines of the node that starts in a line."""
        first = bisect_left(self._indents, (line, -1))
        _number, indent = self._indents[first]
        for number, each in self._indents[first + 1 :]:
            if each < indent or (each == indent and not self._is_item(number)):
                return range(line, number)
        return range(line, self._indents[-1][0] + 1)

    def _is_item(self, line: int) -> bool:
        start = self._report.line_index.line_starts[line - 1]
        return self._report.line_index.text[start:].lstrip(" ").startswith("-")

    def _read_comments(self) -> Iterator[FileComment]:
        index = self._report.line_index
        root = self.root.node if self.root else parse_yaml(index.text, ReadReport(line_index=index)).root
        end = 0
        for start, after in [*_scalar_spans(root), (len(index.text), len(index.text))]:
            for match in _COMMENT.finditer(index.text, end, start):
                location = index.locate(match.start(), match.end())
                words = match[0].removeprefix("#").removeprefix(" ").rstrip()
                content_line = self._content_line(location.line, location.column - 1)
                yield FileComment(text=words, line=location.line, content_line=content_line)
            end = max(end, after)

    def _content_line(self, line: int, indent: int) -> int:
        """The line that a comment belongs to: its own, the next one, or the one above if that is less indented."""
        following = bisect_left(self._indents, (line, -1))
        if following < len(self._indents):
            number, next_indent = self._indents[following]
            if number == line or next_indent >= indent:
                return number
        above = (number for number, each in reversed(self._indents[:following]) if each <= indent)
        return next(above, self._indents[0][0] if self._indents else 1)


def merge_comments(base: str, merged: str, theirs: str, *, is_project_file: bool = False) -> str:
    """Bring the comments that their side added or removed into a merged text.

    An added comment is written above the node that it has there, or above its nearest ancestor in the merged text.
    """
    versions = [CommentedFile(text, is_project_file=is_project_file) for text in (base, theirs)]
    old, new = (Counter(comment.text for comment in version.comments) for version in versions)
    if CommentedFile(merged, is_project_file=is_project_file).is_readable:
        merged = _without_comments(merged, old - new, is_project_file=is_project_file)
        present = Counter(comment.text for comment in CommentedFile(merged, is_project_file=is_project_file).comments)
    else:
        # With conflicts marked in it, the text is no YAML.
        lines = (line.strip() for line in merged.splitlines())
        present = Counter(line.removeprefix("#").removeprefix(" ") for line in lines if line.startswith("#"))
    missing = (new - old) - (present - old)
    added = []
    for comment in versions[1].comments:
        if missing[comment.text]:
            missing[comment.text] -= 1
            added.append((versions[1].path_at(comment.content_line), comment.text))
    return add_comments(merged, added, is_project_file=is_project_file) if added else merged


def _without_comments(text: str, removed: Counter[str], *, is_project_file: bool) -> str:
    """Remove the lines of comments that occur only as often as they were removed."""
    comments = CommentedFile(text, is_project_file=is_project_file).comments
    counts = Counter(comment.text for comment in comments)
    lines = text.split("\n")
    doomed = {
        comment.line - 1
        for comment in comments
        if counts[comment.text] <= removed[comment.text] and lines[comment.line - 1].lstrip().startswith("#")
    }
    return "\n".join(line for index, line in enumerate(lines) if index not in doomed)


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


def _is_content(line: str) -> bool:
    return bool(line.strip()) and not line.lstrip().startswith("#")


def _scalar_spans(root: YamlNode | None) -> list[tuple[int, int]]:
    """The offsets of all scalars in the order of the file."""
    spans, pending = [], [root] if root else []
    while pending:
        node = pending.pop()
        match node:
            case YamlScalar():
                spans.append((node.start, node.end))
            case YamlMapping():
                pending += [item for pair in node.pairs for item in pair]
            case _:
                pending += node.items
    return sorted(spans)


def add_comments(text: str, comments: Iterable[PathComment], *, is_project_file: bool = False) -> str:
    """Insert comments into the text of a design or project file without changing its value.

    If a path does not exist, the comment is inserted above the nearest existing ancestor.
    """
    schema = PROJECT if is_project_file else DESIGN
    report, root = read_record(text, "", schema)
    source = SourceMap(file="", line_index=report.line_index, root=root)
    lines = text.split("\n")
    above: dict[int, list[str]] = {}
    for path, comment in comments:
        index = source.locate(path, of_key=True).line - 1 if path else 0
        above.setdefault(index, []).extend(_format_comment(comment, lines[index] if path else ""))
    commented = "\n".join(line for index, old in enumerate(lines) for line in (*above.get(index, ()), old))
    if _read_value(commented, schema) == (root.value if root else None, report.findings):
        return commented
    # In a multi-line text, the comment would be part of the value: write all comments at the start of the file.
    return "\n".join([*(line.strip() for comments in above.values() for line in comments), text])


def _format_comment(comment: str, next_line: str) -> list[str]:
    indent = next_line[: len(next_line) - len(next_line.lstrip(" "))]
    printable = ("".join(char if char.isprintable() else " " for char in line) for line in comment.splitlines())
    return [f"{indent}# {line}".rstrip() for line in printable]


def _read_value(text: str, schema: RecordSchema) -> object:
    report, root = read_record(text, "", schema)
    return (root.value if root else None, report.findings)
