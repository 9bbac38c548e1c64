"""Splits a generated Python module into items: statements without their bodies, comments, docstrings and regions.

Two modules with equal items differ in layout only. Bodies of regions belong to no item. A syntax tree has no comments,
and lines of text change with every formatter. An item has the statement as `ast.unparse` writes it, its depth and
scope, and the comments in or behind it, so a list of items can be compared by any diff.
"""

import ast
import copy
import inspect
import io
import re
import tokenize
from bisect import bisect_left
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from vicode.model.python_parser import parse_module
from vicode.regions import find_regions, has_header

CODE, COMMENT, DOCSTRING, HEADER, IMPORT, REGION = "code", "comment", "docstring", "header", "import", "region"

GENERATED_DOCSTRINGS = frozenset(
    {
        "Set the parameters.",
        "Test the common transitions; return whether one of them ended the decision.",
        "Run the common actions.",
    }
)
"""What the generator writes by itself, so that its absence is no edit."""
_CLASS = re.compile(r"class (\w+)\b.*:")
_METHOD = ("    def ", "    async def ")
_REGION_CALL = "_vicode_region_"
_Definition = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeItem:
    """One item of a module.

    Attributes:
        kind: One of the kinds above.
        scope: The qualified name of the enclosing definition; for the header of a definition, its own.
        depth: The nesting level.
        code: The normalized text; the id of a region.
        comments: The comments inside a statement or behind it.
        first: The first line of the item, from 1.
        last: Its last line.
        blank_lines: The number of blank lines before it.
        node: The statement with its body.
    """

    kind: str
    scope: str
    depth: int
    code: str
    comments: tuple[str, ...] = ()
    first: int
    last: int
    blank_lines: int = 0
    node: ast.stmt | None = None

    @property
    def key(self) -> tuple[object, ...]:
        """What two items with the same meaning have in common."""
        return (self.kind, self.scope, self.depth, self.code, self.comments)


def split_items(text: str) -> tuple[CodeItem, ...]:
    """Split a module into items, in the order of their lines.

    Raises:
        SyntaxError: The text outside regions is not Python.
    """
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    masked, last_lines = _mask_regions(text)
    try:
        tree = parse_module(masked)
        tokens = list(tokenize.generate_tokens(io.StringIO(masked).readline))
    except (ValueError, RecursionError, MemoryError, tokenize.TokenError) as error:
        raise SyntaxError(str(error)) from error
    statements = _Splitter(masked.split("\n"), tokens, last_lines).split(tree)
    return _with_blank_lines(_with_comments(statements, tokens, text), masked.split("\n"))


@dataclass(frozen=True, slots=True, kw_only=True)
class ModulePart:
    """A part of a module that is read by itself: lines before the first method, or a method with what follows it.

    Attributes:
        owner: The class of the method; empty for the lines before.
        first: The first line of the part in the module, from 1.
        text: The lines.
    """

    owner: str
    first: int
    text: str

    def split(self) -> tuple[CodeItem, ...]:
        """Split the part into items, with lines counted in the part.

        Raises:
            SyntaxError: The part is not Python.
        """
        if not self.owner:
            return split_items(self.text)
        return split_items(f"class {self.owner}():\n{self.text}")[1:]

    def split_in_place(self) -> tuple[CodeItem, ...]:
        """Split the part into items, with lines of the module.

        Raises:
            SyntaxError: The part is not Python.
        """
        if not self.owner:
            return split_items(self.text)
        header, *items = split_items(f"class {self.owner}():\n{self.text}")
        offset = self.first - 2
        for item in (header, *items):
            if item.depth == 0 and item.node is not None:
                ast.increment_lineno(item.node, offset)
        return tuple(replace(item, first=item.first + offset, last=item.last + offset) for item in items)


