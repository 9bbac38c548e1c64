"""Changes an expression as its generated code was changed, and keeps the rest of its text."""

import ast
from collections.abc import Iterator

from vicode.model.python_parser import parse_single_expression


def merge_expression(text: str, old: ast.expr, new: ast.expr) -> str:
    """Return the text with the difference between two trees applied; empty if it does not correspond to `old`.

    Args:
        text: The expression in the design.
        old: The tree that was read from the code generated from `text`.
        new: The tree that was read from the changed code.
    """
    plain = text.replace("\n", " ")
    if not plain.isascii():
        return ""
    try:
        tree = parse_single_expression(plain.lstrip())
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ""
    start = len(plain) - len(plain.lstrip())
    grouped = short = text
    for first, last, replacement in sorted(_replacements(tree, old, new), reverse=True):
        grouped = grouped[: start + first] + f"({replacement})" + grouped[start + last :]
        short = short[: start + first] + replacement + short[start + last :]
    return short.strip() if _dump(short) == _dump(grouped) else grouped.strip()


def _dump(text: str) -> str:
    """Return the tree as text; empty without parentheses that the syntax needs, as in `(1).x`."""
    try:
        return ast.dump(parse_single_expression(text.replace("\n", " ").strip()))
    except SyntaxError:
        return ""


def _replacements(own: ast.expr, old: ast.expr, new: ast.expr) -> Iterator[tuple[int, int, str]]:
    """Yield the ranges of the text to replace."""
    if ast.dump(old) == ast.dump(new):
        return
    parts = [list(_operands(node)) for node in (own, old, new)]
    is_same_shape = _shape(own) == _shape(old) == _shape(new)
    if is_same_shape and len(parts[0]) == len(parts[1]) == len(parts[2]) > 0:
        for each in zip(*parts, strict=True):
            yield from _replacements(*each)
        return
    yield own.col_offset, own.end_col_offset or own.col_offset, _number_like(own, new) or ast.unparse(new)


def _operands(node: ast.expr) -> Iterator[ast.expr]:
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.keyword):
            yield child.value
        elif isinstance(child, ast.expr):
            yield child


def _shape(node: ast.expr) -> tuple[object, ...]:
    """What a node is besides its operands."""
    match node:
        case ast.BinOp(op=operator) | ast.UnaryOp(op=operator) | ast.BoolOp(op=operator):
            return (type(node), type(operator))
        case ast.Compare(ops=operators):
            return (type(node), *map(type, operators))
        case ast.Attribute(attr=name):
            return (type(node), name)
        case ast.Call(keywords=keywords):
            return (type(node), *(keyword.arg for keyword in keywords))
        case ast.Name(id=name):
            return (type(node), name)
        case ast.Constant(value=value):
            return (type(node), value)
        case _:
            return (type(node),)


def _number_like(own: ast.expr, new: ast.expr) -> str:
    """Return a whole number without decimals if the text had none."""
    match own, new:
        case ast.Constant(value=int()), ast.Constant(value=float() as value) if value.is_integer():
            return str(int(value))
        case _:
            return ""
