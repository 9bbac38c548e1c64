"""Renaming in hand-written Python, based on the syntax tree.

Only unambiguous references are renamed: attributes of `self` in actions, predicates and methods that do not rebind it,
and project names that neither the code nor the module redefines.
"""

import ast
from collections.abc import Iterator
from dataclasses import dataclass

from vicode.model.python_parser import parse_module
from vicode.model.rename.references import ReferenceKind, ReferenceRename
from vicode.model.snippets import PythonSnippet

_Position = tuple[int, int]
"""Line (starting at 1) and column in bytes."""


def rename_in_python(text: str, role: str, rename: ReferenceRename) -> str:
    """Rename references. Code that cannot be parsed is returned unchanged."""
    if rename.old not in text:
        return text
    piece = PythonSnippet.from_text(text, role)
    tree = _parse_snippet(piece)
    if tree is None:
        return text
    starts = {piece.offset_at(*place) for place in _find_references(tree, role, rename)}
    for start in sorted(starts, reverse=True):
        end = start + len(rename.old)
        # Python reports wrong positions for some names in f-strings; leave those unchanged.
        if text[start:end] == rename.old:
            text = text[:start] + rename.new + text[end:]
    return text


def has_reference_in_python(text: str, role: str, rename: ReferenceRename) -> bool:
    return rename_in_python(text, role, rename) != text


def declares_in_python(text: str, role: str, name: str) -> bool:
    """Return whether code binds a name."""
    tree = _parse_snippet(PythonSnippet.from_text(text, role)) if name in text else None
    return tree is not None and name in set(bound_names(tree))


def _parse_snippet(piece: PythonSnippet) -> ast.Module | None:
    try:
        return parse_module(piece.source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _find_references(tree: ast.Module, role: str, rename: ReferenceRename) -> Iterator[_Position]:
    if rename.kind in (ReferenceKind.CONSTANT, ReferenceKind.ENUMERATION, ReferenceKind.ELEMENT):
        name = rename.owner or rename.old
        if name not in set(bound_names(tree)):
            yield from (place for node in ast.walk(tree) for place in _find_project_references(node, name, rename))
        return
    for body, me in _bodies(tree, role):
        yield from (place for node in _iter_nodes(body, me) for place in _find_component_references(node, me, rename))


def _find_project_references(node: ast.AST, name: str, rename: ReferenceRename) -> Iterator[_Position]:
    match node:
        case ast.Attribute(value=ast.Name(id=owner), attr=rename.old) if (
            rename.kind == ReferenceKind.ELEMENT and owner == name
        ):
            yield _last_name_position(node)
        case ast.Name(id=id_) if rename.kind != ReferenceKind.ELEMENT and id_ == name:
            yield (node.lineno, node.col_offset)


def _find_component_references(node: ast.AST, me: str, rename: ReferenceRename) -> Iterator[_Position]:
    """Yield the positions of attribute names and keyword arguments that refer to the symbol."""
    if isinstance(node, ast.Attribute) and node.attr == rename.old:
        owner = _self_attribute(node.value, me)
        is_mine = isinstance(node.value, ast.Name) and node.value.id == me
        if (rename.kind in (ReferenceKind.OWN, ReferenceKind.ALIAS) and is_mine) or (
            rename.kind == ReferenceKind.MEMBER and owner == rename.owner
        ):
            yield _last_name_position(node)
    elif isinstance(node, ast.Call) and _passes_argument(node, me, rename):
        yield from ((each.lineno, each.col_offset) for each in node.keywords if each.arg == rename.old)


def _passes_argument(call: ast.Call, me: str, rename: ReferenceRename) -> bool:
    """Return whether a call passes the renamed parameter, such as `self.head.modulate(pan=…)`."""
    if not isinstance(call.func, ast.Attribute):
        return False
    function, whose = call.func.attr, call.func.value
    is_mine = isinstance(whose, ast.Name) and whose.id == me
    match rename.kind:
        case ReferenceKind.OWN:
            return is_mine and function == "modulate"
        case ReferenceKind.PARAMETER:
            steps = is_mine and function == "_call" and bool(call.args)
            used = call.args[0] if steps else whose if function == "modulate" else None
            return used is not None and _self_attribute(used, me) == rename.owner
        case ReferenceKind.ARGUMENT:
            return f"{_self_attribute(whose, me)}.{function}" == rename.owner
        case _:
            return False


def _self_attribute(node: ast.expr, me: str) -> str | None:
    """Return NAME for `self.NAME`."""
    is_mine = isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == me
    return node.attr if isinstance(node, ast.Attribute) and is_mine else None


def _last_name_position(node: ast.Attribute) -> _Position:
    assert node.end_lineno is not None
    assert node.end_col_offset is not None
    return (node.end_lineno, node.end_col_offset - len(node.attr.encode()))


_Function = ast.FunctionDef | ast.AsyncFunctionDef


@dataclass(frozen=True, slots=True)
class _Body:
    nodes: list[ast.stmt]


def _bodies(tree: ast.Module, role: str) -> Iterator[tuple[_Body, str]]:
    """Yield the function bodies in which a name refers to the component, with this name."""
    outer = tree.body[0]
    if role in ("action", "predicate") and isinstance(outer, ast.FunctionDef):
        yield from _with_self_name(outer, "self")
    elif role == "members" and isinstance(outer, ast.ClassDef):
        for method in outer.body:
            if isinstance(method, _Function) and not _is_static(method):
                first = [*method.args.posonlyargs, *method.args.args][:1]
                yield from _with_self_name(method, *(each.arg for each in first))


def _with_self_name(function: _Function, me: str = "") -> Iterator[tuple[_Body, str]]:
    body = _Body(function.body)
    stored = {name for each in body.nodes for node in ast.walk(each) if (name := _stored_name(node))}
    if me and me not in stored:
        yield body, me


def _is_static(method: _Function) -> bool:
    names = {each.id for each in method.decorator_list if isinstance(each, ast.Name)}
    return bool(names & {"staticmethod", "classmethod"})


def _stored_name(node: ast.AST) -> str:
    return node.id if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load) else ""


def _iter_nodes(body: _Body, me: str) -> Iterator[ast.AST]:
    """Yield all nodes of a body, except in inner functions that rebind `me`."""
    pending: list[ast.AST] = [*body.nodes]
    while pending:
        node = pending.pop()
        if isinstance(node, ast.Lambda | _Function) and me in _argument_names(node.args):
            continue
        yield node
        pending += ast.iter_child_nodes(node)


def _argument_names(arguments: ast.arguments) -> set[str]:
    every = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, arguments.vararg, arguments.kwarg]
    return {each.arg for each in every if each is not None}


def bound_names(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        match node:
            case ast.Name(id=name) if _stored_name(node):
                yield name
            case ast.arg(arg=name) | ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name):
                yield name
            case ast.ClassDef(name=name):
                yield name
            case ast.alias(name=name, asname=other):
                yield other or name.partition(".")[0]
            case ast.ExceptHandler(name=str(name)) | ast.MatchAs(name=str(name)) | ast.MatchStar(name=str(name)):
                yield name
