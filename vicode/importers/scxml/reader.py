"""Reads SCXML as a tree with line numbers. Document types and entities are refused, and nothing is loaded."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.parsers import expat

from vicode.findings import Finding, SourceLocation, get_rule

NAMESPACE = "http://www.w3.org/2005/07/scxml"
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


class ScxmlError(Exception):
    """The document cannot be imported; `finding` says why and where."""

    def __init__(self, code: str, message: str, line: int, fix: str = "") -> None:
        super().__init__(message)
        self.code, self.message, self.line, self.fix = code, message, line, fix

    def finding(self, file: Path) -> Finding:
        location = SourceLocation(file=str(file), line=self.line, column=1)
        return Finding(rule=get_rule(self.code), message=self.message, fix=self.fix, location=location)


def read_scxml(data: bytes) -> Element:
    """Parse a document.

    Raises:
        ScxmlError: It is not well-formed, declares entities, or is not SCXML.
    """
    if len(data) > _MAX_BYTES:
        raise ScxmlError("S801", f"the file is larger than {_MAX_BYTES} bytes", 1)
    reader = _Reader()
    try:
        reader.parser.Parse(data, True)
    except expat.ExpatError as error:
        raise ScxmlError("S801", f"not well-formed XML: {expat.ErrorString(error.code)}", error.lineno) from error
    root = reader.root
    if root is None or root.tag != "scxml":
        raise ScxmlError("S801", "the root element is not <scxml>", 1)
    return root


class _Reader:
    def __init__(self) -> None:
        self.root: Element | None = None
        self._open: list[Element] = []
        self.parser = expat.ParserCreate(namespace_separator=" ")
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.StartDoctypeDeclHandler = self._refuse
        self.parser.EntityDeclHandler = self._refuse

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        namespace, _space, tag = name.rpartition(" ")
        line = self.parser.CurrentLineNumber
        if namespace not in ("", NAMESPACE):
            raise ScxmlError("S802", f"<{tag}> of another namespace has no meaning in designs", line, "remove it")
        if len(self._open) >= _MAX_DEPTH:
            raise ScxmlError("S801", "elements are nested too deeply", line)
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
        raise ScxmlError("S801", "document types and entities are refused", self.parser.CurrentLineNumber, "remove it")
