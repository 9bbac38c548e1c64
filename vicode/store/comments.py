"""Puts remarks as YAML comments above the things of a file they are about."""

from collections.abc import Iterable

from vicode.findings import DesignPath
from vicode.store.documents import read_record
from vicode.store.format import DESIGN, PROJECT
from vicode.store.schema_types import RecordSchema
from vicode.store.source_map import SourceMap

PathComment = tuple[DesignPath, str]
"""The path of a thing, and the words about it; an empty path means the whole file."""


def add_comments(text: str, comments: Iterable[PathComment], *, is_project_file: bool = False) -> str:
    """The text of a design, or of a project.yaml, with comments above its things; it means the same.

    What a path leads to may be missing; then the comment stands above the nearest thing around it.
    """
    shape = PROJECT if is_project_file else DESIGN
    report, root = read_record(text, "", shape)
    source = SourceMap(file="", line_index=report.line_index, root=root)
    lines = text.split("\n")
    above: dict[int, list[str]] = {}
    for path, words in comments:
        at = source.locate(path, of_key=True).line - 1 if path else 0
        above.setdefault(at, []).extend(_format_comment(words, lines[at] if path else ""))
    made: list[str] = []
    for at, line in enumerate(lines):
        made += [*above.get(at, ()), line]
    together = "\n".join(made)
    if _read_value(together, shape) == _read_value(text, shape):
        return together
    # Inside brackets that go over lines, or in a text, a comment may mean something else.
    return "\n".join([*(line.strip() for comments in above.values() for line in comments), text])


def _format_comment(words: str, line: str) -> list[str]:
    indent = line[: len(line) - len(line.lstrip(" "))]
    printable = ("".join(char if char.isprintable() else " " for char in each) for each in words.splitlines())
    return [f"{indent}# {each}".rstrip() for each in printable]


def _read_value(text: str, shape: RecordSchema) -> object:
    report, root = read_record(text, "", shape)
    return (root.value if root else None, report.findings)
