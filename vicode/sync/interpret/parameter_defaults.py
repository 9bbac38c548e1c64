"""The default of a parameter stands twice in generated code: in `__init__` and in the signature of `modulate`."""

import ast

from vicode.model.python_parser import parse_module
from vicode.regions import find_regions


def align_defaults(generated: str, edited: str) -> str:
    """Return the edited text with a default that was changed at one of its two places changed at both.

    Raises:
        SyntaxError: A text is not Python.
    """
    if "def modulate(" not in generated:
        return edited
    old, new = _read_defaults(generated), _read_defaults(edited)
    lines = edited.split("\n")
    changes = []
    for name, places in new.items():
        before = old.get(name)
        if before is None or len(places) != 2 or len(before) != 2:
            continue
        is_changed = [ast.dump(now) != ast.dump(was) for now, was in zip(places, before, strict=True)]
        if is_changed.count(True) == 1:
            source, target = places if is_changed[0] else places[::-1]
            changes.append((target, ast.unparse(source)))
    for node, text in sorted(changes, key=lambda change: (change[0].lineno, change[0].col_offset), reverse=True):
        if node.lineno == node.end_lineno and lines[node.lineno - 1].isascii():
            line = lines[node.lineno - 1]
            lines[node.lineno - 1] = line[: node.col_offset] + text + line[node.end_col_offset :]
    return "\n".join(lines)


def _read_defaults(text: str) -> dict[str, list[ast.expr]]:
    """Return the value in `__init__` and the default in `modulate` of each parameter."""
    lines = text.split("\n")
    for region in find_regions(text).regions:
        lines[region.line - 1 : region.end_line] = [
            f"{region.indent}pass",
            *[""] * (region.end_line - region.line),
        ]
    values: dict[str, list[ast.expr]] = {}
    methods = {
        node.name: node for node in ast.walk(parse_module("\n".join(lines))) if isinstance(node, ast.FunctionDef)
    }
    for statement in methods["__init__"].body if "__init__" in methods else ():
        match statement:
            case ast.Assign(targets=[ast.Attribute(value=ast.Name(id="self"), attr=name)], value=value):
                values.setdefault(name, []).append(value)
    if "modulate" in methods:
        arguments = methods["modulate"].args
        for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True):
            if default is not None:
                values.setdefault(argument.arg, []).append(default)
    return values
