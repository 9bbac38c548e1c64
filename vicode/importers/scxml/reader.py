"""Reads SCXML as a tree with line numbers."""

from vicode.importers.sources import SourceError
from vicode.importers.xml_reader import Element, read_xml

NAMESPACE = "http://www.w3.org/2005/07/scxml"


class ScxmlError(SourceError):
    """The document cannot be imported as a design."""


def read_scxml(data: bytes) -> Element:
    """Parse a document.

    Raises:
        ScxmlError: It is not well-formed, declares entities, or is not SCXML.
    """
    try:
        return read_xml(data, ("scxml",), NAMESPACE, ("S801", "S802"))
    except SourceError as error:
        raise ScxmlError(error.code, error.message, error.line, error.fix) from error
