"""Writes what was not understood as a patch of the generated text."""

import ast
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher, unified_diff

from vicode.regions import find_regions
from vicode.sync.code_items import COMMENT, DOCSTRING, IMPORT, REGION, CodeItem, imported_names
from vicode.sync.interpret.normal_form import GeneratedParts, NormalForm, build_normal_form

_Imports = frozenset[tuple[str, str, str]]


@dataclass(frozen=True, slots=True, kw_only=True)
class LeftoverWriter:
    """Writes the patch.

    Attributes:
        generated: The text generated from the design with the understood edits.
        generated_form: Its normal form.
        edited: The edited text.
        edited_form: Its normal form.
        parts: The parts of the text that the person started with.
        imports: What the result imports.
    """

    generated: str
    generated_form: NormalForm
    edited: str
    edited_form: NormalForm
    parts: GeneratedParts
    imports: _Imports

    def write(self, file: str) -> str:
        """Return the patch; empty if everything was understood."""
        if self.generated_form.keys == self.edited_form.keys and self.imports == self.generated_form.imports:
            return ""
        text = self._with_changed_items()
        if not self._is_complete(text):
            text = _with_bodies(self.edited, self.generated)
        return make_patch(self.generated, text, file)

    def _is_complete(self, text: str) -> bool:
        """Whether a text is what the person wrote."""
        try:
            form = build_normal_form(text, self.parts, is_generated=True)
        except SyntaxError:
            return False
        return form.keys == self.edited_form.keys and form.imports == self.imports

    def _with_changed_items(self) -> str:
        """Return the generated text with the statements that were not understood."""
        removed, inserted = self._place_changes()
        lines = self.generated.split("\n")
        result: list[str] = []
        end = 0
        for index, item in enumerate(self.generated_form.raw):
            if item.first > end:
                if index not in removed:
                    result += lines[end : item.last]
                end = item.last
            result += [line for other in inserted.get(index, ()) for line in self._edited_lines(other)]
        return "\n".join([*result, *lines[end:]])

    def _place_changes(self) -> tuple[set[int], dict[int, list[CodeItem]]]:
        """Return the indices of the generated items to remove, and items to insert behind an index."""
        own, other = self.generated_form, self.edited_form
        index_by_line = {item.first: index for index, item in reversed(list(enumerate(own.raw)))}
        raw_by_line = {item.first: item for item in reversed(other.raw)}
        removed: set[int] = set()
        inserted: dict[int, list[CodeItem]] = {}
        seen: set[int] = set()
        for tag, first, last, start, end in SequenceMatcher(None, own.keys, other.keys, autojunk=False).get_opcodes():
            if tag == "equal":
                continue
            removed |= {index_by_line[item.first] for item in own.items[first:last] if item.first in index_by_line}
            anchor = index_by_line.get(own.items[first - 1].first, 0) if first else 0
            for item in other.items[start:end]:
                if item.first in raw_by_line and item.first not in seen:
                    seen.add(item.first)
                    inserted.setdefault(anchor, []).append(raw_by_line[item.first])
        self._place_imports(removed, inserted)
        return removed, inserted

    def _place_imports(self, removed: set[int], inserted: dict[int, list[CodeItem]]) -> None:
        own = [(index, item) for index, item in enumerate(self.generated_form.raw) if _is_top_level_import(item)]
        for index, item in own:
            if not self.imports.issuperset(imported_names([item])):
                removed.add(index)
                kept = self.imports.intersection(imported_names([item]))
                inserted.setdefault(index, [])[:0] = _import_items(kept)
        missing = self.imports - frozenset(imported_names(item for _index, item in own)) - self._region_imports()
        if own:
            inserted.setdefault(own[-1][0], []).extend(_import_items(missing))

    def _region_imports(self) -> _Imports:
        """Return what code of the design imports."""
        shown = imported_names(item for item in self.generated_form.raw if _is_top_level_import(item))
        return self.generated_form.imports - frozenset(shown)

    def _edited_lines(self, item: CodeItem) -> list[str]:
        """Return the lines of an item of the edited file, with the indentation of generated code."""
        margin = " " * 4 * item.depth
        blank = [""] * item.blank_lines
        lines = self.edited.split("\n")[item.first - 1 : item.last] if item.first else []
        indent = lines[0][: len(lines[0]) - len(lines[0].lstrip())] if lines else ""
        if lines and indent == margin:
            return [*blank, *lines]
        if item.kind == REGION:
            return [*blank, *(margin + line.removeprefix(indent) for line in lines)]
        comments = "".join(f"  {comment}" for comment in item.comments)
        code = f"# {item.code}" if item.kind == COMMENT else item.code
        if item.kind == DOCSTRING and item.node is not None:
            code = ast.unparse(item.node)
        return [*blank, *(margin + line for line in f"{code}{comments}".split("\n"))]


def make_patch(old: str, new: str, file: str) -> str:
    """Return a unified diff; empty if the texts are equal."""
    pieces = unified_diff(_lines(old), _lines(new), f"a/{file}", f"b/{file}")
    return "".join(piece if piece.endswith("\n") else f"{piece}\n\\ No newline at end of file\n" for piece in pieces)


def _lines(text: str) -> list[str]:
    """Split at line feeds only, as programs that apply patches do."""
    return [line for line in re.split(r"(?<=\n)", text) if line]


def _is_top_level_import(item: CodeItem) -> bool:
    return item.kind == IMPORT and item.depth == 0


def _import_items(names: Iterable[tuple[str, str, str]]) -> Sequence[CodeItem]:
    return [
        CodeItem(kind=IMPORT, scope="", depth=0, code=import_statement(*name), first=0, last=0, node=ast.Pass())
        for name in sorted(names)
    ]


def import_statement(module: str, name: str, alias: str) -> str:
    """Return the statement that imports one name."""
    suffix = f" as {alias}" if alias else ""
    return f"from {module} import {name}{suffix}" if name else f"import {module}{suffix}"


def _with_bodies(text: str, generated: str) -> str:
    """Return a text with the bodies of its regions as they are generated."""
    lines, source = text.split("\n"), generated.split("\n")
    own = {region.id: source[region.line - 1 : region.end_line] for region in find_regions(generated).regions}
    for region in reversed(find_regions(text).regions):
        if region.id in own:
            lines[region.line - 1 : region.end_line] = own[region.id]
    return "\n".join(lines)
