"""Reads XML as a tree with line numbers. Document types and entities are refused, and nothing is loaded."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from typing import Any
from xml.parsers import expat

from vicode.importers.sources import SourceError

_MAX_BYTES = 2_000_000
_MAX_DEPTH = 60


@dataclass(slots=True, kw_only=True)
class Element:
    """An element; `tag` has no namespace."""

    tag: str
    attributes: dict[str, str]
    line: int
    children: list["Element"] = field(default_factory=list)

    def find(self, *tags: str) -> Iterator["Element"]:
        return (child for child in self.children if child.tag in tags)


def read_xml(
    data: bytes, roots: Collection[str], namespace: str = "", codes: tuple[str, str] = ("S805", "S805")
) -> Element:
    """Parse a document.

    Args:
        data: The content of the file.
        roots: The tags that its root may have.
        namespace: The namespace that elements may have.
        codes: The rules of documents that cannot be read, and of elements of other namespaces.

    Raises:
        SourceError: It is not well-formed, declares entities, or has another root.
    """
    if len(data) > _MAX_BYTES:
        raise SourceError(codes[0], f"the file is larger than {_MAX_BYTES} bytes", 1)
    reader = _Reader(namespace, codes)
    try:
        reader.parser.Parse(data, True)
    except expat.ExpatError as error:
        raise SourceError(codes[0], f"not well-formed XML: {expat.ErrorString(error.code)}", error.lineno) from error
    root = reader.root
    if root is None or root.tag not in roots:
        raise SourceError(codes[0], f"the root element is not {' or '.join(f'<{tag}>' for tag in roots)}", 1)
    return root


def read_position(element: Element) -> tuple[float, float] | None:
    """The attributes `x` and `y` of an element, None if they are no numbers."""
    try:
        return (round(float(element.attributes["x"])), round(float(element.attributes["y"])))
    except (KeyError, ValueError, OverflowError):
        return None


class _Reader:
    def __init__(self, namespace: str, codes: tuple[str, str]) -> None:
        self.root: Element | None = None
        self._namespaces, self._codes = ("", namespace), codes
        self._open: list[Element] = []
        self.parser = expat.ParserCreate(namespace_separator=" ")
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.StartDoctypeDeclHandler = self._refuse
        self.parser.EntityDeclHandler = self._refuse

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        namespace, _space, tag = name.rpartition(" ")
        line = self.parser.CurrentLineNumber
        if namespace not in self._namespaces:
            message = f"<{tag}> of another namespace has no meaning in designs"
            raise SourceError(self._codes[1], message, line, "remove it")
        if len(self._open) >= _MAX_DEPTH:
            raise SourceError(self._codes[0], "elements are nested too deeply", line)
        plain = {key: value for key, value in attributes.items() if " " not in key}
        element = Element(tag=tag, attributes=plain, line=line)
        if self._open:
            self._open[-1].children.append(element)
        else:
            self.root = element
        self._open.append(element)

    def _end(self, _name: str) -> None:
        self._open.pop()

    def _refuse(self, *_arguments: Any) -> None:
        raise SourceError(
            self._codes[0], "document types and entities are refused", self.parser.CurrentLineNumber, "remove it"
        )
