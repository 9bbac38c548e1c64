"""Reads scalars and pairs of numbers, and describes YAML nodes in messages."""

import math
import re

from vicode.findings import DesignPath, did_you_mean
from vicode.store.format_values import VERSION
from vicode.store.line_index import ReadReport
from vicode.store.schema_types import FormatValue, PairSchema, ScalarSchema, ScalarType
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar, YamlSequence

_NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?\Z", re.ASCII)
_BOOLEANS = {"true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}
_MAX_SHOWN_LENGTH = 60
_SCALAR_TYPE_NAMES = {
    ScalarType.TEXT: "a text",
    ScalarType.NAME: "a name",
    ScalarType.EXPRESSION: "an expression",
    ScalarType.NUMBER: "a number greater than 0",
    ScalarType.COUNT: "an integer, 0 or greater",
    ScalarType.BOOLEAN: "true or false",
    ScalarType.TRUE: "true",
    ScalarType.VERSION: "a version",
}


class ScalarReader:
    """Reads the scalars of one file and adds errors to `report`. The read methods return None for invalid nodes."""

    def __init__(self, report: ReadReport) -> None:
        self.report = report

    def read_scalar(self, node: YamlNode, schema: ScalarSchema, path: DesignPath) -> FormatValue | None:
        if not isinstance(node, YamlScalar):
            fix = "quote a text that starts with a bracket" if node.is_flow else ""
            self.report_unexpected(node, _SCALAR_TYPE_NAMES[schema.scalar_type], path, fix)
            return None
        match schema.scalar_type:
            case ScalarType.TEXT:
                return node.text
            case ScalarType.NAME | ScalarType.EXPRESSION:
                return self._read_name_or_expression(node, schema, path)
            case ScalarType.NUMBER:
                return self._read_number(node, path)
            case ScalarType.COUNT:
                return self._read_count(node, path)
            case ScalarType.BOOLEAN | ScalarType.TRUE:
                return self._read_boolean(node, schema.scalar_type, path)
            case ScalarType.VERSION:
                return self._read_version(node, path)

    def read_pair(self, node: YamlNode, schema: PairSchema, path: DesignPath) -> FormatValue | None:
        numbers = [_parse_number(item) for item in node.items] if isinstance(node, YamlSequence) else []
        if len(numbers) != 2 or None in numbers:
            self.report_invalid(node, f"expected {schema.description}, two numbers", path, "write it as [80, 120]")
            return None
        return tuple(number for number in numbers if number is not None)

    def report_invalid(self, node: YamlNode, message: str, path: DesignPath, fix: str = "") -> None:
        self.report.add("Y103", message, node_span(node), fix=fix, path=path)

    def report_unexpected(self, node: YamlNode, expected: str, path: DesignPath, fix: str = "") -> None:
        self.report_invalid(node, f"expected {expected}, found {_describe_node(node)}", path, fix)

    def _read_name_or_expression(self, node: YamlScalar, schema: ScalarSchema, path: DesignPath) -> FormatValue | None:
        if not node.text.strip():
            noun = "name" if schema.scalar_type is ScalarType.NAME else "expression"
            self.report_invalid(node, f"the {noun} is missing", path, f"add the {noun}, or remove the key")
            return None
        if schema.choices and node.text not in schema.choices:
            fix = did_you_mean(node.text, schema.choices, f"write {' or '.join(schema.choices)}")
            self.report_invalid(node, f"unknown value '{shorten(node.text)}'", path, fix)
            return None
        return node.text

    def _read_number(self, node: YamlScalar, path: DesignPath) -> float | None:
        number = _parse_number(node)
        if number is None or number <= 0:
            self.report_unexpected(node, _SCALAR_TYPE_NAMES[ScalarType.NUMBER], path)
            return None
        return number

    def _read_count(self, node: YamlScalar, path: DesignPath) -> int | None:
        number = _parse_number(node)
        if number is None or number < 0 or not number.is_integer():
            self.report_unexpected(node, _SCALAR_TYPE_NAMES[ScalarType.COUNT], path)
            return None
        return int(number)

    def _read_boolean(self, node: YamlScalar, scalar_type: ScalarType, path: DesignPath) -> FormatValue | None:
        value = None if node.style else _BOOLEANS.get(node.text)
        if value is None:
            self.report_unexpected(node, "true or false", path, "write true or false")
        elif scalar_type is ScalarType.TRUE and not value:
            self.report_invalid(node, f"'{path[-1]}' can only be true", path, f"remove '{path[-1]}'")
            return None
        return value

    def _read_version(self, node: YamlScalar, path: DesignPath) -> FormatValue | None:
        if node.style or node.text != VERSION:
            message = f"unsupported format version {shorten(node.text)!r}"
            fix = f"write 'vicode: {VERSION}', or install a newer vicode: this one reads version {VERSION}"
            self.report.add("Y109", message, node_span(node), fix=fix, path=path)
            return None
        return VERSION


def node_span(node: YamlNode) -> tuple[int, int]:
    """Start and end offset, at least one character long."""
    return node.start, max(node.end, node.start + 1)


def shorten(text: str) -> str:
    return text if len(text) <= _MAX_SHOWN_LENGTH else text[: _MAX_SHOWN_LENGTH - 3] + "…"


def _parse_number(node: YamlNode) -> float | None:
    if not isinstance(node, YamlScalar) or node.style or not _NUMBER.match(node.text):
        return None
    number = float(node.text)
    return number if math.isfinite(number) else None


def _describe_node(node: YamlNode) -> str:
    if isinstance(node, YamlMapping):
        return "a mapping"
    if isinstance(node, YamlSequence):
        return "a list"
    return f"'{shorten(node.text)}'" if node.text else "nothing"
