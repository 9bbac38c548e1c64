"""Writes what was not understood: the generated text with the units of the edited file that no edit explains.

The patch of an edit is not a diff of the edited file, which would contain the understood edits as well, and the layout
of the person. It is a diff between the newly generated text and the same text with the units that are left, so it
applies to what `gen` writes. Units are exchanged as blocks of lines; `verification` judges the result.
"""

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from difflib import unified_diff
from itertools import pairwise

from vicode.regions import find_regions, wrap_region
from vicode.sync.code_items import COMMENT, HEADER, IMPORT, REGION, CodeItem, imported_names, split_items
from vicode.sync.interpret.units import Imports, list_bodies, name_units

_IMPORTS = "imports"


@dataclass(frozen=True, slots=True, kw_only=True)
class _Block:
    """The lines of a unit, with the blank lines before it."""

    name: str
    lines: tuple[str, ...]


def write_leftover(generated: str, edited: str, *, different: Collection[str], imports: Imports) -> str:
    """Return the generated text with the units of the edited file that differ.

    Args:
        generated: The text generated from the design with the understood edits.
        edited: The edited file.
        different: These units.
        imports: What the result imports.
    """
    names = {_text_unit(name) for name in different}
    own, other = _split_blocks(generated), _split_blocks(with_bodies(edited, generated))
    result = _with_blocks(own, other, names)
    text = "\n".join(line for block in result for line in block.lines)
    return _with_imports(f"{text.rstrip()}\n", imports)


def _with_blocks(own: Sequence[_Block], other: Sequence[_Block], names: Collection[str]) -> list[_Block]:
    """Replace, remove and insert the blocks of some units."""
    by_name: dict[str, list[_Block]] = {}
    for block in other:
        by_name.setdefault(block.name, []).append(block)
    shown = {block.name for block in own}
    result: list[_Block] = []
    for block in own:
        if block.name in names:
            result += by_name.pop(block.name, [])
        else:
            result.append(block)
    for index, block in enumerate(other):
        if block.name in names and block.name not in shown:
            before = {each.name for each in other[:index]}
            places = [at for at, each in enumerate(result) if each.name in before]
            result.insert(places[-1] + 1 if places else 0, block)
    return result


def _text_unit(name: str) -> str:
    """The unit of the text: the list of states is a part of its method."""
    owner, _colon, _rest = name.partition(":")
    return owner if "." in owner else name


def _split_blocks(text: str) -> list[_Block]:
    """Split a module into blocks that contain every line."""
    lines = text.split("\n")
    groups: list[tuple[str, list[CodeItem]]] = []
    for item, unit in name_units(split_items(text)):
        name = _IMPORTS if item.kind in (IMPORT, HEADER) and item.depth == 0 else unit
        if not groups or groups[-1][0] != name:
            groups.append((name, []))
        groups[-1][1].append(item)
    ends = [max(item.last for item in items) for _name, items in groups]
    bounds = pairwise([0, *ends[:-1], len(lines)])
    return [
        _Block(name=name, lines=tuple(_with_spaces(items, lines, start, end)))
        for (name, items), (start, end) in zip(groups, bounds, strict=True)
    ]


def _with_spaces(items: Sequence[CodeItem], lines: Sequence[str], start: int, end: int) -> list[str]:
    """Return the lines of items, indented by four spaces for each level."""
    if all(_indent(lines[item.first - 1]) == " " * 4 * item.depth for item in items):
        return list(lines[start:end])
    return [line for item in items for line in _indented(item, lines)]


def _indent(line: str) -> str:
    return line[: len(line) - len(line.lstrip())]


def _indented(item: CodeItem, lines: Sequence[str]) -> list[str]:
    own = lines[item.first - 1 : item.last]
    margin, indent = " " * 4 * item.depth, _indent(own[0])
    blank = [""] * item.blank_lines
    if item.kind in (REGION, COMMENT) or len(own) == 1:
        return [*blank, *(margin + line.removeprefix(indent) if line.strip() else line for line in own)]
    comments = "".join(f"  {comment}" for comment in item.comments)
    return [*blank, *(margin + line for line in f"{item.code}{comments}".split("\n"))]


def _with_imports(text: str, imports: Imports) -> str:
    """Remove the names that are not wanted from the import statements, and add the missing ones behind the last."""
    own = [item for item in split_items(text) if item.kind == IMPORT and item.depth == 0]
    inserted: Mapping[int, list[str]] = {
        item.first: [import_statement(*name) for name in imported_names([item]) if name in imports]
        for item in own
        if not imports.issuperset(imported_names([item]))
    }
    last_lines = {item.first: item.last for item in own if item.first in inserted}
    missing = sorted(imports - frozenset(imported_names(own)) - _region_imports(text))
    result: list[str] = []
    skipped_to = 0
    for number, line in enumerate(text.split("\n"), start=1):
        if number in inserted:
            result += inserted[number]
            skipped_to = last_lines[number]
        if number > skipped_to:
            result.append(line)
        if own and number == own[-1].last:
            result += [import_statement(*name) for name in missing]
    return "\n".join(result)


def _region_imports(text: str) -> Imports:
    try:
        bodies = [split_items(region.body) for region in find_regions(text).regions if region.id == "module"]
    except SyntaxError:
        return frozenset()
    return frozenset(imported_names(item for items in bodies for item in items))


def import_statement(module: str, name: str, alias: str) -> str:
    """Return the statement that imports one name."""
    suffix = f" as {alias}" if alias else ""
    return f"from {module} import {name}{suffix}" if name else f"import {module}{suffix}"


def with_bodies(text: str, generated: str) -> str:
    """Return a text with the bodies of its regions as they are generated."""
    lines, bodies = text.split("\n"), list_bodies(generated)
    for region in reversed(find_regions(text).regions):
        if region.id in bodies:
            block = wrap_region(region.id, bodies[region.id], indent=region.indent)
            lines[region.line - 1 : region.end_line] = block.removesuffix("\n").split("\n")
    return "\n".join(lines)


def make_patch(old: str, new: str, file: str) -> str:
    """Return a unified diff; empty if the texts are equal."""
    pieces = unified_diff(_lines(old), _lines(new), f"a/{file}", f"b/{file}")
    return "".join(piece if piece.endswith("\n") else f"{piece}\n\\ No newline at end of file\n" for piece in pieces)


def _lines(text: str) -> list[str]:
    """Split at line feeds only, as programs that apply patches do."""
    return [line for line in re.split(r"(?<=\n)", text) if line]
