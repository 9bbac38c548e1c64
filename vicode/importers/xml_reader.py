"""Reads XML as a tree with line numbers. Document types and entities are refused, and nothing is loaded."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from typing import Any
from xml.parsers import expat

from vicode.importers.sources import SourceError

_MAX_BYTES = 2_000_000
_MAX_DEPTH = 60
# Where an editor finds the schema of the document.
_XSI = "http://www.w3.org/2001/XMLSchema-instance "


@dataclass(slots=True, kw_only=True)
class Element:
    """An element; `tag` has no namespace. It records which attributes and children are read."""

    tag: str
    attributes: dict[str, str]
    line: int
    children: list["Element"] = field(default_factory=list)
    text_line: int = 0
    """The line of its text, 0 if it has none."""
    is_reported: bool = False
    """Whether it is left out of `unread`, with all that it contains."""
    _read: set[str] = field(default_factory=set, compare=False)
    _is_read: bool = field(default=False, compare=False)

    def get(self, name: str, default: str = "") -> str:
        """Read an attribute."""
        self._read.add(name)
        return self.attributes.get(name, default)

    def find(self, *tags: str) -> Iterator["Element"]:
        """Read the children with these tags, all without tags."""
        for child in self.children:
            if child.tag in tags or not tags:
                child._is_read = True
                yield child

    def unread(self, known: Collection[str] = ()) -> Iterator[tuple[int, str]]:
        """What was not read, as pairs of line and text, without attributes that are `known` to mean nothing."""
        if self.is_reported:
            return
        names = ", ".join(f"'{each}'" for each in self.attributes if each not in (*known, *self._read))
        if names:
            yield self.line, f"not in the design: {names} of <{self.tag}>"
        if self.text_line:
            yield self.text_line, f"not in the design: the text of <{self.tag}>"
        for child in self.children:
            if child._is_read:
                yield from child.unread(known)
            elif not child.is_reported:
                yield child.line, f"not in the design: <{child.tag}>"


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
        return (round(float(element.get("x"))), round(float(element.get("y"))))
    except (ValueError, OverflowError):
        return None


class _Reader:
    def __init__(self, namespace: str, codes: tuple[str, str]) -> None:
        self.root: Element | None = None
        self._namespaces, self._codes = ("", namespace), codes
        self._open: list[Element] = []
        self.parser = expat.ParserCreate(namespace_separator=" ")
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text
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
        plain = {key.replace(" ", ":"): value for key, value in attributes.items() if not key.startswith(_XSI)}
        element = Element(tag=tag, attributes=plain, line=line)
        if self._open:
            self._open[-1].children.append(element)
        else:
            self.root = element
        self._open.append(element)

    def _end(self, _name: str) -> None:
        self._open.pop()

    def _text(self, text: str) -> None:
        if text.strip() and self._open and not self._open[-1].text_line:
            self._open[-1].text_line = self.parser.CurrentLineNumber

    def _refuse(self, *_arguments: Any) -> None:
        raise SourceError(
            self._codes[0], "document types and entities are refused", self.parser.CurrentLineNumber, "remove it"
        )
