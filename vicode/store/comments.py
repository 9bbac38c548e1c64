"""Inserts YAML comments above nodes of a file."""

from collections.abc import Iterable

from vicode.findings import DesignPath
from vicode.store.documents import read_record
from vicode.store.format import DESIGN
from vicode.store.project_format import PROJECT
from vicode.store.schema_types import RecordSchema
from vicode.store.source_map import SourceMap

PathComment = tuple[DesignPath, str]
"""The path of a node, empty for the whole file, and the text of its comment."""


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
    if _read_value(commented, schema) == _read_value(text, schema):
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
