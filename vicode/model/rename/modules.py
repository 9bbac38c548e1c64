"""Enumerations and constants of a project in hand-written Python modules, which import them from generated code."""

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass

from vicode.model.python_parser import parse_module
from vicode.model.rename.python import bound_names
from vicode.model.rename.references import ReferenceKind, ReferenceRename

DECLARATIONS = "declarations"
"""The module of the generated package with enumerations and constants."""
_LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n)|[^\r\n]+")


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclaredUse:
    """A name of the project in a module, at its 1-based line and column in bytes; `element` is an attribute of it."""

    name: str
    element: str = ""
    line: int
    column: int


def find_declared_uses(tree: ast.Module, package: str) -> Iterator[DeclaredUse]:
    """The names that a module imports from the generated package, where nothing in it gives them another meaning.

    Args:
        tree: The module.
        package: The generated package of the project.
    """
    names = list(bound_names(tree))
    is_bound_once = {name for name in names if names.count(name) == 1}
    imported: dict[str, str] = {}
    modules: set[str] = set()
    for node in ast.walk(tree):
        match node:
            case ast.ImportFrom(module=module, level=0) if module == f"{package}.{DECLARATIONS}":
                found = [each for each in node.names if (each.asname or each.name) in is_bound_once]
                imported |= {each.asname or each.name: each.name for each in found}
                yield from (_use(each.name, each) for each in found)
            case ast.ImportFrom(module=module, level=0) if module == package:
                modules |= {each.asname or each.name for each in node.names if each.name == DECLARATIONS}
            case ast.Import():
                modules |= {each.asname or each.name for each in node.names if each.name == f"{package}.{DECLARATIONS}"}
    modules = {name for name in modules if name in is_bound_once or name == f"{package}.{DECLARATIONS}"}
    for node in ast.walk(tree):
        yield from _uses_in(node, imported, modules)


def _uses_in(node: ast.AST, imported: dict[str, str], modules: set[str]) -> Iterator[DeclaredUse]:
    if isinstance(node, ast.Name) and imported.get(node.id) == node.id:
        yield _use(node.id, node)
    if not isinstance(node, ast.Attribute):
        return
    owner = _dotted(node.value)
    if owner in modules:
        yield DeclaredUse(name=node.attr, line=node.end_lineno or 0, column=_last_column(node))
    name = imported.get(owner) or (owner.rpartition(".")[2] if owner.rpartition(".")[0] in modules else "")
    if name:
        yield DeclaredUse(name=name, element=node.attr, line=node.end_lineno or 0, column=_last_column(node))


def rename_in_module(text: str, package: str, rename: ReferenceRename) -> str:
    """Rename a constant, an enumeration or an element; a module that cannot be parsed is returned unchanged."""
    tree = parse_or_none(text) if rename.old in text else None
    if tree is None:
        return text
    uses = set(find_declared_uses(tree, package))
    wanted = {use for use in uses if _is_wanted(use, rename)}
    if any(use.name == rename.new or (use.name == rename.owner and use.element == rename.new) for use in uses):
        return text
    lines = _LINE.findall(text)
    old = rename.old.encode()
    for use in sorted(wanted, key=lambda each: (each.line, each.column), reverse=True):
        line = lines[use.line - 1].encode()
        if line[use.column : use.column + len(old)] == old:
            lines[use.line - 1] = (line[: use.column] + rename.new.encode() + line[use.column + len(old) :]).decode()
    return "".join(lines)


def find_unrenamed_lines(text: str, rename: ReferenceRename) -> list[int]:
    """The lines, counted from 1, that may still mean the old name, such as strings and names of unknown origin."""
    name = re.escape(rename.old)
    is_element = rename.kind is ReferenceKind.ELEMENT
    # An element is also known by its name, as in `Side["left"]` and `side.name == "left"`.
    pattern = re.compile(
        rf"\b{re.escape(rename.owner)}(?:\.|::){name}\b|(['\"]){name}\1" if is_element else rf"\b{name}\b"
    )
    return [number for number, line in enumerate(_LINE.findall(text), start=1) if pattern.search(line)]


def parse_or_none(text: str) -> ast.Module | None:
    """The tree of a module, None if it cannot be parsed."""
    try:
        return parse_module(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _is_wanted(use: DeclaredUse, rename: ReferenceRename) -> bool:
    if rename.kind is ReferenceKind.ELEMENT:
        return (use.name, use.element) == (rename.owner, rename.old)
    return (use.name, use.element) == (rename.old, "")


def _use(name: str, node: ast.alias | ast.Name) -> DeclaredUse:
    return DeclaredUse(name=name, line=node.lineno, column=node.col_offset)


def _last_column(node: ast.Attribute) -> int:
    return (node.end_col_offset or 0) - len(node.attr.encode())


def _dotted(node: ast.expr) -> str:
    """The text of `a.b.c`, "" for other expressions."""
    if isinstance(node, ast.Name):
        return node.id
    owner = _dotted(node.value) if isinstance(node, ast.Attribute) else ""
    return f"{owner}.{node.attr}" if owner and isinstance(node, ast.Attribute) else ""