def split_parts(text: str) -> list[ModulePart]:
    """Split a module at the methods of its classes, so that parts that did not change need not be read again."""
    inside = {line for region in find_regions(text).regions for line in range(region.line - 1, region.end_line)}
    lines = text.split("\n")
    owner, starts = "", [(0, "")]
    for number, line in enumerate(lines):
        if number in inside:
            continue
        if line[:1].strip() and line[0] != "#":
            found = _CLASS.match(line)
            owner = found[1] if found else ""
        elif owner and line.startswith(_METHOD):
            start = number
            while start - 1 > starts[-1][0] and start - 1 not in inside and _stands_above_method(lines[start - 1]):
                start -= 1
            starts.append((start, owner))
    ends = [start for start, _owner in starts[1:]] + [len(lines)]
    return [
        ModulePart(owner=name, first=start + 1, text="\n".join(lines[start:end]))
        for (start, name), end in zip(starts, ends, strict=True)
    ]


def _stands_above_method(line: str) -> bool:
    return not line.strip() or line.startswith(("    #", "    @"))


def imported_names(items: Iterable[CodeItem]) -> tuple[tuple[str, str, str], ...]:
    """Return what import statements import, sorted: module, name (empty: the module itself) and alias."""
    names: set[tuple[str, str, str]] = set()
    for item in items:
        match item.node:
            case ast.Import(names=aliases):
                names |= {(alias.name, "", alias.asname or "") for alias in aliases}
            case ast.ImportFrom(module=module, names=aliases, level=level):
                owner = "." * level + (module or "")
                names |= {(owner, alias.name, alias.asname or "") for alias in aliases}
    return tuple(sorted(names))


def docstring_text(item: CodeItem) -> str:
    """Return the lines of a docstring without their indentation."""
    return (_docstring(item.node) or "") if item.node is not None else ""


def _mask_regions(text: str) -> tuple[str, dict[int, int]]:
    """Replace each region by a call in its first line; return the last lines of the regions by the first."""
    lines = text.split("\n")
    last_lines = {}
    for region in find_regions(text).regions:
        blank = [""] * (region.end_line - region.line)
        lines[region.line - 1 : region.end_line] = [f"{region.indent}{_REGION_CALL}({region.id!r})", *blank]
        last_lines[region.line] = region.end_line
    return "\n".join(lines), last_lines


class _Splitter:
    """Splits the statements of one module."""

    def __init__(self, lines: list[str], tokens: list[tokenize.TokenInfo], region_ends: dict[int, int]) -> None:
        self._lines, self._region_ends = lines, region_ends
        self._line_ends = [token.start for token in tokens if token.type == tokenize.NEWLINE]
        self._else_lines = [token.start[0] for token in tokens if token.string == "else"]

    def split(self, tree: ast.Module) -> list[CodeItem]:
        return list(self._body(tree.body, 0, "", may_have_docstring=True))

    def _body(
        self, body: list[ast.stmt], depth: int, scope: str, *, may_have_docstring: bool = False
    ) -> Iterator[CodeItem]:
        for index, node in enumerate(body):
            if index == 0 and may_have_docstring and (text := _docstring(node)) is not None:
                yield self._item(DOCSTRING, node, depth, scope, text)
            else:
                yield from self._statement(node, depth, scope)

    def _statement(self, node: ast.stmt, depth: int, scope: str) -> Iterator[CodeItem]:
        match node:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
                scope = f"{scope}.{node.name}".lstrip(".")
                yield self._item(CODE, node, depth, scope, _header_text(node), last=self._header_end(node))
                yield from self._body(node.body, depth + 1, scope, may_have_docstring=True)
            case ast.If():
                yield from self._if(node, depth, scope, "if")
            case ast.Expr(value=ast.Call(func=ast.Name(id=name), args=[ast.Constant(value=str(id_))])) if (
                name == _REGION_CALL and node.lineno in self._region_ends
            ):
                yield self._item(REGION, node, depth, scope, id_, last=self._region_ends[node.lineno])
            case ast.Import() | ast.ImportFrom():
                yield self._item(IMPORT, node, depth, scope, ast.unparse(node))
            case _:
                yield self._item(CODE, node, depth, scope, ast.unparse(node))

    def _if(self, node: ast.If, depth: int, scope: str, keyword: str) -> Iterator[CodeItem]:
        text = f"{keyword} {ast.unparse(node.test)}:"
        yield self._item(CODE, node, depth, scope, text, last=self._header_end(node))
        yield from self._body(node.body, depth + 1, scope)
        match node.orelse:
            case []:
                return
            case [ast.If() as only] if self._lines[only.lineno - 1].lstrip().startswith("elif"):
                yield from self._if(only, depth, scope, "elif")
            case [first, *_rest]:
                above = [line for line in self._else_lines if line <= first.lineno]
                line = above[-1] if above else first.lineno
                yield CodeItem(kind=CODE, scope=scope, depth=depth, code="else:", first=line, last=line)
                yield from self._body(node.orelse, depth + 1, scope)

    def _item(self, kind: str, node: ast.stmt, depth: int, scope: str, code: str, *, last: int = 0) -> CodeItem:
        decorators = node.decorator_list if isinstance(node, _Definition) else []
        first = min([node.lineno, *(decorator.lineno for decorator in decorators)])
        last = last or node.end_lineno or node.lineno
        return CodeItem(kind=kind, scope=scope, depth=depth, code=code, first=first, last=last, node=node)

    def _header_end(self, node: ast.stmt) -> int:
        """Return the last line of the header of a compound statement."""
        return self._line_ends[bisect_left(self._line_ends, (node.lineno, node.col_offset))][0]


