"""Maps paths of a design to locations in its file."""

from dataclasses import dataclass

from vicode.findings import DesignPath, SourceLocation, Span
from vicode.model.design import Design
from vicode.model.lowering import source_path
from vicode.store.line_index import LineIndex
from vicode.store.typed_node import TypedNode, YamlNotation
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar

_ESCAPE_LENGTHS = {"x": 4, "u": 6, "U": 10}


@dataclass(frozen=True, slots=True, kw_only=True)
class SourceMap:
    """The locations of the nodes of one file; paths are those of the lowered `design`, if it is one."""

    file: str
    line_index: LineIndex
    root: TypedNode | None
    design: Design | None = None

    def locate(self, path: DesignPath = (), span: Span | None = None, *, of_key: bool = False) -> SourceLocation:
        """The location of a node or of its nearest existing ancestor.

        Args:
            path: Keys and indices that lead to the node.
            span: Start and end offset in the text of the node.
            of_key: Whether to locate the key of the node.
        """
        read, is_exact = self._find(self._source_path(path))
        if read is None:
            return self.line_index.locate(0, 1)
        node = read.node
        if span is not None and is_exact and not of_key:
            node = _text_node(read)
            if isinstance(node, YamlScalar):
                return self.line_index.locate(*_source_span(self.line_index.text, node, span))
        is_block = not isinstance(node, YamlScalar) and not node.is_flow
        if read.key_node is not None and (of_key or is_block or node.end == node.start or not is_exact):
            node = read.key_node
        elif is_block and isinstance(node, YamlMapping) and node.pairs:
            node = node.pairs[0][0]
        return self.line_index.locate(node.start, node.end)

    def contains(self, path: DesignPath) -> bool:
        return self._find(self._source_path(path))[1]

    def _source_path(self, path: DesignPath) -> DesignPath:
        return source_path(self.design, path) if self.design is not None else path

    def _find(self, path: DesignPath) -> tuple[TypedNode | None, bool]:
        read = self.root
        for step in path:
            child = read.children.get(step) if read is not None else None
            if child is None:
                return read, False
            read = child
        return read, read is not None


def _text_node(read: TypedNode) -> YamlNode:
    """The node that holds the text; for code in several languages, that of the first one."""
    while (
        read.notation in (YamlNotation.FULL, YamlNotation.SHORTHAND)
        and read.children
        and not isinstance(read.node, YamlScalar)
    ):
        read = next(iter(read.children.values()))
    return read.node


def _source_span(text: str, node: YamlScalar, span: Span) -> tuple[int, int]:
    """Convert a span in the text of a scalar to a span in the file."""
    if not node.style and "\n" not in text[node.start : node.end]:
        return node.start + span[0], node.start + max(span[1], span[0] + 1)
    offsets = _offsets(text, node)
    first = offsets[min(max(span[0], 0), len(offsets) - 1)]
    last = offsets[min(max(span[1] - 1, span[0], 0), len(offsets) - 1)]
    return first, max(first, last) + 1


def _offsets(text: str, node: YamlScalar) -> list[int]:
    """The offset in the file of each character of a scalar, followed by the end offset.

    Between two visible characters, the file contains only whitespace and escapes, so a parallel scan of the text and
    the file finds each visible character exactly.
    """
    source = node.start
    if node.style in ("|", ">"):
        line_break = text.find("\n", node.start, node.end)
        source = line_break + 1 if line_break >= 0 else node.end
    elif node.style:
        source += 1
    offsets = []
    for char in node.text:
        is_blank = char in " \t\n"
        while source < node.end and text[source] in " \t\r\n" and not (is_blank and text[source] == char):
            if is_blank and text[source] in "\r\n":
                break
            source += 1
        source = _after_continuation(text, source, node.style)
        offsets.append(min(source, max(node.start, node.end - 1)))
        source += (
            _source_length(text, source, node.style) if not is_blank or text[source : source + 1] in (char, "\\") else 0
        )
    offsets.append(min(source, node.end))
    return offsets


def _after_continuation(text: str, source: int, style: str) -> int:
    """Skip a backslash at the end of a line, which joins two lines of a double-quoted text."""
    is_continued = style == '"' and text[source : source + 1] == "\\" and text[source + 1 : source + 2] in ("\r", "\n")
    if not is_continued:
        return source
    rest = text[source + 1 :]
    return source + 1 + len(rest) - len(rest.lstrip())


def _source_length(text: str, source: int, style: str) -> int:
    """Length in the file of the character at offset `source`."""
    if style == "'" and text[source : source + 2] == "''":
        return 2
    if style == '"' and text[source : source + 1] == "\\":
        return _ESCAPE_LENGTHS.get(text[source + 1 : source + 2], 2)
    return 1