def _header_text(node: _Definition) -> str:
    header = copy.copy(node)
    header.body = []
    return ast.unparse(header)


def _docstring(node: ast.stmt) -> str | None:
    match node:
        case ast.Expr(value=ast.Constant(value=str(text))):
            return inspect.cleandoc(text).strip()
        case _:
            return None


def _with_comments(items: list[CodeItem], tokens: list[tokenize.TokenInfo], text: str) -> list[CodeItem]:
    """Add the comments: to the statement they are in or behind, else as items of their own."""
    owners = {line: index for index, item in reversed(list(enumerate(items))) for line in _lines_of(item)}
    own: list[CodeItem] = []
    for token in tokens:
        if token.type != tokenize.COMMENT:
            continue
        line, column = token.start
        if line in owners:
            index = owners[line]
            items[index] = replace(items[index], comments=(*items[index].comments, token.string))
        elif line == 1 and has_header(text):
            own.append(CodeItem(kind=HEADER, scope="", depth=0, code="", first=1, last=1))
        elif own and own[-1].kind == COMMENT and own[-1].last == line - 1:
            before = own[-1]
            own[-1] = replace(before, code=f"{before.code} {_comment_text(token.string)}".strip(), last=line)
        else:
            depth, scope = _place(items, line, column)
            comment = _comment_text(token.string)
            own.append(CodeItem(kind=COMMENT, scope=scope, depth=depth, code=comment, first=line, last=line))
    return sorted([*items, *own], key=lambda item: item.first)


def _lines_of(item: CodeItem) -> range:
    return range(item.first, item.last + 1)


def _comment_text(comment: str) -> str:
    return " ".join(comment.removeprefix("#").split())


def _place(items: list[CodeItem], line: int, column: int) -> tuple[int, str]:
    """Return the depth and scope of a comment: those of the next statement, or of the block that it ends."""
    following = next((item for item in items if item.first > line), None)
    before = next((item for item in reversed(items) if item.last < line), None)
    is_deeper = following is None or (
        following.node is not None and column > getattr(following.node, "col_offset", column)
    )
    if is_deeper and before is not None:
        return before.depth, before.scope
    if following is None:
        return 0, ""
    is_definition = isinstance(following.node, _Definition)
    return following.depth, following.scope.rpartition(".")[0] if is_definition else following.scope


def _with_blank_lines(items: list[CodeItem], lines: list[str]) -> tuple[CodeItem, ...]:
    counted, end = [], 0
    for item in items:
        blank = sum(not line.strip() for line in lines[end : item.first - 1])
        counted.append(replace(item, blank_lines=blank))
        end = max(end, item.last)
    return tuple(counted)
